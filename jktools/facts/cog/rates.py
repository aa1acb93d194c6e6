"""What sends a handler its message, and how often that can happen.

`pulse` and `SetTimer` come at most once an interval and once a frame, whatever the script does. A `SetTimerEx` comes
once for each call; so does what a script sends itself. Everything else is the level's or the player's doing. The
engine's clock counts whole milliseconds, and cuts what a script asks for: a pulse of 0.7 s, which as a flex is a little
less, comes every 699 ms (sithCogFunction_SetPulse in the decompiled engine).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import msgspec

from jktools.facts.cog import ranges
from jktools.facts.cog.counter import Counter
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.lowering import Flow, Op
from jktools.facts.cog.ranges import Range
from jktools.facts.cog.reach import Reach
from jktools.facts.cog.repeats import FRAMES_PER_SECOND, NEVER, Repeats
from jktools.facts.cog.stack import written
from jktools.model.cog.messages import ONCE
from jktools.model.cog.program import Handler, Program
from jktools.model.cog.verbs import Verb
from jktools.syntax.cog.nodes import Call, Name

PULSE, TIMER = 13, 4
STARTUP, LOADING = "startup", "loading"
TRIGGER = 40

SourceKind = Literal[
    "pulse", "timer", "each timer", "thing pulse", "thing timer", "message", "trigger", "once", "event"
]


@dataclass(frozen=True, slots=True)
class _Sending:
    kind: SourceKind
    message: int | None
    seconds: int | None
    """Which argument says when."""


_SENDERS = {
    "setpulse": _Sending("pulse", PULSE, 0),
    "settimer": _Sending("timer", TIMER, 0),
    "settimerex": _Sending("each timer", TIMER, 0),
    "setthingpulse": _Sending("thing pulse", PULSE, 1),
    "setthingtimer": _Sending("thing timer", TIMER, 1),
    "sendmessage": _Sending("message", None, None),
    "sendmessageex": _Sending("message", None, None),
    "sendmessageexradius": _Sending("message", None, None),
    "sendtrigger": _Sending("trigger", TRIGGER, None),
}
_ARMED: tuple[tuple[int, SourceKind, int], ...] = ((0x4, "pulse", PULSE), (0x8, "timer", TIMER))
"""Bits of a script's `flags` with which its pulse or timer is set from the start, for the first frame and each later
one: the engine keeps the same bits for what SetPulse and SetTimer set (sithCogScript_Tick in the decompiled engine)."""
LEAST_DELAY = -0.001
"""Seconds: SetTimerEx takes what is no whole millisecond below 0 (sithCogFunction_SetTimerEx)."""
_MESSAGE_ARGUMENT = {"sendmessage": 1, "sendmessageex": 1, "sendmessageexradius": 3}


class Site(msgspec.Struct, frozen=True):
    """A call of a verb that can run."""

    call: Call
    verb: Verb
    block: int
    arguments: tuple[Range, ...]


@dataclass(frozen=True, slots=True)
class Source:
    """One way in which a handler gets its message."""

    kind: SourceKind
    seconds: Range | None = None
    """The interval or delay that the call sets; None where there is none."""
    site: Site | None = None
    """None where no call sends it."""
    senders: tuple[str, ...] = ()
    """Labels of the handlers that lead to the call."""

    @property
    def least(self) -> float:
        """The shortest time between two of these messages; 0 where it can be as short as a frame."""
        if self.seconds is None:
            return 0.0
        return max(ranges.as_flex(self.seconds)[0], 0.0)

    @property
    def off(self) -> bool:
        """Whether the call can only switch the pulse or timer off."""
        if self.seconds is None or self.site is None:
            return False
        least, most = ranges.as_flex(self.seconds)
        if self.kind in ("thing pulse", "thing timer"):
            return least == most == 0  # what is below 0 comes every frame
        return most <= (LEAST_DELAY if self.kind == "each timer" else 0.0)


@dataclass(frozen=True, slots=True)
class HandlerCall:
    """A call as one handler comes to it."""

    label: str
    """Of the handler."""
    site: Site
    repeats: Repeats
    """How often a run of the handler makes the call, through its loops and the labels that it calls."""


class Rates:
    """Of all handlers of a script under one binding of its symbols."""

    def __init__(self, program: Program, flow: Flow, reach: Reach, known: Known) -> None:
        """Work out nothing yet."""
        self.program = program
        self.flow = flow
        self.reach = reach
        self.known = known
        self.counter = Counter(program, flow, reach, known)

    @cached_property
    def sites(self) -> tuple[Site, ...]:
        """Every call of a verb that can run, in the order of the code."""
        found = []
        for index in sorted(self.known.visited):
            for op, verb, node in self.flow.blocks[index].code:
                if op is Op.CALL and isinstance(node, Call):
                    found.append(Site(node, verb, index, self.known.arguments[node]))
        return tuple(found)

    @cached_property
    def repeats(self) -> Mapping[str, Mapping[int, Repeats]]:
        """For each handler's label, how often a run passes each block."""
        return self.repeats_by(self.counter)

    def repeats_by(self, counter: Counter, *, first: bool = True) -> Mapping[str, Mapping[int, Repeats]]:
        """The same as a counter has it; without `first`, `startup` may find other runs unfinished, as all others do."""
        return {
            h.label: counter.of_handler(self.flow.label_block[h.label], first=first and self.is_first(h))
            for h in self.program.handlers
        }

    def is_first(self, handler: Handler) -> bool:
        """Whether a handler runs once, and before all that the script can leave unfinished.

        The engine sends `loading` to every script, then `startup`, and then all the rest (sithCog_Open and
        sithMain_AutoSave in the decompiled engine). Other scripts may send something in between: that is not seen here.
        """
        sent = any(
            self._reaches(site, sending, handler)
            for site in self.sites
            if (sending := _SENDERS.get(site.verb.name)) is not None
        )
        others = [h for h in self.program.handlers if h is not handler]
        early = any(h.message.name == LOADING for h in others) and any(self.sleeps(h.label) for h in others)
        return handler.message.name == STARTUP and not sent and not early

    def sleeps(self, label: str) -> bool:
        """Whether a handler can sleep, or wait for a thing.

        Only then is a run of its script left unfinished when the engine goes on: its own, and those that it came on
        top of while they were in a verb.
        """
        return any(
            op is Op.CALL and verb.sleeps
            for index in self.reach.handler_blocks[label] & self.known.visited
            for op, verb, _ in self.flow.blocks[index].code
        )

    def repeats_of(self, label: str, site: Site) -> Repeats:
        """How often a call happens in the runs of a handler."""
        return self.repeats[label].get(site.block, NEVER)

    def senders_of(self, site: Site) -> tuple[str, ...]:
        """The handlers that lead to a call."""
        return tuple(label for label, passes in self.repeats.items() if site.block in passes)

    @cached_property
    def sight_calls(self) -> tuple[HandlerCall, ...]:
        """Every way to a verb of sight: handler by handler, in the order of the code.

        The cost of one call is `site.verb.sight`; what it looks from and at are `site.arguments`, and `most_runs` tells
        how often the handlers run.
        """
        return tuple(
            HandlerCall(label, site, self.repeats_of(label, site))
            for label in self.repeats
            for site in self.sites
            if site.verb.sight is not None and site.block in self.repeats[label]
        )

    @cached_property
    def sources(self) -> Mapping[str, tuple[Source, ...]]:
        """For each handler's label, all that can send its message."""
        found: dict[str, list[Source]] = {h.label: [] for h in self.program.handlers}
        for handler in self.program.handlers:
            found[handler.label] = [Source("once" if handler.message.name in ONCE else "event")]
            if handler.message.id in (PULSE, TIMER):
                found[handler.label] = [
                    Source(kind, ranges.FALSE)
                    for bit, kind, message in _ARMED
                    if self.program.header.flags & bit and message == handler.message.id
                ]
        for site in self.sites:
            sending = _SENDERS.get(site.verb.name)
            if sending is None:
                continue
            seconds = None if sending.seconds is None else site.arguments[sending.seconds]
            senders = self.senders_of(site)
            for handler in self.program.handlers:
                if self._reaches(site, sending, handler):
                    found[handler.label].append(Source(sending.kind, seconds, site, senders))
        return {label: tuple(each) for label, each in found.items()}

    def _reaches(self, site: Site, sending: _Sending, handler: Handler) -> bool:
        if sending.message is not None:
            return sending.message == handler.message.id
        at = _MESSAGE_ARGUMENT[site.verb.name]
        low, high = ranges.as_int(site.arguments[at])
        return low <= handler.message.id <= high and (site.verb.name == "sendmessageexradius" or self._to_self(site))

    def _to_self(self, site: Site) -> bool:
        """Whether a message can come back to this script.

        A cog symbol that nothing assigns means another script: a level that binds one to itself is not thought of.
        """
        target = written(self.program, site.call)[0]
        if isinstance(target, Name):
            slot = self.program.slot_of.get(target.name)
            return slot is None or slot.type != "cog" or self.counter.counting.is_stored(slot.index)
        return True

    @cached_property
    def arms(self) -> Mapping[str, frozenset[str]]:
        """For each handler's label, the handlers whose messages its code can cause."""
        found: dict[str, set[str]] = {h.label: set() for h in self.program.handlers}
        for label, sources in self.sources.items():
            for source in sources:
                for sender in () if source.off else source.senders:
                    found[sender].add(label)
        return {label: frozenset(each) for label, each in found.items()}

    def most_runs(
        self,
        seconds: float,
        events: Mapping[str, float],
        *,
        things: float = 0.0,
        frames: float = FRAMES_PER_SECOND,
    ) -> dict[str, float]:
        """The greatest number of runs of each handler in so many seconds; infinite where nothing bounds it.

        `events` counts, by label, what comes from outside the script; `things` is how many things can carry a pulse
        or timer that this script gets, `frames` the game's frames per second.
        """
        found = {label: events.get(label, 0.0) for label in self.sources}
        pending = set(self.sources)
        while pending:  # senders first: what is left over sends itself in a circle
            ready = sorted(
                label
                for label in pending
                if not any(s in pending and s != label for source in self.sources[label] for s in self._counted(source))
            )
            for label in ready or sorted(pending):
                found[label] += self._runs(label, seconds, found, things, frames) if ready else math.inf
            pending -= set(ready or pending)
        return found

    def _counted(self, source: Source) -> tuple[str, ...]:
        """The handlers whose runs count for a source."""
        return source.senders if source.kind in ("each timer", "message", "trigger") else ()

    def _runs(self, label: str, seconds: float, runs: Mapping[str, float], things: float, frames: float) -> float:
        total = 0.0
        least: dict[str, float] = {}
        chain: float | None = None
        for source in self.sources[label]:
            if source.off:
                continue
            if source.kind in ("pulse", "timer", "thing pulse", "thing timer"):
                shortest = apart(source.least, 1 / frames)
                least[source.kind] = min(least.get(source.kind, math.inf), shortest)
            elif source.site is not None:
                for sender in source.senders:
                    passes = self.repeats_of(sender, source.site)
                    if passes.per_interruption:
                        return math.inf  # every message, this one too, can bring one more
                    if sender != label:
                        total += passes.most(runs[sender], seconds)
                    elif source.kind == "each timer" and passes.per_run <= 1 and chain is None:
                        chain = apart(source.least, 1 / frames)
                    else:
                        return math.inf
        for kind, shortest in least.items():
            total += (things if kind.startswith("thing") else 1.0) * (seconds / shortest + 1)
        if chain is not None:
            total = (total + runs[label]) * (seconds / chain + 1)
        return total


def apart(seconds: float, frame: float) -> float:
    """The least time between two messages of a clock that is set to so many seconds, in seconds."""
    return max(math.floor(seconds * 1000.0) / 1000.0, frame) if seconds < math.inf else seconds


def describe_seconds(seconds: Range) -> str:
    """For messages: `0.5 s`, `0.1 to 2 s`, `an unknown time`."""
    low, high = ranges.as_flex(seconds)
    if low == high:
        return f"{low:.6g} s"
    if math.isinf(low) and math.isinf(high):
        return "an unknown time"
    if math.isinf(high):
        return f"{low:.6g} s or more"
    return f"up to {high:.6g} s" if math.isinf(low) else f"{low:.6g} to {high:.6g} s"
