"""The way of a segment by the rules of the decompiled engine (profile `openjkdf2`): one at a time, exact.

What differs from `SectorMesh.sight`, which follows the research document:

| what | here |
|---|---|
| a surface without adjoin and without surface flag 0x4 | is not there |
| an end exactly on a blocking face | is blocked by it |
| a start up to 1e-5 JKU behind a face | can leave through it, at 0; farther behind, the face is not seen |
| a sector whose COLLIDEBOX strictly holds the end | has no faces: all beyond it counts as clear |
| the 65th sector | is not entered: all beyond counts as clear |

Sources: `sithCollision_SearchForCollisions`, `sithCollision_SearchForSurfaceCollisions` and
`sithIntersect_IsSphereInSectorBox`. The engine works in float32, with the written normals and with all faces of every
sector that it reaches; here the first face on the way out of each sector decides, as for `research`, and a face is the
fan of its corners.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine import sight
from jktools.engine.profile import Engine
from jktools.geometry.mesh import BLOCKS, Explanation, Step, mesh_arrays
from jktools.model import Level

Float64 = npt.NDArray[np.float64]
Point = tuple[float, float, float]
Exact = tuple[Fraction, Fraction, Fraction]

ABSENT = -2
"""What a surface leads to that the search does not meet."""
_BEHIND = Fraction(sight.TOUCHING)
_ROUNDING = 1e-12
"""Of the greatest product in a volume: far more than float64 can be off."""


class Cut(enum.Enum):
    """Name what makes the engine end a search early and call the rest clear."""

    COLLIDE_BOX = "its COLLIDEBOX holds the end, so that its surfaces are passed over"
    SECTORS = f"the search ends after {sight.MAX_SECTORS} sectors"


class Way(NamedTuple):
    """The way that decided a query."""

    explanation: Explanation
    at: Fraction
    """Where it is blocked, 0 to 1; 1 where it is not."""
    entered: frozenset[int]
    """The sectors that the search came to: the things in them are met."""
    cut: Cut | None
    """Why the last sector of the way is the last, where the engine stops early."""


class Faces:
    """Triangles that a segment leaves through, each from the side of its normal."""

    def __init__(self, corners: Float64, owner: Sequence[int]) -> None:
        """Take triangles, (n, 3, 3) JKU, counter-clockwise seen from the side that they are hit from."""
        self.corners, self.owner = corners, tuple(owner)
        self._low, self._high = corners.min(axis=1), corners.max(axis=1)
        self._normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

    def near(self, a: Point, b: Point, *, behind: bool = False) -> Iterator[int]:
        """Give the triangles that a segment may leave through, among others; `behind`: all that it may touch."""
        if not len(self.corners):
            return
        start, end = np.array(a), np.array(b)
        reach = 2 * sight.TOUCHING + _ROUNDING * (np.abs(start) + np.abs(end))
        low, high = np.minimum(start, end) - reach, np.maximum(start, end) + reach
        apart = ((self._low > high) | (self._high < low)).any(axis=1)
        off = end - self.corners[:, 0]
        terms = self._normal * off
        size = np.abs(self.corners).max(axis=(1, 2)) + np.abs(end).max()
        before = terms.sum(axis=1) > _ROUNDING * size**3 + 1e-300
        yield from np.flatnonzero(~apart & (behind | ~before)).tolist()

    def leaves(self, index: int, a: Exact, b: Exact, *, ending: bool) -> Fraction | None:
        """Tell where a segment leaves through a triangle, 0 to 1; None where it does not.

        `ending`: a segment that ends on the triangle's plane counts, at 1.
        """
        first, second, third = (_exact(corner) for corner in self.corners[index].tolist())
        normal = _cross(_minus(second, first), _minus(third, first))
        before, after = _dot(normal, _minus(a, first)), _dot(normal, _minus(b, first))
        if after > 0 or (after == 0 and not ending) or after >= before:
            return None
        if before < 0 and before * before > _BEHIND * _BEHIND * _dot(normal, normal):
            return None
        sides = ((first, second), (second, third), (third, first))
        if before < 0:  # a start behind the face meets it where it stands
            inside = all(_dot(_cross(_minus(q, p), _minus(a, p)), normal) >= 0 for p, q in sides)
            return Fraction(0) if inside else None
        way = _minus(b, a)
        if any(_dot(_cross(way, _minus(p, a)), _minus(q, a)) > 0 for p, q in sides):
            return None
        return before / (before - after)

    def first(self, a: Point, b: Point) -> Fraction | None:
        """Tell where a segment first meets one of the triangles, the end included; None where it meets none."""
        start, end = _exact(a), _exact(b)
        met = (self.leaves(index, start, end, ending=True) for index in self.near(a, b))
        return min((at for at in met if at is not None), default=None)


class SightFaces:
    """The sectors of a level as a profile's sight meets them."""

    def __init__(self, level: Level, engine: Engine) -> None:
        """Take the sound sectors of a level; a sector's faces are made when it is first asked for."""
        positions, self._start, self._vertex, seen, self._first, self._count = mesh_arrays(level)
        self._position = positions.reshape(-1, 3)
        surfaces, adjoins = level.document.surfaces, level.document.adjoins
        has = (surfaces.adjoin >= 0) & (surfaces.adjoin < len(adjoins.flags))
        flags = np.append(adjoins.flags, 0)[np.where(has, surfaces.adjoin, -1)]
        solid = has | sight.surface_blocks(surfaces.flags, flags, has, engine)
        self._leads = np.where(seen != BLOCKS, seen, np.where(solid, BLOCKS, ABSENT))
        self._boxes = level.document.sectors.collide_box
        self._engine = engine
        self._faces: dict[int, Faces] = {}

    def leads(self, surface: int) -> int:
        """Give the sector that sight comes to through a surface, or BLOCKS, or ABSENT."""
        return int(self._leads[surface])

    def faces(self, sector: int) -> Faces:
        """Give the triangles of a sector, of whatever surface."""
        if sector not in self._faces:
            first = int(self._first[sector])
            rings = [
                (s, self._vertex[self._start[s] : self._start[s + 1]])
                for s in range(first, first + int(self._count[sector]))
            ]
            fans = [(s, (ring[0], ring[i], ring[i + 1])) for s, ring in rings for i in range(1, len(ring) - 1)]
            corners = self._position[np.array([fan for _, fan in fans], np.intp).reshape(-1, 3)]
            self._faces[sector] = Faces(corners, [s for s, _ in fans])
        return self._faces[sector]

    def exits(self, sector: int, a: Point, b: Point, entry: Fraction) -> tuple[Fraction, list[int]]:
        """Tell where a segment first leaves a sector, not before `entry`, and through which surfaces, none for none."""
        found: tuple[Fraction, list[int]] = (Fraction(1), [])
        for surface, at in self._left(sector, a, b):
            if self.leads(surface) == ABSENT or at < entry or (found[1] and at > found[0]):
                continue
            if not found[1] or at < found[0]:
                found = (at, [])
            if surface not in found[1]:
                found[1].append(surface)
        return found

    def holes(self, sector: int, a: Point, b: Point) -> list[int]:
        """Find the absent surfaces of a sector through which a segment leaves it."""
        return sorted({surface for surface, _ in self._left(sector, a, b) if self.leads(surface) == ABSENT})

    def _left(self, sector: int, a: Point, b: Point) -> Iterator[tuple[int, Fraction]]:
        faces, start, end = self.faces(sector), _exact(a), _exact(b)
        for index in faces.near(a, b):
            surface = faces.owner[index]
            at = faces.leaves(index, start, end, ending=self.leads(surface) < 0)
            if at is not None:
                yield surface, at

    def skips(self, sector: int, b: Point) -> bool:
        """Whether a sector's faces are passed over for a segment that ends at `b`."""
        box = self._boxes[sector]
        return bool(sight.sector_is_skipped(box[:3], box[3:], b, self._engine))

    def touched(self, sectors: Iterable[int], point: Point) -> list[int]:
        """Find the blocking surfaces of some sectors that a point lies within 1e-5 JKU of; exact."""
        found = set()
        for sector in sectors:
            faces = self.faces(sector)
            for index in faces.near(point, point, behind=True):
                surface = faces.owner[index]
                if self.leads(surface) == BLOCKS and surface not in found and touches(faces.corners[index], point):
                    found.add(surface)
        return sorted(found)


