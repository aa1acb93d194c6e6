"""Levels made for tests: convex cells cut from a box, glued by adjoins, with windows, walls and overlaps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.geometry.mesh import BLOCKS, SectorMesh

Float64 = npt.NDArray[np.float64]
Vertex = tuple[float, float, float]


class Face:
    """A polygon of a cell, counter-clockwise seen from inside, and the face on its other side."""

    def __init__(self, polygon: list[Vertex]) -> None:
        self.polygon = polygon
        self.cell = -1
        self.mirror: Face | None = None

    def split(self, side: list[float]) -> tuple[Face | None, Face | None, list[tuple[Vertex, Vertex]]]:
        """The parts before and behind a plane, and the cut; `side` holds each vertex's distance."""
        ahead: list[Vertex] = []
        behind: list[Vertex] = []
        cut: list[Vertex] = []
        count = len(self.polygon)
        for i, here in enumerate(self.polygon):
            there, d, e = self.polygon[(i + 1) % count], side[i], side[(i + 1) % count]
            if d >= 0:
                ahead.append(here)
            if d <= 0:
                behind.append(here)
            if d == 0:
                cut.append(here)
            if d * e < 0:
                low, high = sorted((here, there))  # the same vertex from both sides of an edge
                f = (d if low == here else e) / ((d - e) if low == here else (e - d))
                vertex = tuple(a + f * (b - a) for a, b in zip(low, high, strict=True))
                for part in (ahead, behind, cut):
                    part.append(vertex)
        whole = all(d >= 0 for d in side), all(d <= 0 for d in side)
        if whole[0] or whole[1]:
            return (
                (self if whole[0] else None),
                (None if whole[0] else self),
                [tuple(cut)] if len(cut) == 2 else [],
            )
        return Face(ahead), Face(behind), [(cut[0], cut[1])] if len(cut) == 2 else []


class Cells:
    """Convex cells that fill a box; cutting one splits the faces of its neighbours too, as in real levels."""

    def __init__(self) -> None:
        corners = [tuple(float(4 * (i >> k & 1)) for k in range(3)) for i in range(8)]
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        self.cells = [[Face([corners[i] for i in face]) for face in faces]]
        self._own(0)

    def _own(self, cell: int) -> None:
        for face in self.cells[cell]:
            face.cell = cell

    def cut(self, cell: int, normal: tuple[int, int, int], offset: float) -> None:
        """Cut a cell in two by the plane normal . x = offset, where the plane passes through it."""
        parts: tuple[list[Face], list[Face]] = ([], [])
        edges: list[tuple[Vertex, Vertex]] = []
        splits = []
        for face in self.cells[cell]:
            side = [sum(n * x for n, x in zip(normal, v, strict=True)) - offset for v in face.polygon]
            side = [0.0 if abs(d) < 1e-9 else d for d in side]
            ahead, behind, cut = face.split(side)
            splits.append((face, side, ahead, behind))
            edges += cut
            for part, piece in zip(parts, (ahead, behind), strict=True):
                if piece is not None:
                    part.append(piece)
        polygon = _around(edges, np.array(normal, float))
        if polygon is None or len(parts[0]) < 3 or len(parts[1]) < 3:
            return
        for face, side, ahead, behind in splits:
            if ahead is not None and behind is not None and face.mirror is not None:
                self._split_mirror(face, side, ahead, behind)
        one, other = Face(polygon), Face(polygon[::-1])
        one.mirror, other.mirror = other, one
        self.cells[cell] = [*parts[0], one]
        self.cells.append([*parts[1], other])
        self._own(cell)
        self._own(len(self.cells) - 1)

    def _split_mirror(self, face: Face, side: list[float], ahead: Face, behind: Face) -> None:
        mirror = face.mirror
        assert mirror is not None
        faces = self.cells[mirror.cell]
        at = next(i for i, f in enumerate(faces) if f is mirror)
        pieces = [Face(part.polygon[::-1]) for part in (ahead, behind)]
        for part, piece in zip((ahead, behind), pieces, strict=True):
            part.mirror, piece.mirror, piece.cell = piece, part, mirror.cell
        faces[at : at + 1] = pieces


