"""Where placed bodies stand: how near the walls are, and what is straight below."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from jktools.engine.flags import SectorFlag, SurfaceFlag
from jktools.engine.ground import Vector
from jktools.facts.floors import Floors
from jktools.geometry import Ending, SectorMesh
from jktools.geometry.collision import SEAM, Collision
from jktools.geometry.sphere import Path, distance
from jktools.model import Level, Thing

BODIES = ("actor", "player")
_NOWHERE: Vector = (0.0, 0.0, -1.0)
_BEARS_OTHERWISE = SectorFlag.NO_GRAVITY | SectorFlag.UNDERWATER | SectorFlag.THRUST
"""Sectors in which a body need not stand."""


class Cut(NamedTuple):
    """A solid surface within a body's sphere."""

    surface: int
    depth: float
    """JKU that the sphere reaches through it."""


def bodies(level: Level) -> list[Thing]:
    """The placed actors and players that move by physics in a sector that can be computed with."""
    return [
        thing
        for thing in level.things
        if (held := thing.resolved).type in BODIES
        and held.move == "physics"
        and thing.dropped is None
        and np.isfinite(thing.position).all()
        and level.sound_sectors[thing.sector_index]
    ]


def deepest_cut(collision: Collision, thing: Thing) -> Cut | None:
    """The solid surface that the movement sphere of a body at its place cuts most; None where it cuts none.

    Floors below are left out: the engine lifts a body to its height above them.
    """
    radius, point = thing.resolved.number("movesize"), _place(thing)
    if radius <= 0:
        return None
    path = Path(point, _NOWHERE, 0.0, radius)
    cuts = [
        Cut(face.surface, radius - distance(face, point))
        for face in collision.solids(thing.sector_index, path)
        if not (face.normal[2] > 0 and face.flags & SurfaceFlag.FLOOR)
    ]
    deepest = max(cuts, key=lambda cut: (cut.depth, -cut.surface), default=None)
    return deepest if deepest is not None and deepest.depth > 0 else None


class Under(NamedTuple):
    """What ends the way straight down from a body that nothing carries."""

    surface: int | None
    """The solid surface without floor flag; None where there is nothing below."""


def unsupported(level: Level, mesh: SectorMesh, floors: Floors, things: Sequence[Thing]) -> list[Under | None]:
    """What is straight below each of some bodies, without regard to the distance.

    None for one that stands, that need not, or of which that is not known: above a floor, a thing that carries at one
    of its places, water or a sector that could not be read, and where there is thrust or no gravity at either end of
    the way. A body as little as SEAM below its floor stands on it, and so does one above a floor of the sector that it
    lies in, where that is not the one which it names (on a border, by the rounding of its place).
    """
    if not things:
        return []
    points = np.array([_place(thing) for thing in things], np.float64)
    sectors = np.array([thing.sector_index for thing in things], np.int32)
    own = np.array([thing.index for thing in things], np.int64)
    here = floors.below(mesh, points, sectors, own=own)
    raised = floors.below(mesh, np.add(points, (0.0, 0.0, SEAM)), sectors, SEAM, own=own)
    located = mesh.locate(points)
    within = floors.below(mesh, points, np.where(located < 0, sectors, located), own=own)
    stands = (raised.ending == Ending.FLOOR) | (within.ending == Ending.FLOOR)
    flags = level.document.sectors.flags
    floats = ((flags[sectors] | flags[here.sector]) & _BEARS_OTHERWISE) != 0
    fell = np.isin(here.ending, (Ending.SOLID, Ending.NOTHING)) & ~stands
    falls = fell & (here.other < 0) & ~floats
    return [
        Under(int(met) if met >= 0 else None) if falling else None
        for met, falling in zip(here.met.tolist(), falls.tolist(), strict=True)
    ]


def _place(thing: Thing) -> Vector:
    x, y, z = thing.position.tolist()
    return (x, y, z)