def engine_way(sectors: SightFaces, sector: int, a: Point, b: Point) -> Way:
    """Find the way of a segment, JKU, from a sound sector. Where ways part, one that ends clear decides."""
    search = _Search(sectors, a, b)
    search.run(sector)
    return search.found()


class _Search:
    """One query: depth first over pairs of a sector and the place at which it is entered."""

    def __init__(self, sectors: SightFaces, a: Point, b: Point) -> None:
        self._sectors, self._a, self._b = sectors, a, b
        self._tried: set[tuple[int, Fraction]] = set()
        self._entered: set[int] = set()
        self._blocked: tuple[tuple[Step, ...], Fraction] | None = None
        self._clear: tuple[tuple[Step, ...], Cut | None] | None = None

    def run(self, sector: int) -> None:
        pending: list[tuple[int, Fraction, tuple[Step, ...]]] = [(sector, Fraction(0), ())]
        start = Step(sector, -1, 1.0)
        while pending and self._clear is None:
            sector, entry, steps = pending.pop()
            if (sector, entry) in self._tried:
                continue
            self._tried.add((sector, entry))
            if sector not in self._entered and len(self._entered) == sight.MAX_SECTORS:
                self._clear = ((*steps[:-1], Step(steps[-1].sector, -1, 1.0)), Cut.SECTORS)
                return
            self._entered.add(sector)
            pending += self._enter(sector, entry, steps)
        if self._clear is None and self._blocked is None:  # ways that lead in a circle: nothing blocks
            self._clear = ((start,), None)

    def _enter(
        self, sector: int, entry: Fraction, steps: tuple[Step, ...]
    ) -> list[tuple[int, Fraction, tuple[Step, ...]]]:
        skipped = self._sectors.skips(sector, self._b)
        at, surfaces = (Fraction(1), []) if skipped else self._sectors.exits(sector, self._a, self._b, entry)
        if not surfaces:
            self._clear = ((*steps, Step(sector, -1, 1.0)), Cut.COLLIDE_BOX if skipped else None)
            return []
        wall = next((surface for surface in surfaces if self._sectors.leads(surface) == BLOCKS), None)
        if wall is not None:
            self._blocked = self._blocked or ((*steps, Step(sector, wall, float(at))), at)
            return []
        onward = [(self._sectors.leads(s), at, (*steps, Step(sector, s, float(at)))) for s in surfaces]
        return onward[::-1]

    def found(self) -> Way:
        entered = frozenset(self._entered)
        if self._clear is None and self._blocked is not None:
            return Way(Explanation(False, self._blocked[0]), self._blocked[1], entered, None)
        steps, cut = self._clear or ((), None)
        return Way(Explanation(True, steps), Fraction(1), entered, cut)


