"""Where bodies come to in a level: on foot, on lifts, and where scripts put them. More than the truth, never less.

As `jktools.facts.travel` has it for players, but for any body, and each by itself: whom a script puts somewhere is
followed. What is put where nobody knows can be anywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from jktools.facts.hotspots.ends import End
from jktools.facts.hotspots.runners import Runner
from jktools.facts.travel import PLAYER, Put, Ways, reached
from jktools.model import Level, Thing
from jktools.syntax.template.parameters import TYPES


class Roaming:
    """Of the bodies of one level."""

    def __init__(
        self, level: Level, ways: Ways, lifts: Iterable[frozenset[int]], puts: Sequence[Put], named: frozenset[int]
    ) -> None:
        """`ways` lead from sector to sector, `lifts` between those that they stop in; `named` are those that scripts
        which are not at hand may put bodies in.
        """
        self.level, self.ways, self.lifts, self.puts, self.named = level, ways, tuple(lifts), puts, named

    def sectors(self, things: Iterable[Thing]) -> list[int]:
        """The sectors that some bodies come to, ascending."""
        held = {thing.number: thing for thing in things}
        found: set[int] = set(self.named)
        pending = list(held.values())
        while pending:
            thing = pending.pop()
            found.add(thing.sector_index)
            for put in self.puts:
                if not any(_may_be(put.runner, end, thing) for end in put.whom):
                    continue
                if put.sectors is None:
                    return list(range(len(self.level.sectors)))
                found |= put.sectors
                fresh = [goal for goal in put.onto if goal.number not in held]
                held.update((goal.number, goal) for goal in fresh)
                pending += fresh
        return sorted(reached(self.ways, found, self.lifts))


def _may_be(runner: Runner, end: End, thing: Thing) -> bool:
    """Whether an end of a call can be a thing."""
    if end.kind == "thing":
        return end.number == thing.number
    if end.kind == PLAYER:
        return thing.resolved.type == PLAYER
    if end.kind == "seen":
        return bool(end.mask >> TYPES.index(thing.resolved.type) & 1)
    if end.kind == "carrier" and runner.cog is None and not runner.more:
        return any(each.number == thing.number for each in runner.things)
    return True
