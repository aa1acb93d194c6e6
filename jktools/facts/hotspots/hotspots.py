"""Sight hotspots: which scripts ask for sight, how often, at what cost, and with what outcome.

The cost is counted work, so that it depends on no machine: the sectors entered and the surfaces tested along the real
segments. An end that moves is tried at the middle of every sector that it can come to. What cannot be known is told as
such: how often the player causes a message, how many things play creates.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

import numpy as np

from jktools.engine.profile import Engine
from jktools.facts.cog import ranges
from jktools.facts.cog.counting import MOST_SEEN
from jktools.facts.cog.rates import Site
from jktools.facts.cog.repeats import FRAMES_PER_SECOND
from jktools.facts.hotspots.ends import ANY_TYPE, FLOODS, NEXT, End, ends, seen_mask
from jktools.facts.hotspots.pace import Paces
from jktools.facts.hotspots.runners import Runner
from jktools.facts.hotspots.verdicts import Verdict, Verdicts
from jktools.facts.hotspots.work import Place, SightWork, Work
from jktools.model import Level, Thing
from jktools.syntax.template.parameters import TYPES

_T = TypeVar("_T")

MOST_PAIRS = 4096
"""Pairs of places that are tried for one call; of more, evenly spread ones."""
SIGHT_COSTS = frozenset({"ray", "flood"})
BODIES = ("actor", "player")


class Cost(NamedTuple):
    """Counted work of one call."""

    mean_sectors: float
    mean_surfaces: float
    most_sectors: int
    most_surfaces: int
    pairs: int
    """Pairs of places that were tried; 0 where nothing is known of the ends."""


@dataclass(frozen=True, slots=True)
class Hotspot:
    """One call of a verb of sight, in one running script."""

    runner: Runner
    site: Site
    handlers: Mapping[str, float]
    """The handlers that lead to it, with their runs a second that last."""
    per_run: Mapping[str, float]
    """Most calls in one run of each."""
    calls_per_second: float
    """At most, of what is known and lasts; infinite where nothing bounds the calls."""
    cost: Cost
    verdicts: Mapping[Engine, Verdict]
    """What it finds, by profile."""
    pulse: float
    """The shortest interval, in seconds, that what lasts on the way there asks for, a pulse, a timer, a sleep in a
    loop; infinite without one."""
    more: bool = False
    """Whether there can be more calls than is known: by things that play creates, or by COGs that are not known."""
    endless: bool = False
    """Whether a loop around it is sure never to end."""
    causes: tuple[str, ...] = ()
    """The messages from the player or the world each of which can make more calls: `touched`, `touched of cog 3`."""

    @property
    def verdict(self) -> Verdict:
        """What it finds, where both profiles agree; else it varies."""
        found = set(self.verdicts.values())
        return found.pop() if len(found) == 1 else Verdict.VARIES

    @property
    def finds(self) -> str | None:
        """For messages: `always succeeds`, or what it does by each profile; None where it varies by both."""
        verb = {Verdict.ALWAYS: "always succeeds", Verdict.NEVER: "never succeeds", Verdict.VARIES: "varies"}
        if self.verdict is not Verdict.VARIES:
            return verb[self.verdict]
        told = sorted(self.verdicts.items(), key=lambda each: each[1] is Verdict.VARIES)
        known = [f"{verb[verdict]} by {engine}" for engine, verdict in told]
        return " and ".join(known) if told[0][1] is not Verdict.VARIES else None

    @property
    def surfaces_per_second(self) -> float:
        """Surface tests a second, on the mean; infinite where nothing bounds the calls, whatever one costs."""
        calls = self.calls_per_second
        return calls * self.cost.mean_surfaces if 0 < calls < math.inf else calls

    @property
    def lasts(self) -> bool:
        """Whether there are calls for as long as the level runs, or in a loop that never ends."""
        return self.endless or any(runs > 0 for runs in self.handlers.values()) or 0 < self.calls_per_second < math.inf

    @property
    def is_counted(self) -> bool:
        """Whether it is known how often it is called: a loop around it is bounded, or sure never to end."""
        return self.endless or self.calls_per_second < math.inf

    @property
    def help(self) -> str:
        """What would make it cheaper."""
        if self.verdict is not Verdict.VARIES:
            return "the outcome is known beforehand: leave the test out"
        if math.isinf(self.calls_per_second):
            return "end the loop after a known number of turns, or sleep in the loop itself"
        if self.pulse < math.inf and self.runner.cog is None and len(self.runner.things) > 1:
            return "test less often, and only for things that the player is near"
        if self.pulse < math.inf:
            return "test less often, or test the distance first"
        return "keep the answer for some time, or test the distance first"


class Scene:
    """What the hotspots of a level are worked out from."""

    def __init__(
        self,
        level: Level,
        runners: Sequence[Runner],
        work: SightWork,
        verdicts: Verdicts,
        comes_to: Callable[[Iterable[Thing]], Iterable[int]],
        created: frozenset[str] = frozenset(),
        frames: float = FRAMES_PER_SECOND,
    ) -> None:
        """`frames` are the game's a second, which no pulse outruns; `created` the templates that play creates.

        `comes_to` tells the sectors that bodies come to.
        """
        self.comes_to = comes_to
        self.level, self.runners, self.work, self.verdicts = level, tuple(runners), work, verdicts
        self.created = [r.type for name in sorted(created) if (r := level.resolved_templates.get(name)) is not None]
        self.placed = [t for t in level.things if t.dropped is None and np.isfinite(t.position).all()]
        self.by_number = {thing.number: thing for thing in self.placed}
        self._roaming: dict[frozenset[int], list[Place]] = {}
        self.paces = Paces(runners, frames, self._most_seen)

    def hotspots(self) -> list[Hotspot]:
        """All of them, the dearest first."""
        found = [
            self._hotspot(runner, site)
            for runner in self.runners
            for site in runner.analysis.rates.sites
            if site.verb.sight in SIGHT_COSTS
        ]
        return sorted(found, key=lambda h: (-h.surfaces_per_second, h.runner.place, h.site.call.start))

    def _hotspot(self, runner: Runner, site: Site) -> Hotspot:
        paces = self.paces
        labels = paces.labels(runner, site)
        per_run = {label: paces.passes(runner, label, site).per_run for label in labels}
        calls = [paces.calls(runner, label, site) for label in labels]
        lasting = math.inf if any(math.isinf(c.once) for c in calls) else math.fsum(c.rate for c in calls)
        cost, verdicts = self._flood(runner, site) if site.verb.sight == "flood" else self._rays(runner, site)
        return Hotspot(
            runner,
            site,
            {label: paces.runs_of(runner, label) for label in labels},
            per_run,
            lasting,
            cost,
            verdicts,
            min((paces.asked(runner, label, site) for label in labels), default=math.inf),
            any(paces.is_open(runner, label, site) for label in labels),
            any(paces.is_endless(runner, label, site) for label in labels),
            self._causes(runner, labels),
        )

    def _causes(self, runner: Runner, labels: Iterable[str]) -> tuple[str, ...]:
        found = dict.fromkeys(node for label in labels for node in self.paces.causes(runner, label))
        return tuple(n.label if n.runner is runner else f"{n.label} of {n.runner.title}" for n in found)

    def _most_seen(self, runner: Runner) -> int:
        """How many things a walk through the things in view can come to: those of the types that the script looks for.

        One at least: a walk may start with a thing that it has from elsewhere. A handler that begins no list of its own
        walks through whatever another has left.
        """
        rates = runner.analysis.rates
        begins, goes_on = (
            {label for site in rates.sites if site.verb.name in names for label in rates.senders_of(site)}
            for names in (FLOODS, NEXT)
        )
        mask = seen_mask(runner)
        if not goes_on <= begins or any(mask >> TYPES.index(created) & 1 for created in self.created):
            return MOST_SEEN
        found = sum(1 for thing in self.placed if mask >> TYPES.index(thing.resolved.type) & 1)
        return min(max(found, 1), MOST_SEEN)

    # ---- cost and verdict

    def _flood(self, runner: Runner, site: Site) -> tuple[Cost, Mapping[Engine, Verdict]]:
        distance = ranges.as_flex(site.arguments[2])[1] if len(site.arguments) > 2 else math.inf
        places = [place for end in sorted(ends(runner, site, 0)) for place in self._places(runner, end)]
        cost = _cost([self.work.flood(place, distance) for place in _spread(places, MOST_PAIRS)])
        return cost, dict.fromkeys(Engine, Verdict.VARIES)

    def _rays(self, runner: Runner, site: Site) -> tuple[Cost, Mapping[Engine, Verdict]]:
        sides = [sorted(ends(runner, site, argument)) for argument in range(2)]
        places = [[place for end in side for place in self._places(runner, end)] for side in sides]
        works = [self.work.ray(a, b) for a, b in _pairs(*places)]
        return _cost(works), self.verdicts.of(runner, sides)

    def _places(self, runner: Runner, end: End) -> list[Place]:
        """Where an end can be; nothing where that is not known."""
        if end.kind == "thing":
            thing = self.by_number.get(end.number)
            things = [] if thing is None else [thing]
        elif end.kind == "carrier":
            things = list(runner.things)
        elif end.kind == "player":
            things = [thing for thing in self.placed if thing.resolved.type == "player"]
        else:
            mask = end.mask if end.kind == "seen" else ANY_TYPE
            things = [thing for thing in self.placed if mask >> TYPES.index(thing.resolved.type) & 1]
        stay = [_place(thing) for thing in things if not _roams(thing) and np.isfinite(thing.position).all()]
        return stay + self._roam([thing for thing in things if _roams(thing)])

    def _roam(self, bodies: Sequence[Thing]) -> list[Place]:
        """The middle of every sector that bodies come to; nothing without a body."""
        numbers = frozenset(body.number for body in bodies)
        if numbers not in self._roaming:
            centres = self.work.centres
            self._roaming[numbers] = [
                Place(i, (float(centres[i, 0]), float(centres[i, 1]), float(centres[i, 2])))
                for i in (self.comes_to(bodies) if bodies else ())
                if np.isfinite(centres[i]).all()
            ]
        return self._roaming[numbers]


def _place(thing: Thing) -> Place:
    x, y, z = thing.position.tolist()
    return Place(thing.sector_index, (x, y, z))


def _roams(thing: Thing) -> bool:
    return thing.resolved.type in BODIES and thing.resolved.move == "physics"


def _spread(items: Sequence[_T], most: int) -> Sequence[_T]:
    """At most so many, evenly spread."""
    if len(items) <= most:
        return items
    return [items[i * len(items) // most] for i in range(most)]


def _pairs(origins: Sequence[Place], targets: Sequence[Place]) -> list[tuple[Place, Place]]:
    """At most so many pairs, evenly spread over all."""
    total = len(origins) * len(targets)
    chosen = range(total) if total <= MOST_PAIRS else (i * total // MOST_PAIRS for i in range(MOST_PAIRS))
    return [(origins[i // len(targets)], targets[i % len(targets)]) for i in chosen]


def _cost(works: Sequence[Work]) -> Cost:
    if not works:
        return Cost(0.0, 0.0, 0, 0, 0)
    return Cost(
        math.fsum(work.sectors for work in works) / len(works),
        math.fsum(work.surfaces for work in works) / len(works),
        max(work.sectors for work in works),
        max(work.surfaces for work in works),
        len(works),
    )
