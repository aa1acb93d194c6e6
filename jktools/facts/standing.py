"""Where placed bodies stand: how near the walls are, and what is straight below."""

from __future__ import annotations

from typing import NamedTuple

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


def below(collision: Collision, thing: Thing) -> Below | None:
    """What is straight below a body; None where it need not stand, or a thing may carry it.

    Sector by sector through adjoins that let things pass, without regard to the distance.
    """
    if _may_be_carried(collision.level, thing):
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


def _may_be_carried(level: Level, body: Thing) -> bool:
    """Whether a thing that can be stood on may lie below; one whose size only a model would tell always may."""
    x, y, z = _place(body)
    for thing in level.things:
        held = thing.resolved
        if thing is body or not held.flags("thingflags") & STANDABLE:
            continue
        size = held.values.get("size")
        tx, ty, tz = _place(thing)
        if size is None or not isinstance(size.value, float):
            return True
        if tz - size.value <= z and (tx - x) ** 2 + (ty - y) ** 2 <= size.value**2:
            return True
    return False


def _place(thing: Thing) -> Vector:
    x, y, z = thing.position.tolist()
    return (x, y, z)
