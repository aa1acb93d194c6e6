"""Where placed bodies stand: how near the walls are, and what is straight below."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.engine.flags import SectorFlag, SurfaceFlag
from jktools.engine.ground import Vector
from jktools.geometry.collision import MOST_SECTORS, SOLID, Collision
from jktools.geometry.sphere import Path, distance
from jktools.model import Level, Thing

BODIES = ("actor", "player")
STANDABLE = 0x40
"""Thing flag: bodies stand on it."""
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


class Below(NamedTuple):
    """What ends the way straight down from a body."""

    surface: int | None
    """None where the way leaves the sectors through a gap."""
    is_floor: bool
    """Whether bodies that stick to floors take it."""


def below(collision: Collision, thing: Thing, carriers: Carriers) -> Below | None:
    """What is straight below a body; None where it need not stand, or a thing may carry it.

    Sector by sector through adjoins that let things pass, without regard to the distance.
    """
    if carriers.may_carry(thing):
        return None
    sector, point = thing.sector_index, _place(thing)
    for _ in range(MOST_SECTORS):
        faces = collision.faces(sector)
        if faces.flags & _BEARS_OTHERWISE:
            return None
        found = faces.below(point)
        if found is None:
            return Below(None, is_floor=False)
        height, face, lead = found
        if lead == SOLID:
            return Below(face.surface, is_floor=bool(face.flags & SurfaceFlag.FLOOR))
        sector, point = lead, (point[0], point[1], height)
    return None


class Carriers:
    """The things of a level that bodies can stand on."""

    def __init__(self, level: Level) -> None:
        """Find them; one whose size only a model would tell is taken to be everywhere."""
        held = [thing for thing in level.things if thing.resolved.flags("thingflags") & STANDABLE]
        self._index = np.array([thing.index for thing in held], np.intp)
        self._place = level.document.things.position[self._index].astype(np.float64)
        sizes = [thing.resolved.values.get("size") for thing in held]
        self._size = np.array(
            [s.value if s is not None and isinstance(s.value, float) else np.inf for s in sizes], np.float64
        )

    def may_carry(self, body: Thing) -> bool:
        """Whether one of them may lie below a body."""
        point = body.position.astype(np.float64)
        low = self._place[:, 2] - self._size <= point[2]
        near = np.hypot(*(self._place[:, :2] - point[:2]).T) <= self._size
        return bool((low & near & (self._index != body.index)).any())


def _place(thing: Thing) -> Vector:
    x, y, z = thing.position.tolist()
    return (x, y, z)
