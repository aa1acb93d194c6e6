"""The exact tier of ledges: rational places and drops, over the exact tiers of sight and drop.

Written plainly and apart from native/geometry/ledges.cpp, with which it shares only the definition: the way over the
edge at `BEYOND`, and what that word means. Minutes for a large level.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.geometry.drop import Ending, ground_of
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker, Gait, Over
from jktools.geometry.mesh import BLOCKS, SectorMesh, mesh_arrays
from jktools.model import Level

Float64 = npt.NDArray[np.float64]
Point = tuple[Fraction, Fraction, Fraction]

ON_EDGE = 1e-4
"""JKU over its floor at which a body's way up begins."""
SHORTEST = Fraction(1, 100_000)
"""JKU: intervals shorter than this join their neighbour."""
SLAB = 4 * BEYOND
STEEP = Fraction(7, 10)
BENT = Fraction(1, 100_000)
_OVER = {Ending.FLOOR: Over.FLOOR, Ending.SOLID: Over.SOLID, Ending.WATER: Over.WATER, Ending.NOTHING: Over.VOID}


class Plane(NamedTuple):
    """A triangle's corner and its normal, of any length, z > 0."""

    corner: Point
    normal: Point

    def height(self, x: Fraction, y: Fraction) -> Fraction:
        """The z of the plane at a place."""
        (cx, cy, cz), (nx, ny, nz) = self
        return cz - (nx * (x - cx) + ny * (y - cy)) / nz

    @property
    def is_steep(self) -> bool:
        """Whether its unit normal's z is below `STEEP`."""
        nx, ny, nz = self.normal
        return nz * nz < STEEP * STEEP * (nx * nx + ny * ny + nz * nz)


class Met(NamedTuple):
    """What the way over one place of an edge comes onto."""

    over: Over
    surface: int
    sector: int
    rise: int
    plane: Plane | None


class Row(NamedTuple):
    """An interval."""

    start: Fraction
    end: Fraction
    met: Met


class ExactLedges:
    """A level made ready for exact questions about the edges of its floors."""

    def __init__(self, level: Level, edges: EdgeWalker) -> None:
        """Take its sectors; ways are those of movement."""
        positions, start, vertex, _, first, count = mesh_arrays(level)
        ground = ground_of(level)
        sound = np.append(level.sound_sectors, False)
        passes = np.where((ground.passes_to >= 0) & ~sound[ground.passes_to], -2, ground.passes_to)
        self._mesh = SectorMesh.from_arrays(
            positions.reshape(-1, 3), start, vertex, np.where(passes >= 0, passes, BLOCKS), first, count, passes,
            ground.under_water,
        )  # fmt: skip
        self._positions = positions.reshape(-1, 3)
        self._start, self._vertex = start, vertex
        self._first, self._count = first, count
        self._home = level.surface_sector
        self._edges = edges

    def beyond(self, gait: Gait) -> Beyond:
        """Answer for every edge, as `EdgeWalker.beyond` does."""
        columns: list[tuple[float | int, ...]] = []
        for edge in range(len(self._edges.surface)):
            columns += [(edge, *row) for row in _Edge(self, edge, gait).rows()]
        kinds = (np.int32, float, float, np.uint8, np.int32, np.int32, float, float, np.int32, float, float)
        return Beyond(*(np.array([c[i] for c in columns], kind) for i, kind in enumerate(kinds)))

    def go(self, sector: int, origin: Float64, target: Float64, visited: set[int]) -> tuple[int, int]:
        """The sector in which a straight way ends, and the surface that ends it too early or -1."""
        way = self._mesh.explain(sector, origin, target)
        visited.update(step.sector for step in way.steps)
        return way.steps[-1].sector, way.blocker

    def fall(self, sector: int, point: Float64, visited: set[int]) -> tuple[Over, int, int, Plane | None]:
        """What lies straight below a point."""
        found = self._mesh.drop([point], [sector], accuracy="exact")
        over, surface, end = _OVER[Ending(int(found.ending[0]))], int(found.met[0]), int(found.sector[0])
        visited.add(end)
        depth = float(found.distance[0])
        if np.isfinite(depth):
            self.go(sector, point, point - (0, 0, depth), visited)
        return over, surface, end, None if surface < 0 else self._plane(surface, point, depth)

    def _plane(self, surface: int, point: Float64, depth: float) -> Plane:
        """The triangle of a surface's fan that lies at a depth below a point: the one that comes nearest."""
        corners = [_exact(p) for p in self.corners(surface)]
        x, y, z = _exact(point)
        planes = [
            Plane(corners[0], normal)
            for b, c in itertools.pairwise(corners)
            if (normal := _cross(_minus(b, corners[0]), _minus(c, corners[0])))[2] > 0
            and _holds((corners[0], b, c), x, y)
        ]
        return min(planes, key=lambda plane: abs(z - plane.height(x, y) - Fraction(depth)))

    def corners(self, surface: int) -> Float64:
        """The corners of a surface, (n, 3)."""
        return self._positions[self._vertex[self._start[surface] : self._start[surface + 1]]]

    def sides(self, sector: int) -> Iterator[tuple[Float64, Float64]]:
        """All sides of a sector's surfaces, and those between the triangles of their fans."""
        first = int(self._first[sector])
        for surface in range(first, first + int(self._count[sector])):
            corners = self.corners(surface)
            yield from zip(corners, np.roll(corners, -1, axis=0), strict=True)
            yield from ((corners[0], corner) for corner in corners[2:-1])


