"""What a simulated body moves over: the questions it asks, and floors that are given by numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from jktools.engine.flags import SurfaceFlag

Vector = tuple[float, float, float]

UP: Vector = (0.0, 0.0, 1.0)
TOUCH = 1e-9
"""JKU: a sphere this close to a surface touches it. Far above the rounding of a position of some hundred JKU
(3e-14), far below anything that the game tells apart (1e-5)."""
GRAZE = 1e-12
"""JKU: a motion that goes into a surface by less than this in all goes along it. What is left of a motion after it was
turned along an edge points into it or away by some 1e-17: were that a contact, rounding would decide whether the body
slides on or stays for the tick."""

_SOLID_FLOOR = SurfaceFlag.FLOOR | SurfaceFlag.COLLISION

SURFACES = {
    "floor": int(_SOLID_FLOOR),
    "non-floor": int(SurfaceFlag.COLLISION),
    "icy": int(_SOLID_FLOOR | SurfaceFlag.ICY),
    "very-icy": int(_SOLID_FLOOR | SurfaceFlag.VERY_ICY),
    "shallow-water": int(_SOLID_FLOOR | SurfaceFlag.SHALLOW_WATER),
    "deep-water": int(_SOLID_FLOOR | SurfaceFlag.DEEP_WATER),
    "very-deep-water": int(_SOLID_FLOOR | SurfaceFlag.VERY_DEEP_WATER),
}
"""Surfaces by the names that scripts use: their flag words."""


class Floor(NamedTuple):
    """A surface that carries a body."""

    point: Vector
    """Any point of its plane."""
    surface: int
    """Its flag word."""
    normal: Vector = UP


class Contact(NamedTuple):
    """Where a moving sphere first touches something."""

    distance: float
    """JKU along the motion."""
    normal: Vector
    """Unit, away from what is touched."""
    floor: Floor | None
    """The surface touched, None for a wall."""


class Ground(Protocol):
    """The world as a body feels it. A level's sectors answer the same two questions as the floors given here."""

    def floor_below(self, position: Vector, reach: float, radius: float, required: int) -> Floor | None:
        """Find the first surface with all flags of `required` that a sphere meets on its way straight down.

        `reach` and `radius` in JKU; a radius of 0 is a ray.
        """
        ...

    def sweep(self, position: Vector, motion: Vector, radius: float) -> Contact | None:
        """Find the first thing that a sphere touches as it moves by `motion` (JKU), None if nothing."""
        ...


class Tread(NamedTuple):
    """One level floor of `Steps`: from `start` (JKU along y) to the next tread."""

    start: float
    height: float
    surface: int = SURFACES["floor"]


