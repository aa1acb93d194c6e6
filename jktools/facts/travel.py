"""Which sectors players come to: through adjoins, on lifts, and where scripts put them. More than the truth, never less.

| way | leads |
|---|---|
| an adjoin with flag 0x2 and without 0x10 | into the sector behind it, and not back: the mirror has flags of its own |
| an adjoin that a placed script can give 0x2, or take 0x10 from | the same |
| a thing on a path | from each of its places to each other |
| `TeleportThing(a, b)` | to the sector of b, wherever a was |
| `JumpToFrame(a, frame, sector)` | to that sector |
| the values of a script that is not at hand | to what each number can mean: a sector, a surface's, a thing's |

What is not known leads nowhere that can be told: then nothing is said of the level at all. So it is where a script
sets the place of a player by a vector, or teleports to a thing that it finds or that moves by physics.

Source: sithCollision_SearchForSurfaceCollisions, sithCollision_MoveThing and sithCogFunctionThing in the decompiled
engine, which holds whoever rides on a lift at adjoins that it does not pass by itself: lifts are counted all the same.
Steps, heights and falls are not: a hole in the ceiling counts as a way up.
"""  # noqa: E501 (a table)

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.cog.rates import Site
from jktools.facts.hotspots.ends import End, ends
from jktools.facts.hotspots.runners import Runner
from jktools.facts.movers import Mover
from jktools.facts.openings import MOVEMENT, NOT_FOR_PLAYERS
from jktools.geometry.mesh import SectorMesh
from jktools.geometry.validity import Int32
from jktools.model import Level, Thing
from jktools.model.cog.values import to_int


class Put(NamedTuple):
    """A call that sets the place of things."""

    runner: Runner
    whom: frozenset[End]
    """Whom it puts there."""
    sectors: frozenset[int] | None
    """Where; None where that is not known."""
    onto: tuple[Thing, ...] = ()
    """Where things are by then that move."""


Ways = Sequence[Sequence[int]]
"""From each sector, those that a body comes to from there at once."""

PLAYER = "player"
TELEPORT = "teleportthing"
JUMP = "jumptoframe"
BY_VECTOR = frozenset({"setthingpos", "setthingposex"})


def passages(level: Level, enterable: Int32, freed: Int32) -> list[list[int]]:
    """The ways of a player through adjoins.

    `enterable` are the surfaces that scripts may let things through, `freed` those that they may let players through.
    """
    found: list[list[int]] = [[] for _ in range(len(level.sectors))]
    flags = level.document.adjoins.flags
    owner, adjoin = level.surface_sector, level.document.surfaces.adjoin
    opens, frees = np.zeros((2, len(level.surfaces)), np.bool_)
    opens[enterable], frees[freed] = True, True
    for surface in np.flatnonzero((adjoin >= 0) & (adjoin < len(level.adjoins)) & (owner >= 0)).tolist():
        index = int(adjoin[surface])
        behind, held = int(level.adjoin_sector[index]), int(flags[index])
        passes = held & MOVEMENT or opens[surface]
        if behind >= 0 and passes and (not held & NOT_FOR_PLAYERS or frees[surface]):
            found[int(owner[surface])].append(behind)
    return found


def rides(mesh: SectorMesh, movers: Iterable[Mover]) -> Iterator[frozenset[int]]:
    """For each thing on a path, the sectors that its place and its frames lie in."""
    for mover in movers:
        located = mesh.locate(mover.positions).tolist() if len(mover.positions) else []
        yield frozenset(sector for sector in [mover.thing.sector_index, *located] if sector >= 0)


def landings(level: Level, instances: Iterable[InstanceFacts], runners: Iterable[Runner]) -> frozenset[int] | None:
    """The sectors that scripts put things in; None where a script may put a player where nobody knows."""
    things = _placed(level)
    found = set(named_by_unread(level, instances))
    for put in puts(level, runners):
        if put.sectors is None or any(thing.resolved.type != PLAYER for thing in put.onto):
            if any(_is_player(end, things) for end in put.whom):
                return None
        else:
            found |= put.sectors
    return frozenset(sector for sector in found if 0 <= sector < len(level.sectors))


