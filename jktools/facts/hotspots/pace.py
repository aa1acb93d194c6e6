"""How often the handlers of a level's scripts run, once all is under way: runs a second that last.

A pulse comes once an interval and once a frame at most. A timer comes once for each time that it is set: it lasts when
what it runs sets it again, or when something that lasts sets it. What the player or the world causes is counted as one
event; it counts here for what it starts. A message that finds the script asleep can add a turn to a loop that sleeps:
such turns are left out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from jktools.facts.cog import ranges
from jktools.facts.cog.rates import PULSE, TIMER, Rates, Site, Source
from jktools.facts.cog.repeats import NEVER, Counter, Repeats
from jktools.facts.hotspots.ends import ends
from jktools.facts.hotspots.runners import Runner

THING_SENDERS: Mapping[str, int] = {"setthingpulse": PULSE, "setthingtimer": TIMER}


class Beat(NamedTuple):
    """A pulse or timer that a script gives to things."""

    runner: Runner
    site: Site
    message: int
    seconds: float
    """The least interval."""
    things: frozenset[int]
    """Numbers of the things that get it."""
    senders: tuple[str, ...]


class Paces:
    """Of all scripts of one level."""

    def __init__(self, runners: Iterable[Runner], frames: float) -> None:
        """`frames` are the game's a second."""
        self.runners = tuple(runners)
        self.frame = 1.0 / frames
        self.repeats = {runner: _repeats(runner) for runner in self.runners}
        self.beats = [beat for runner in self.runners for beat in _beats(runner)]
        self.started = {runner: self._started(runner) for runner in self.runners}
        self.runs: dict[Runner, dict[str, float]] = {runner: {} for runner in self.runners}
        for _ in range(2):  # a thing's timer may wait for the pulse of another script
            self.runs = {runner: self._runs(runner) for runner in self.runners}

    def runs_of(self, runner: Runner, label: str) -> float:
        """Runs a second of a handler."""
        return self.runs[runner].get(label, 0.0)

    def passes(self, runner: Runner, label: str, site: Site) -> Repeats:
        """How often a call happens in the runs of a handler."""
        return self.repeats[runner][label].get(site.block, NEVER)

    def beats_for(self, runner: Runner, message: int) -> dict[int, tuple[float, list[Beat]]]:
        """By thing: the least interval at which a script gets a message from it, and what sets it."""
        own = {thing.number for thing in runner.things}
        found: dict[int, tuple[float, list[Beat]]] = {}
        for beat in self.beats:
            if beat.message == message:
                for number in beat.things & own:
                    least, by = found.get(number, (math.inf, []))
                    found[number] = (min(least, beat.seconds), [*by, beat])
        return found

    def _started(self, runner: Runner) -> frozenset[str]:
        """The handlers that can run at all: a pulse that nothing running sets never comes."""
        rates = runner.analysis.rates
        foreign = {b.message for b in self.beats if b.runner is not runner and b.things & _numbers(runner)}
        found = {
            handler.label
            for handler in runner.analysis.program.handlers
            if handler.message.id in foreign or any(s.site is None for s in rates.sources[handler.label])
        }
        grown = True
        while grown:
            more = {
                label
                for label, sources in rates.sources.items()
                if label not in found and any(not s.off and found.intersection(s.senders) for s in sources)
            }
            found |= more
            grown = bool(more)
        return frozenset(found)

    def _runs(self, runner: Runner) -> dict[str, float]:
        rates = runner.analysis.rates
        circles = _circles(rates)
        runs = dict.fromkeys(rates.sources, 0.0)
        for _ in range(len(runs) + 1):
            before = dict(runs)
            for handler in runner.analysis.program.handlers:
                label = handler.label
                if label in self.started[runner]:
                    runs[label] = self._own(runner, label, before, circles[label]) + self._from_things(
                        runner, handler.message.id, label, circles[label]
                    )
            if runs == before:
                break
        return runs

    def _own(self, runner: Runner, label: str, runs: Mapping[str, float], circle: frozenset[str]) -> float:
        """Runs by pulses, timers and messages of the script itself."""
        pulse = timer = math.inf
        timed = total = 0.0
        for source in runner.analysis.rates.sources[label]:
            senders = [s for s in source.senders if s in self.started[runner]]
            if source.off or source.site is None or not senders:
                continue
            if source.kind == "pulse":
                pulse = min(pulse, self._interval(source))
            elif source.kind in ("timer", "each timer"):
                again = _set_again(runner.analysis.rates, source, senders, circle)
                set_by = sum(self._passes(runner, s, source.site, runs) for s in senders if s not in circle)
                if source.kind == "timer":
                    timer = min(timer, self._interval(source))
                    timed = math.inf if again else timed + set_by
                else:
                    total += set_by + (1.0 / self._interval(source) if again else 0.0)
            elif source.kind in ("message", "trigger"):
                total += sum(self._passes(runner, s, source.site, runs) for s in senders if s not in circle)
        return total + 1.0 / pulse + min(timed, 1.0 / timer)

    def _passes(self, runner: Runner, label: str, site: Site, runs: Mapping[str, float]) -> float:
        passes = self.passes(runner, label, site)
        return (runs[label] * passes.per_run if runs[label] else 0.0) + passes.per_second

    def _from_things(self, runner: Runner, message: int, label: str, circle: frozenset[str]) -> float:
        """Runs by the pulses and timers of things: once for each thing."""
        total = 0.0
        for seconds, beats in self.beats_for(runner, message).values():
            if message == PULSE or any(self._lasts(runner, beat, label, circle) for beat in beats):
                total += 1.0 / max(seconds, self.frame)
        return total

    def _lasts(self, runner: Runner, beat: Beat, label: str, circle: frozenset[str]) -> bool:
        """Whether a thing's timer is set again and again."""
        if beat.runner is runner and ({label} | circle).intersection(beat.senders):
            return True
        runs = self.runs[beat.runner]
        return any(runs.get(sender, 0.0) > 0 for sender in beat.senders)

    def _interval(self, source: Source) -> float:
        return max(source.least, self.frame)


