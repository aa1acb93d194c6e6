"""Surfaces whose adjoins COGs may open, to sight or to things."""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.cog.ranges import Range
from jktools.geometry.validity import Int32
from jktools.model import Level
from jktools.model.cog.values import to_int

Numbers = npt.NDArray[np.int64]

VISIBLE = 0x1
"""Of an adjoin's flags: sight passes."""
MOVEMENT = 0x2
"""Of an adjoin's flags: things pass."""
NOT_FOR_PLAYERS = 0x10
"""Of an adjoin's flags: it holds players, though things pass (sithCollision_MoveThing in the decompiled engine)."""
SURFACE_VERBS = frozenset({"setadjoinflags"})
CLEARING_VERBS = frozenset({"clearadjoinflags"})
SECTOR_VERBS = frozenset({"sectoradjoins", "setsectoradjoins"})
_NUMBER = re.compile(r"\+?\d{1,9}")


def opened_by_cogs(level: Level, instances: Iterable[InstanceFacts], flag: int) -> Int32:
    """Find the surfaces whose adjoins the placed COGs can give a flag, sorted.

    Of a script that can be read, those that SetAdjoinFlags can be called on with that flag, and all of a sector that
    SectorAdjoins can be called on to switch them on. Where the flow tells no single number, the numbers of the COG's
    line that it allows are taken: a script that finds or computes the number of a surface that its line does not hold
    is not foreseen. A script that the engine refuses opens nothing.

    What the values of a script mean that is not at hand is not known: each number counts as a surface and as a sector.
    With each surface goes the one on the other side of its adjoin.
    """
    named = np.zeros(len(level.surfaces), np.bool_)
    for instance in instances:
        numbers = _numbers(instance.cog.values)
        if instance.script is None:
            _take(level, named, numbers, numbers)
        for site in instance.analysis.rates.sites if instance.analysis is not None else ():
            if len(site.arguments) < 2:
                continue
            which, how = site.arguments[:2]
            if site.verb.name in SURFACE_VERBS and _may_hold(how, flag):
                _take(level, named, _allowed(which, numbers), np.zeros(0, np.int64))
            elif site.verb.name in SECTOR_VERBS and how.number != 0:
                _take(level, named, np.zeros(0, np.int64), _allowed(which, numbers))
    return np.flatnonzero(_both_sides(level, named)).astype(np.int32)


def cleared_by_cogs(level: Level, instances: Iterable[InstanceFacts], flag: int) -> Int32:
    """Find the surfaces whose adjoins the placed COGs can take a flag from, sorted: as `opened_by_cogs` finds them."""
    named = np.zeros(len(level.surfaces), np.bool_)
    for instance in instances:
        numbers = _numbers(instance.cog.values)
        if instance.script is None:
            _take(level, named, numbers, np.zeros(0, np.int64))
        for site in instance.analysis.rates.sites if instance.analysis is not None else ():
            if site.verb.name in CLEARING_VERBS and len(site.arguments) > 1 and _may_hold(site.arguments[1], flag):
                _take(level, named, _allowed(site.arguments[0], numbers), np.zeros(0, np.int64))
    return np.flatnonzero(named).astype(np.int32)


def _numbers(values: Iterable[str]) -> Numbers:
    return np.unique(np.array([int(value) for value in values if _NUMBER.fullmatch(value)], np.int64))


def _may_hold(flags: Range, flag: int) -> bool:
    return flags.number is None or bool(to_int(flags.number) & flag)


def _allowed(which: Range, numbers: Numbers) -> Numbers:
    """The numbers that an argument can be: the one that is known, or those of the line within its bounds."""
    if which.number is not None:
        return np.array([to_int(which.number)], np.int64)
    return numbers[(numbers >= which.low) & (numbers <= which.high)]


def _take(level: Level, named: npt.NDArray[np.bool_], surfaces: Numbers, sectors: Numbers) -> None:
    """Mark surfaces, and all surfaces of sectors; numbers out of bounds mean nothing."""
    table = level.document.sectors
    named[surfaces[(surfaces >= 0) & (surfaces < len(named))]] = True
    for sector in sectors[(sectors >= 0) & (sectors < len(level.sectors))].tolist():
        first = max(0, int(table.first_surface[sector]))
        named[first : max(first, first + int(table.surface_count[sector]))] = True


def _both_sides(level: Level, named: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    adjoins, out = level.document.adjoins, named.copy()
    adjoin = level.document.surfaces.adjoin[named]
    adjoin = adjoin[(adjoin >= 0) & (adjoin < len(adjoins.mirror))]
    mirror = adjoins.mirror[adjoin]
    other = level.adjoin_surface[mirror[(mirror >= 0) & (mirror < len(adjoins.mirror))]]
    out[other[(other >= 0) & (other < len(named))]] = True
    return out