def touches(corners: Float64, point: Point) -> bool:
    """Tell whether a point lies within 1e-5 JKU of a triangle, (3, 3) JKU: exactly, also for one without area."""
    p = _exact(point)
    first, second, third = (_exact(corner) for corner in corners.tolist())
    near = _BEHIND * _BEHIND
    normal = _cross(_minus(second, first), _minus(third, first))
    square = _dot(normal, normal)
    height = _dot(normal, _minus(p, first))
    sides = ((first, second), (second, third), (third, first))
    if square and height * height > near * square:
        return False
    if square and all(_dot(_cross(_minus(q, s), _minus(p, s)), normal) >= 0 for s, q in sides):
        return True
    return any(_edge_square(s, q, p) <= near for s, q in sides)


def _edge_square(start: Exact, end: Exact, point: Exact) -> Fraction:
    """The squared distance of a point from an edge."""
    along, off = _minus(end, start), _minus(point, start)
    length = _dot(along, along)
    part = min(max(_dot(along, off) / length, Fraction(0)), Fraction(1)) if length else Fraction(0)
    rest = (off[0] - along[0] * part, off[1] - along[1] * part, off[2] - along[2] * part)
    return _dot(rest, rest)


def _exact(point: Sequence[float]) -> Exact:
    x, y, z = (Fraction(value) for value in point)
    return (x, y, z)


def _minus(p: Exact, q: Exact) -> Exact:
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def _dot(p: Exact, q: Exact) -> Fraction:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def _cross(p: Exact, q: Exact) -> Exact:
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
