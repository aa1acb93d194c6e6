"""A level as the ground of a simulation: its floors, its walls, and the sector in which the body is."""

from __future__ import annotations

import math

from jktools.engine.flags import SectorFlag
from jktools.engine.ground import TOUCH, Contact, Floor, Vector
from jktools.geometry.collision import MOST_SECTORS, SOLID, Collision
from jktools.geometry.sphere import Path, Polygon, Touch, above, touches

DOWN: Vector = (0.0, 0.0, -1.0)


class LevelGround:
    """The `Ground` of a level, for one body: it follows the body from sector to sector as it asks.

    A floor is a solid surface (see `geometry.collision`) that faces up; its flags decide who takes it. Things are not
    met.
    """

    def __init__(self, collision: Collision, position: Vector, sector: int) -> None:
        """Start at a position (JKU) in a sector. Raises ValueError for a sector that does not exist or is broken."""
        sound = collision.plan.sound_sectors
        if not (0 <= sector < len(sound) and sound[sector]):
            raise ValueError(f"sector {sector} is none of the level's {len(sound)}, or is broken")
        self.collision, self.place, self.sector = collision, position, sector

    @property
    def sector_flags(self) -> int:
        """Flags of the sector in which the body is."""
        return self.collision.faces(self.sector).flags

    def move_to(self, position: Vector) -> None:
        """Follow the body straight to where it is now."""
        if position != self.place:
            self.sector = self.collision.follow(self.sector, self.place, position)
            self.place = position

    def floor_below(self, position: Vector, reach: float, radius: float, required: int) -> Floor | None:
        """Find the floor under a sphere (see `Ground`); none in an underwater sector, where bodies do not stand."""
        self.move_to(position)
        if self.sector_flags & SectorFlag.UNDERWATER:
            return None
        if radius == 0:
            return self._straight_below(position, reach, required)
        path = Path(position, DOWN, reach, radius)
        found = self._first(path, required)
        return None if found is None else _floor(found.polygon, position)

    def sweep(self, position: Vector, motion: Vector, radius: float) -> Contact | None:
        """Find the first solid surface, edge or corner that a sphere touches (see `Ground`)."""
        self.move_to(position)
        size = math.hypot(*motion)
        if size == 0:
            return None
        path = Path(position, (motion[0] / size, motion[1] / size, motion[2] / size), size, radius)
        found = self._first(path)
        if found is None:
            return None
        stands = found.polygon.normal[2] > 0 and found.normal[2] > 0 and not self.sector_flags & SectorFlag.UNDERWATER
        floor = _floor(found.polygon, path.at(found.distance)) if stands else None
        return Contact(found.distance, found.normal, floor)

    def _straight_below(self, position: Vector, reach: float, required: int) -> Floor | None:
        """Sector by sector through adjoins; the first solid surface ends the search, whatever its flags."""
        sector, point = self.sector, position
        for _ in range(MOST_SECTORS):
            found = self.collision.faces(sector).below(point)
            if found is None or position[2] - found[0] > reach + TOUCH:
                return None
            height, face, lead = found
            point = (position[0], position[1], height)
            if lead == SOLID:
                return Floor(point, face.flags, face.normal) if face.flags & required == required else None
            sector = lead
        return None

    def _first(self, path: Path, required: int | None = None) -> Touch | None:
        """The first touch; of several at once a floor's before a wall's, so that an edge belongs to its floor.

        With `required`, surfaces that face up and have these flags only.
        """
        found: list[Touch] = []
        for face in self.collision.solids(self.sector, path):
            if required is None or (face.normal[2] > 0 and face.flags & required == required):
                found += touches(face, path)
        if not found:
            return None
        nearest = min(touch.distance for touch in found)
        tied = [touch for touch in found if touch.distance <= nearest + TOUCH]
        best = max(tied, key=lambda touch: (touch.on_face, touch.polygon.normal[2], -touch.polygon.surface))
        return best._replace(distance=nearest)


def _floor(face: Polygon, position: Vector) -> Floor:
    """The floor that a polygon is, by the point of its plane straight below or above a position."""
    x, y, z = position
    return Floor((x, y, z - above(face, position) / face.normal[2]), face.flags, face.normal)