def _repeats(runner: Runner) -> Mapping[str, Mapping[int, Repeats]]:
    """For each handler's label, how often a run passes each block, other scripts left out."""
    each = runner.analysis
    counter = Counter(each.program, each.flow, each.reach, each.known, undisturbed=True)
    return {h.label: counter.of_handler(each.flow.label_block[h.label]) for h in each.program.handlers}


def _numbers(runner: Runner) -> frozenset[int]:
    return frozenset(thing.number for thing in runner.things)


def _beats(runner: Runner) -> Iterable[Beat]:
    """The pulses and timers that a script gives to things; to those that it runs for where it is not known which."""
    rates = runner.analysis.rates
    for site in rates.sites:
        message = THING_SENDERS.get(site.verb.name)
        if message is None or len(site.arguments) < 2:
            continue
        low, high = ranges.as_flex(site.arguments[1])
        if high <= 0:
            continue
        things: set[int] = set()
        for end in ends(runner, site, 0):
            things |= {end.number} if end.kind == "thing" else _numbers(runner)
        yield Beat(runner, site, message, max(low, 0.0), frozenset(things), rates.senders_of(site))


def _set_again(rates: Rates, source: Source, senders: Iterable[str], circle: frozenset[str]) -> bool:
    """Whether what a timer runs sets it again."""
    assert source.site is not None
    return any(s in circle and rates.repeats_of(s, source.site).per_run > 0 for s in senders)


def _circles(rates: Rates) -> Mapping[str, frozenset[str]]:
    """For each handler, those (it among them) that it leads to and that lead back to it."""
    leads: dict[str, set[str]] = {}
    for start in rates.arms:
        found: set[str] = set()
        pending = [start]
        while pending:
            for label in rates.arms[pending.pop()]:
                if label not in found:
                    found.add(label)
                    pending.append(label)
        leads[start] = found
    return {a: frozenset(b for b in leads[a] if a in leads[b]) for a in leads}