class _Edge:
    def __init__(self, whole: ExactLedges, edge: int, gait: Gait) -> None:
        self.whole, self.gait = whole, gait
        self.surface = int(whole._edges.surface[edge])
        self.home = int(whole._home[self.surface])
        (here,), (there,) = whole._edges.ends([edge])
        self.here, self.along = here, there - here
        self.length = float(np.hypot(*self.along[:2]))
        if self.length > 0:
            self.out = np.array([self.along[1], -self.along[0], 0]) / self.length
        corners = whole.corners(self.surface)
        local = corners - corners[0]
        self.normal = np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)
        self.visited: set[int] = set()

    def rows(self) -> list[tuple[float | int, ...]]:
        if not self.length > float(SHORTEST):
            return []
        for t in (0.5, 0.02, 0.98):
            self.at(t)
        breaks: set[Fraction] = {Fraction(0), Fraction(1)}
        gathered: set[int] = set()
        while gathered != self.visited:
            for sector in sorted(self.visited - gathered):
                breaks.update(self.breaks(sector))
                gathered.add(sector)
            found = self._between(sorted(breaks))
        merged: list[Row] = []
        for row in found:
            if merged and self._alike(merged[-1].met, row.met, row.start, row.end):
                merged[-1] = Row(merged[-1].start, row.end, merged[-1].met)
            else:
                merged.append(row)
        return [self._columns(row) for row in merged]

    def _between(self, breaks: list[Fraction]) -> list[Row]:
        shortest = SHORTEST / Fraction(self.length)
        cuts = [Fraction(0)]
        for t in breaks:
            if t - cuts[-1] >= shortest:
                cuts.append(t)
        if len(cuts) > 1 and 1 - cuts[-1] < shortest:
            cuts.pop()
        cuts.append(Fraction(1))
        return [Row(a, b, self.at(float((a + b) / 2))) for a, b in itertools.pairwise(cuts)]

    def beside(self, t: float, off: float, up: float) -> Float64:
        return np.asarray(self.here + t * self.along + off * self.out + (0.0, 0.0, up), np.float64)

    def at(self, t: float) -> Met:
        slope = -float(self.normal[0] * self.out[0] + self.normal[1] * self.out[1]) / float(self.normal[2])
        inner = self.beside(t, -BEYOND, ON_EDGE - BEYOND * slope)
        blocked = Met(Over.BLOCKED, -1, self.home, 0, None)
        for rise in range(self.gait.rises + 1):
            up = self.gait.hover + rise * self.gait.rise
            before, beyond = self.beside(t, -BEYOND, up), self.beside(t, BEYOND, up)
            sector, blocker = self.whole.go(self.home, inner, before, self.visited)
            if blocker >= 0:
                return blocked if rise else blocked._replace(surface=blocker, sector=sector)
            sector, blocker = self.whole.go(sector, before, beyond, self.visited)
            if blocker >= 0:
                if rise == 0:
                    blocked = blocked._replace(surface=blocker, sector=sector)
                continue
            over, surface, end, plane = self.whole.fall(sector, beyond, self.visited)
            return Met(over, surface, end, rise, plane)
        return blocked

    def breaks(self, sector: int) -> Iterator[Fraction]:
        """Where sides of a sector's surfaces cross the way, seen from above or from the side."""
        offs = [Fraction(o) for o in (-BEYOND, 0.0, BEYOND)]
        ups = [Fraction(self.gait.hover + rise * self.gait.rise) for rise in range(self.gait.rises + 1)]
        for p, q in self.whole.sides(sector):
            rough = [self._rough(p), self._rough(q)]
            far = max(r[1] for r in rough) < -2 * SLAB or min(r[1] for r in rough) > 2 * SLAB
            if far or max(r[0] for r in rough) < -0.01 or min(r[0] for r in rough) > 1.01:
                continue
            a, b = self._seen(p), self._seen(q)
            crossed = [_crossing(a[0], b[0], a[1] - off, b[1] - off) for off in offs]
            if min(a[1], b[1]) <= SLAB and max(a[1], b[1]) >= -SLAB:
                crossed += [t for t, off, _ in (a, b) if abs(off) <= SLAB]
                crossed += [_crossing(a[0], b[0], a[2] - up, b[2] - up) for up in ups]
            yield from (t for t in crossed if t is not None and 0 < t < 1)

    def _rough(self, p: Float64) -> tuple[float, float]:
        away = p - self.here
        return float(away[:2] @ self.along[:2]) / self.length**2, float(away @ self.out)

    def _seen(self, p: Float64) -> Point:
        """Along the edge, beyond it, above it."""
        away, along, out = _minus(_exact(p), _exact(self.here)), _exact(self.along), _exact(self.out)
        t = (away[0] * along[0] + away[1] * along[1]) / (along[0] * along[0] + along[1] * along[1])
        return t, away[0] * out[0] + away[1] * out[1], away[2] - t * along[2]

    def _alike(self, a: Met, b: Met, start: Fraction, end: Fraction) -> bool:
        if a[:4] != b[:4]:
            return False
        if a.plane is None or b.plane is None or a.over is Over.BLOCKED:
            return True
        return all(abs(self._exact_drop(a, t) - self._exact_drop(b, t)) <= BENT for t in (start, end))

    def _exact_drop(self, met: Met, t: Fraction) -> Fraction:
        if met.plane is None:
            return Fraction(0)
        off = Fraction(BEYOND) if met.plane.is_steep else Fraction(0)
        here, along, out = _exact(self.here), _exact(self.along), _exact(self.out)
        x, y, z = (here[k] + t * along[k] + off * out[k] for k in range(3))
        return z - met.plane.height(x, y)

    def _columns(self, row: Row) -> tuple[float | int, ...]:
        met = row.met
        landed = met.over not in (Over.BLOCKED, Over.VOID)
        drops = [float(self._exact_drop(met, t)) if landed else np.nan for t in (row.start, row.end)]
        middle = float((row.start + row.end) / 2)
        passes = met.over is not Over.BLOCKED and met.rise == 0
        past = [self._past(middle, radii * self.gait.radius) if passes else np.nan for radii in (1, 2)]
        return (float(row.start), float(row.end), int(met.over), met.surface, met.sector, *drops, met.rise, *past)

    def _past(self, t: float, off: float) -> float:
        """The drop further out, as `Beyond.past`."""
        seen: set[int] = set()
        stops = [
            self.beside(t, -BEYOND, ON_EDGE), self.beside(t, -BEYOND, self.gait.hover),
            self.beside(t, BEYOND, self.gait.hover), self.beside(t, off, self.gait.hover),
        ]  # fmt: skip
        sector = self.home
        for origin, target in itertools.pairwise(stops):
            sector, blocker = self.whole.go(sector, origin, target, seen)
            if blocker >= 0:
                return float("nan")
        over, _, _, plane = self.whole.fall(sector, stops[-1], seen)
        if over is not Over.FLOOR or plane is None:
            return float("inf")
        x, y, _ = _exact(stops[-1])
        return float(_exact(self.beside(t, 0, 0))[2] - plane.height(x, y))


def _exact(p: Float64) -> Point:
    x, y, z = (Fraction(v) for v in p.tolist())
    return x, y, z


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Point, b: Point) -> Point:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _holds(triangle: tuple[Point, Point, Point], x: Fraction, y: Fraction) -> bool:
    """Whether a triangle that faces up holds a place, seen from above."""
    return all(
        (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0
        for a, b in zip(triangle, (*triangle[1:], triangle[0]), strict=True)
    )


def _crossing(a: Fraction, b: Fraction, before: Fraction, after: Fraction) -> Fraction | None:
    if (before < 0) == (after < 0):
        return None
    return a + (b - a) * (before / (before - after))
