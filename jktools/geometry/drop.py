"""Falls straight down through a level: what a body meets below a point, by sector."""

from __future__ import annotations

import enum
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.flags import SectorFlag, SurfaceFlag
from jktools.geometry.plan import Plan, plan_of
from jktools.model import Level

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

CARRIES = -1
"""In place of the sector that a body falls into through a surface: it is a floor where it faces up."""
STOPS = -2
"""It stops a body and is no floor."""
ABSENT = -3
"""A body does not meet it: it has neither an adjoin nor the collision flag 0x4."""

ADJOIN_MOVEMENT = 0x2
"""Adjoin flag: things pass."""

NO_LIMIT = float("inf")


class Ending(enum.IntEnum):
    """What a fall ends at."""

    FLOOR = 0
    """A surface that carries: flag 0x1, facing up, solid."""
    SOLID = 1
    """A surface that stops a body and has no floor flag."""
    WATER = 2
    """A sector under water (0x2)."""
    FAR = 3
    """Nothing within the distance asked for."""
    NOTHING = 4
    """The sector has nothing below."""
    UNKNOWN = 5
    """A sector that could not be read."""


class Drop(NamedTuple):
    """What each fall ended at, (n,) each."""

    surface: Int32
    """The floor, -1 where the fall ends at none."""
    distance: Float64
    """To the end, JKU: the greatest asked for with FAR, infinite with NOTHING, not a number with UNKNOWN."""
    ending: UInt8
    """An `Ending`."""
    met: Int32
    """The surface at which the fall ends: the floor, the solid surface, or the adjoin's into the water; else -1."""
    sector: Int32
    """The sector in which it ends; with WATER the one under water."""


class Ground(NamedTuple):
    """A level as falling bodies meet it."""

    passes_to: Int32
    """(surfaces,): the sector that a body falls into through each, or CARRIES, STOPS, ABSENT."""
    under_water: Bool
    """(sectors,)"""


def ground_of(level: Level) -> Ground:
    """Tell what a body meets in a level, as `ground` says."""
    return ground(plan_of(level))


def ground(plan: Plan) -> Ground:
    """Tell what a body meets.

    It passes through an adjoin with movement (0x2) that leads into a sector. Every other surface with an adjoin stops
    it, and without an adjoin those with surface flag 0x4; either carries it with flag 0x1. The rest it does not meet
    (sithCollision in the decompiled engine).
    """
    passes = plan.by_adjoin(((plan.adjoin_flags & ADJOIN_MOVEMENT) != 0).astype(np.int32), 0) != 0
    behind = plan.by_adjoin(plan.adjoin_sector, -1)
    solid = plan.has_adjoin | ((plan.surface_flags & SurfaceFlag.COLLISION) != 0)
    floor = (plan.surface_flags & SurfaceFlag.FLOOR) != 0
    stays = np.where(solid, np.where(floor, CARRIES, STOPS), ABSENT)
    return Ground(
        np.where(passes & (behind >= 0), behind, stays).astype(np.int32),
        (plan.sector_flags & SectorFlag.UNDERWATER) != 0,
    )
