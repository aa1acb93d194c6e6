"""Between which things a script looks: what the expressions that it hands to a verb can stand for."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

from jktools.facts.cog import ranges
from jktools.facts.cog.rates import Site
from jktools.facts.hotspots.runners import Runner
from jktools.syntax.cog.nodes import Assign, Call, Expression, Index, Name

ANY_TYPE = 0xFFFFFFFF

Kind = Literal["thing", "carrier", "player", "seen", "any"]

_CARRIER = frozenset({"getsenderref", "getsourceref"})
_PLAYER = frozenset({"getlocalplayerthing", "jkgetlocalplayer"})
FLOODS = frozenset({"firstthinginview", "firstthingincone"})
NEXT = frozenset({"nextthinginview", "nextthingincone"})


class End(NamedTuple):
    """One thing, or some of a kind, at an end of a sight test."""

    kind: Kind
    """`carrier`: whoever sent the message; `seen`: what FirstThingInView found; `any`: not known."""
    number: int = -1
    """Of a `thing`."""
    mask: int = 0
    """Types of what is `seen`, one bit a type."""


def ends(runner: Runner, site: Site, argument: int) -> frozenset[End]:
    """What an argument of a call can be; empty where it is always none."""
    if argument >= len(site.arguments) or argument >= len(site.call.arguments):
        return frozenset({End("any")})
    number = site.arguments[argument].number
    if number is not None:
        return frozenset({End("thing", int(number))}) if number >= 0 else frozenset()
    return frozenset(_Tracing(runner).run(site.call.arguments[argument]))


def seen_mask(runner: Runner) -> int:
    """The types that the script looks for with FirstThingInView, one bit a type."""
    mask = 0
    for site in runner.analysis.rates.sites:
        if site.verb.name in FLOODS and len(site.arguments) > 3:
            number = site.arguments[3].number
            mask |= ANY_TYPE if number is None else int(number) & ANY_TYPE
    return mask


class _Tracing:
    """Follows variables back to what is assigned to them, anywhere in the script."""

    def __init__(self, runner: Runner) -> None:
        self.runner = runner
        self.program = runner.analysis.program
        self.pending: list[Expression] = []
        self.slots: set[int] = set()

    def run(self, expression: Expression) -> Iterator[End]:
        self.pending.append(expression)
        while self.pending:
            yield from self.step(self.pending.pop())

    def step(self, at: Expression) -> Iterator[End]:
        if isinstance(at, Assign):
            self.pending.append(at.value)
        elif isinstance(at, Call):
            yield from self.called(at)
        elif isinstance(at, Name) and at.name in self.program.slot_of:
            yield from self.slot(self.program.slot_of[at.name].index)
        elif isinstance(at, Index) and isinstance(at.base, Name) and at.base.name in self.program.slot_of:
            yield from self.entries(at, self.program.slot_of[at.base.name].index)
        else:
            yield End("any")

    def called(self, call: Call) -> Iterator[End]:
        verb = self.program.verb_of(call)
        name = verb.name if verb is not None else ""
        if name in _CARRIER:
            yield End("carrier")
        elif name in _PLAYER:
            yield End("player")
        elif name in FLOODS or name in NEXT:
            yield End("seen", mask=seen_mask(self.runner))
        else:
            yield End("any")

    def entries(self, at: Index, base: int) -> Iterator[End]:
        index = self.runner.analysis.known.indices.get(at)
        low, high = (ranges.INT_MIN, ranges.INT_MAX) if index is None else ranges.as_int(index)
        last = min(base + high, len(self.program.slots) - 1)
        if base + low < 0 or high == ranges.INT_MAX:
            yield End("any")
            return
        for slot in range(base + low, last + 1):
            yield from self.slot(slot)

    def slot(self, slot: int) -> Iterator[End]:
        if slot in self.slots:
            return
        self.slots.add(slot)
        held = self.program.slots[slot]
        assigned = [v for s, v in _stores(self.runner) if s is None or s == slot]
        if not assigned or held.takes_value:
            start = self.runner.analysis.known.invariant[slot] if not assigned else None
            number = start.number if start is not None else self.bound(slot)
            if number is None:
                yield End("any")
            elif number >= 0:
                yield End("thing", int(number))
        self.pending += assigned

    def bound(self, slot: int) -> float | None:
        value = (self.runner.analysis.bound or {}).get(slot, -1)
        return value if isinstance(value, int) else None


def _stores(runner: Runner) -> Iterator[tuple[int | None, Expression]]:
    """Each assignment: its slot, None for any of an array, and the value."""
    program = runner.analysis.program
    for part in program.expressions:
        if isinstance(part, Assign):
            if isinstance(part.target, Name):
                held = program.slot_of.get(part.target.name)
                if held is not None:
                    yield held.index, part.value
            else:
                yield None, part.value
