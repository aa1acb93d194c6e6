"""Sectors that no player comes to."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.validity import Int32
from jktools.model import Level, Thing

ADJOIN_MOVEMENT = 0x2
ITEM = "item"


class Island(NamedTuple):
    """Sectors that hang together, none of which a player comes to."""

    sectors: tuple[int, ...]
    items: tuple[Thing, ...]


def islands(level: Level, openable: Int32) -> list[Island]:
    """The parts of a level that no player start leads to, in the order of their first sector.

    Through adjoins that let things pass or that scripts can open. What a value of a placed COG can name, a sector, a
    surface or a thing, counts as reached: the script may take the player there. Nothing is an island in a level
    without a player start.
    """
    neighbours = _neighbours(level, openable)
    starts = {t.sector_index for t in level.things if t.dropped is None and t.resolved.type == "player"}
    if not starts:
        return []
    reached = _from(starts | _named(level), neighbours)
    found = []
    seen = set(reached)
    items: dict[int, list[Thing]] = {}
    for thing in level.things:
        if thing.dropped is None and thing.resolved.type == ITEM:
            items.setdefault(thing.sector_index, []).append(thing)
    for sector in range(len(level.sectors)):
        if sector not in seen:
            part = _from({sector}, neighbours)
            seen |= part
            inside = tuple(sorted(part))
            found.append(Island(inside, tuple(t for s in inside for t in items.get(s, ()))))
    return found


def _neighbours(level: Level, openable: Int32) -> list[list[int]]:
    """Both ways round, so that a part that a one-way adjoin leads out of is no second island."""
    found: list[list[int]] = [[] for _ in range(len(level.sectors))]
    opens = np.zeros(len(level.surfaces), np.bool_)
    opens[openable] = True
    owner, adjoin = level.surface_sector, level.document.surfaces.adjoin
    for surface in np.flatnonzero((adjoin >= 0) & (adjoin < len(level.adjoins)) & (owner >= 0)).tolist():
        index = int(adjoin[surface])
        behind = int(level.adjoin_sector[index])
        if behind >= 0 and (int(level.document.adjoins.flags[index]) & ADJOIN_MOVEMENT or opens[surface]):
            found[int(owner[surface])].append(behind)
            found[behind].append(int(owner[surface]))
    return found


def _named(level: Level) -> set[int]:
    things = {thing.number: thing.sector_index for thing in level.things if thing.dropped is None}
    found: set[int] = set()
    for cog in level.cogs:
        for text in cog.values:
            if text.isdecimal() and len(text) < 10:
                number = int(text)
                found.add(number)
                found.add(things.get(number, -1))
                if number < len(level.surfaces):
                    found.add(int(level.surface_sector[number]))
    return {sector for sector in found if 0 <= sector < len(level.sectors)}


def _from(starts: set[int], neighbours: list[list[int]]) -> set[int]:
    reached = set(starts)
    pending = list(starts)
    while pending:
        for sector in neighbours[pending.pop()]:
            if sector not in reached:
                reached.add(sector)
                pending.append(sector)
    return reached