def puts(level: Level, runners: Iterable[Runner]) -> list[Put]:
    """The calls of running scripts that set the place of things."""
    things = _placed(level)
    found = (_put(runner, site, things) for runner in runners for site in runner.analysis.rates.sites)
    return [put for put in found if put is not None]


def named_by_unread(level: Level, instances: Iterable[InstanceFacts]) -> frozenset[int]:
    """The sectors that the values of scripts which are not at hand can mean."""
    things = _placed(level)
    unread = [instance for instance in instances if instance.script is None]
    found = {sector for instance in unread for sector in _named(level, things, instance.cog.values)}
    return frozenset(sector for sector in found if 0 <= sector < len(level.sectors))


def _placed(level: Level) -> dict[int, Thing]:
    return {thing.number: thing for thing in level.things if thing.dropped is None}


def reached(ways: Ways, starts: Iterable[int], lifts: Iterable[frozenset[int]] = ()) -> frozenset[int]:
    """The sectors that a body comes to from some."""
    found = {sector for sector in starts if 0 <= sector < len(ways)}
    stops: dict[int, list[frozenset[int]]] = {}
    for lift in lifts:
        for sector in lift:
            stops.setdefault(sector, []).append(lift)
    pending = sorted(found)
    while pending:
        sector = pending.pop()
        for behind in [*ways[sector], *(stop for lift in stops.get(sector, ()) for stop in lift)]:
            if behind not in found:
                found.add(behind)
                pending.append(behind)
    return frozenset(found)


def _named(level: Level, things: dict[int, Thing], values: Iterable[str]) -> set[int]:
    """What the numbers on the line of an unread script can mean."""
    found: set[int] = set()
    for text in values:
        if text.isdecimal() and len(text) < 10:
            number = int(text)
            found.add(number)
            if number in things:
                found.add(things[number].sector_index)
            if number < len(level.surfaces):
                found.add(int(level.surface_sector[number]))
    return found


def _put(runner: Runner, site: Site, things: dict[int, Thing]) -> Put | None:
    """What a call does to the place of things; None for a call that leaves it."""
    name = site.verb.name
    if name == TELEPORT:
        sectors, onto = _goals(runner, site, 1, things)
        return Put(runner, ends(runner, site, 0), sectors, onto)
    if name == JUMP and len(site.arguments) > 2:
        number = site.arguments[2].number
        held = set(_values(runner, "sector")) if number is None else {to_int(number)}
        return Put(runner, frozenset({End("any")}), frozenset(held))  # and whoever rides on it
    unknown = name in BY_VECTOR or (
        site.verb.game == "user" and any(argument.kind in ("thing", "sector") for argument in site.verb.args)
    )
    return Put(runner, ends(runner, site, 0), None) if unknown else None


def _goals(
    runner: Runner, site: Site, argument: int, things: dict[int, Thing]
) -> tuple[frozenset[int] | None, tuple[Thing, ...]]:
    """The sectors of the things that an argument can be, None where they are not known, and those that move."""
    found: list[Thing] = []
    for end in ends(runner, site, argument):
        if end.kind == "carrier" and runner.cog is None and not runner.more:
            found += runner.things
        elif end.kind == "thing":
            found += [things[end.number]] if end.number in things else []
        elif end.kind == PLAYER:
            found += [thing for thing in things.values() if thing.resolved.type == PLAYER]
        else:
            return None, ()
    still = frozenset(thing.sector_index for thing in found if thing.resolved.move != "physics")
    return still, tuple(thing for thing in found if thing.resolved.move == "physics")


def _is_player(end: End, things: dict[int, Thing]) -> bool:
    return end.kind != "thing" or (end.number in things and things[end.number].resolved.type == PLAYER)


def _values(runner: Runner, kind: str) -> Iterator[int]:
    for slot in runner.analysis.program.slots:
        value = (runner.analysis.bound or {}).get(slot.index)
        if slot.type == kind and isinstance(value, int):
            yield value
