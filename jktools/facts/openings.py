"""Surfaces that COGs may make see-through."""

from __future__ import annotations

import re

import numpy as np

from jktools.geometry.validity import Int32
from jktools.model import Level

_NUMBER = re.compile(r"\+?\d{1,9}")


def named_by_cogs(level: Level) -> Int32:
    """Find the surfaces that a value of a placed COG can name, sorted, as long as the scripts are not read.

    What a value means only its script tells: each number counts as a surface (SetAdjoinFlags) and as a sector, all
    surfaces of which are taken (SectorAdjoins); with each surface goes the one on the other side of its adjoin.
    Scripts that find surfaces by themselves are not foreseen.
    """
    values = [value for value in level.document.cogs.values if _NUMBER.fullmatch(value)]
    numbers = np.unique(np.array([int(value) for value in values], np.int64))
    count, sectors = len(level.surfaces), level.document.sectors
    named = np.zeros(count, np.bool_)
    named[numbers[numbers < count]] = True
    for sector in numbers[numbers < len(level.sectors)].tolist():
        first = max(0, int(sectors.first_surface[sector]))
        named[first : max(first, first + int(sectors.surface_count[sector]))] = True
    adjoins = level.document.adjoins
    adjoin = level.document.surfaces.adjoin[named]
    adjoin = adjoin[(adjoin >= 0) & (adjoin < len(adjoins.mirror))]
    mirror = adjoins.mirror[adjoin]
    other = level.adjoin_surface[mirror[(mirror >= 0) & (mirror < len(adjoins.mirror))]]
    named[other[(other >= 0) & (other < count)]] = True
    return np.flatnonzero(named).astype(np.int32)