def _around(edges: list[tuple[Vertex, Vertex]], normal: Float64) -> list[Vertex] | None:
    """The convex polygon of a cut's vertices, counter-clockwise seen from ahead of the plane."""
    points = sorted({v for edge in edges for v in edge})
    if len(points) < 3:
        return None
    at = np.array(points)
    spokes = at - at.mean(axis=0)
    u = spokes[np.argmax((spokes**2).sum(axis=1))]
    turn = np.arctan2((np.cross(normal, u) * spokes).sum(axis=1), np.linalg.norm(normal) * (spokes * u).sum(axis=1))
    return [points[i] for i in np.argsort(turn)]


class Level(NamedTuple):
    """The arrays of `SectorMesh.from_arrays`."""

    positions: Float64
    surface_start: list[int]
    surface_vertex: list[int]
    leads_to: list[int]
    sector_first: list[int]
    sector_count: list[int]

    def mesh(self) -> SectorMesh:
        return SectorMesh.from_arrays(*self)

    def moved(self, positions: Float64) -> Level:
        return self._replace(positions=positions)


def level_of(cells: Cells, rng: np.random.Generator, walls: float = 0.0, strays: float = 0.0) -> Level:
    """Make `walls` of the adjoins solid (one side only, for some), and let `strays` of all surfaces lead anywhere.

    A stray adjoin makes sectors overlap, lead in circles, or be entered from behind.
    """
    index: dict[Vertex, int] = {}
    start, vertices, leads, first, count = [0], [], [], [], []
    for cell in cells.cells:
        first.append(len(leads))
        count.append(len(cell))
        for face in cell:
            turn = int(rng.integers(len(face.polygon)))
            ring = face.polygon[turn:] + face.polygon[:turn]
            vertices += [index.setdefault(v, len(index)) for v in ring]
            start.append(len(vertices))
            target = BLOCKS if face.mirror is None or rng.random() < walls else face.mirror.cell
            leads.append(int(rng.integers(len(cells.cells))) if rng.random() < strays else target)
    return Level(np.array(list(index), float), start, vertices, leads, first, count)


class Queries(NamedTuple):
    """Origins, their sectors, and targets."""

    origins: Float64
    sectors: npt.NDArray[np.int32]
    targets: Float64


def queries_of(level: Level, rng: np.random.Generator, count: int) -> Queries:
    """Mean queries: to and from points in cells, on faces, edges and vertices, through them, and on the spot."""
    sectors = rng.integers(len(level.sector_first), size=count).astype(np.int32)
    origins = np.array([_point(level, int(s), rng) for s in sectors])
    goals = rng.integers(len(level.sector_first), size=count)
    targets = np.array([_point(level, int(s), rng) for s in goals])
    through = rng.random(count) < 0.3  # as far again behind a point of note
    targets[through] = 2 * targets[through] - origins[through]
    nowhere = rng.random(count) < 0.03
    targets[nowhere] = origins[nowhere]
    return Queries(origins, sectors, targets)


def _point(level: Level, sector: int, rng: np.random.Generator) -> Float64:
    surface = level.sector_first[sector] + int(rng.integers(level.sector_count[sector]))
    corners = level.positions[level.surface_vertex[level.surface_start[surface] : level.surface_start[surface + 1]]]
    kind = rng.integers(5)
    if kind == 0:
        return corners[rng.integers(len(corners))].copy()
    if kind == 1:
        i = int(rng.integers(len(corners)))
        return (corners[i] + corners[(i + 1) % len(corners)]) / 2
    if kind == 2:
        return rng.dirichlet(np.ones(len(corners))) @ corners
    first = level.surface_start[level.sector_first[sector]]
    end = level.surface_start[level.sector_first[sector] + level.sector_count[sector]]
    own = level.positions[level.surface_vertex[first:end]]
    return own.mean(axis=0) if kind == 3 else rng.dirichlet(np.ones(len(own))) @ own