@dataclass(frozen=True)
class Steps:
    """Level floors side by side along y, with walls between them: flat ground, pits and stairs.

    The first tread reaches back, and the last one on, without end; x has no effect. Treads come in ascending
    order.
    """

    treads: tuple[Tread, ...]

    def __post_init__(self) -> None:
        """Refuse treads that are not in order."""
        starts = [tread.start for tread in self.treads]
        if not starts or sorted(set(starts)) != starts:
            raise ValueError(f"treads must start one after another, not at {starts}")

    @classmethod
    def flat(cls, surface: int = SURFACES["floor"]) -> Steps:
        """Make one level floor at z = 0."""
        return cls((Tread(0.0, 0.0, surface),))

    @classmethod
    def pit(cls, depth: float, width: float = 2.0, surface: int = SURFACES["floor"]) -> Steps:
        """Make a pit of `depth` from y = 0 to y = `width` (JKU) in a floor at z = 0."""
        treads = (Tread(-1.0, 0.0, surface), Tread(0.0, -depth, surface), Tread(width, 0.0, surface))
        return cls(treads)

    def tread_at(self, y: float) -> Tread:
        """Give the tread under y; on an edge, the higher one."""
        here = max(0, sum(tread.start < y for tread in self.treads) - 1)
        after = here + 1
        if after < len(self.treads) and self.treads[after].start == y:
            return max(self.treads[here], self.treads[after], key=lambda tread: tread.height)
        return self.treads[here]

    def floor_below(self, position: Vector, reach: float, radius: float, required: int) -> Floor | None:
        """Find the first surface with all flags of `required` under a sphere (see `Ground`)."""
        x, y, z = position
        nearest: tuple[float, Tread] | None = None
        for tread, beside in self._treads_near(y, radius):
            distance = z - tread.height - math.sqrt(max(0.0, radius * radius - beside * beside))
            wanted = tread.surface & required == required and -TOUCH <= distance <= reach + TOUCH
            if wanted and (nearest is None or distance < nearest[0]):
                nearest = (distance, tread)
        return None if nearest is None else Floor((x, y, nearest[1].height), nearest[1].surface)

    def sweep(self, position: Vector, motion: Vector, radius: float) -> Contact | None:
        """Find the first floor, wall or edge that a sphere touches (see `Ground`)."""
        size = math.hypot(*motion)
        if size == 0:
            return None
        path = _Path(position[1], position[2], motion[1] / size, motion[2] / size, radius)
        found = [
            contact
            for contact in (*self._tops(path, position), *self._walls(path), *self._edges(path, position))
            if contact.distance <= size
        ]
        return min(found, key=lambda contact: contact.distance, default=None)

    def _spans(self) -> Iterator[tuple[Tread, float, float]]:
        for i, tread in enumerate(self.treads):
            low = tread.start if i else -math.inf
            yield tread, low, self.treads[i + 1].start if i + 1 < len(self.treads) else math.inf

    def _treads_near(self, y: float, radius: float) -> Iterator[tuple[Tread, float]]:
        """Each tread within `radius` of y, with how far y lies beside it (0 over it)."""
        for tread, low, high in self._spans():
            beside = max(low - y, y - high, 0.0)
            if beside < radius or beside == 0:
                yield tread, beside

    def _tops(self, path: _Path, position: Vector) -> Iterator[Contact]:
        for tread, low, high in self._spans():
            solid = tread.surface & SurfaceFlag.COLLISION
            distance = path.to_level(tread.height + path.radius) if solid else None
            if distance is not None and low <= (y := path.y + distance * path.dy) <= high:
                yield Contact(distance, UP, Floor((position[0], y, tread.height), tread.surface))

    def _walls(self, path: _Path) -> Iterator[Contact]:
        for (before, after), side in ((pair, side) for pair in self._risers() for side in (-1.0, 1.0)):
            bottom, top = sorted((before.height, after.height))
            faces = side == (-1.0 if after.height > before.height else 1.0)
            distance = path.to_wall(after.start + side * path.radius, side) if faces else None
            if distance is not None and bottom <= path.z + distance * path.dz <= top:
                yield Contact(distance, (0.0, side, 0.0), None)

    def _edges(self, path: _Path, position: Vector) -> Iterator[Contact]:
        for before, after in self._risers():
            upper = max(before, after, key=lambda tread: tread.height)
            distance = path.to_point(after.start, upper.height) if upper.surface & SurfaceFlag.COLLISION else None
            if distance is None:
                continue
            away = (path.y + distance * path.dy - after.start, path.z + distance * path.dz - upper.height)
            scale = math.hypot(*away) or 1.0
            floor = Floor((position[0], after.start, upper.height), upper.surface)
            yield Contact(distance, (0.0, away[0] / scale, away[1] / scale), floor if away[1] > 0 else None)

    def _risers(self) -> Sequence[tuple[Tread, Tread]]:
        pairs = zip(self.treads, self.treads[1:], strict=False)
        return [(a, b) for a, b in pairs if a.height != b.height]


class _Path(NamedTuple):
    """A sphere's way in the plane of y and z: its start, unit direction and radius."""

    y: float
    z: float
    dy: float
    dz: float
    radius: float

    def to_level(self, level: float) -> float | None:
        """Distance at which the centre comes down to z = level, None if never."""
        above = self.z - level
        if self.dz >= 0 or above < -TOUCH:
            return None
        return max(0.0, above / -self.dz)

    def to_wall(self, wall: float, side: float) -> float | None:
        """Distance at which the centre comes to y = wall from its `side` (-1 or 1), None if never."""
        apart = (self.y - wall) * side
        if self.dy * side >= 0 or apart < -TOUCH:
            return None
        return max(0.0, apart / (-self.dy * side))

    def to_point(self, y: float, z: float) -> float | None:
        """Distance at which the sphere touches a point, None if it passes by, leaves it or is well inside."""
        oy, oz = self.y - y, self.z - z
        along = oy * self.dy + oz * self.dz
        apart = math.hypot(oy, oz) - self.radius
        # The squares cancel far away; the distance from the line does not.
        beside = oy * self.dz - oz * self.dy
        inside = self.radius * self.radius - beside * beside
        if along >= -GRAZE or inside <= 0 or apart < -TOUCH:
            return None
        return max(0.0, -along - math.sqrt(inside))
