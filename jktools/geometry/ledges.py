"""What lies beyond the edges of floors, as a body that walks over them meets it: intervals along each edge."""

from __future__ import annotations

import enum
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_geometry import Strides  # noqa: TID251 (this package is the door)
from jktools.geometry.drop import STOPS, ground_of
from jktools.geometry.mesh import mesh_arrays
from jktools.model import Level

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

BEYOND = 1e-3
"""JKU past the edge at which "just beyond" is looked at: far above the seams of levels, far below a body."""


class Over(enum.IntEnum):
    """What a body comes onto that goes over an edge and falls."""

    FLOOR = 0
    SOLID = 1
    """A surface without the floor flag."""
    WATER = 2
    """A sector under water (0x2)."""
    VOID = 3
    """Nothing: the level is open here."""
    BLOCKED = 4
    """It does not come over the edge."""


class Solids(NamedTuple):
    """Faces of things that carry bodies, wherever those come to be, by solid: one thing at one place."""

    positions: Float64
    """(n, 3) JKU."""
    face_start: Int32
    """(f + 1,) cuts the corners."""
    face_vertex: Int32
    """Counter-clockwise seen from outside."""
    face_solid: Int32
    """(f,) ascending."""
    face_carries: Bool
    """(f,) whether bodies stand on it; it must face up."""
    total: int
    """Of the solids."""

    @classmethod
    def none(cls) -> Solids:
        """No solids."""
        empty = np.zeros(0, np.int32)
        return cls(np.zeros((0, 3)), np.zeros(1, np.int32), empty, empty, np.zeros(0, np.bool_), 0)


class Beyond(NamedTuple):
    """Intervals in the order of the edges asked about, (n,) each."""

    edge: Int32
    """The edge, a row of `EdgeWalker.surface`."""
    start: Float64
    end: Float64
    """0 .. 1 along the edge."""
    over: UInt8
    """An `Over`."""
    met: Int32
    """The surface come onto, the adjoin's into the water, or the one that blocks; -1 for none."""
    face: Int32
    """The face of a solid come onto, or that blocks; -1 for none."""
    sector: Int32
    """Where the way ends, or would end without the solids; -1 for an edge outside of the level."""
    drop_start: Float64
    drop_end: Float64
    """From the edge down to what is come onto, JKU, at both ends; NaN for VOID and BLOCKED."""
    rise: Int32
    """How many times the body had to rise by the step asked for to pass."""
    past_start: Float64
    past_end: Float64
    far_start: Float64
    far_end: Float64
    """The drop one and two radii past the edge, at both ends; infinite where no floor is, NaN where the body does not
    get there, and where that does not count."""


class Gait(NamedTuple):
    """How a body goes over an edge, JKU: its centre `hover` over its floor; where that is blocked, `rise` higher, up to
    `rises` times. What lies one and two radii past the edge counts where the drop is more than `shallow`."""

    hover: float
    radius: float
    rise: float
    rises: int
    shallow: float = 0.0


class EdgeWalker:
    """A level made ready for questions about the edges of its floors, and of the things that carry bodies."""

    def __init__(self, level: Level, solids: Solids | None = None) -> None:
        """Take the sectors that can be computed with; a way into another is blocked."""
        self.solids = Solids.none() if solids is None else solids
        positions, start, vertex, _, first, count = mesh_arrays(level)
        ground = ground_of(level)
        self._native = Strides(
            positions, start, vertex, _within(level, ground.passes_to), ground.under_water.view(np.uint8), first, count,
            np.ascontiguousarray(self.solids.positions, np.float64).ravel(), self.solids.face_start,
            self.solids.face_vertex, self.solids.face_solid, self.solids.face_carries.view(np.uint8),
        )  # fmt: skip
        self.floors: Bool = self._native.floors().view(np.bool_)
        """(surfaces,): what bodies stand on: solid, with flag 0x1, facing up."""
        of_level = _sides(np.flatnonzero(self.floors), start, vertex, positions.reshape(-1, 3))
        faces = np.flatnonzero(self.solids.face_carries)
        of_solids = _sides(faces, self.solids.face_start, self.solids.face_vertex, self.solids.positions)
        nothing = [np.full(len(each.owner), -1, np.int32) for each in (of_level, of_solids)]
        self.surface: Int32 = np.concatenate([of_level.owner, nothing[1]])
        """(edges,): the floor of each edge; -1 for a solid's."""
        self.face: Int32 = np.concatenate([nothing[0], of_solids.owner])
        """(edges,): the face of a solid whose edge it is; -1 for a surface's."""
        self.solid: Int32 = np.append(self.solids.face_solid, np.int32(-1))[self.face]
        """(edges,): the solid, -1 for a surface's."""
        self.corner: Int32 = np.concatenate([of_level.corner, of_solids.corner])
        """(edges,): the corner of the surface or face that it begins at; it ends at the following one."""
        self.here: Float64 = np.concatenate([of_level.here, of_solids.here])
        self.there: Float64 = np.concatenate([of_level.there, of_solids.there])
        """(edges, 3) JKU: both ends."""

    def ends(self, edges: npt.ArrayLike) -> tuple[Float64, Float64]:
        """Both ends of edges, (n, 3) JKU."""
        rows = np.asarray(edges, np.intp)
        return self.here[rows], self.there[rows]

    def edges_of(self, present: Bool) -> Int32:
        """The rows of all surfaces' edges, and of those of the solids present, (solids,)."""
        return np.flatnonzero(np.append(present, True)[self.solid]).astype(np.int32)

    def beyond(
        self,
        gait: Gait,
        samples: int = 0,
        threads: int = 0,
        *,
        edges: Int32 | None = None,
        present: Bool | None = None,
        exact: bool = False,
    ) -> Beyond:
        """Answer for edges, by default all: intervals, or `samples` places an edge that each stand for their part.

        Seen is what lies straight below `BEYOND` past the edge, when the body's centre came there on a straight way,
        among the solids that are `present`, (solids,), by default all. Its width, and headroom above its centre, are
        not looked at. `exact` answers in exact constructions, by a way that is written apart.
        """
        rows = np.arange(len(self.surface), dtype=np.int32) if edges is None else edges
        there = np.ones(self.solids.total, np.bool_) if present is None else present
        surface, face, corner = (column[rows] for column in (self.surface, self.face, self.corner))
        active = there.view(np.uint8)
        if exact:
            found = Beyond(*self._native.exact_ledges(surface, face, corner, active, *gait, threads))
        else:
            found = Beyond(*self._native.ledges(surface, face, corner, active, *gait, samples, threads))
        return found._replace(edge=rows[found.edge])


class _Sides(NamedTuple):
    owner: Int32
    corner: Int32
    here: Float64
    there: Float64


def _sides(owners: npt.NDArray[np.intp], start: Int32, vertex: Int32, positions: Float64) -> _Sides:
    """All sides of some polygons."""
    counts = np.diff(start)[owners]
    owner = np.repeat(owners, counts)
    corner = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    here = vertex[start[owner] + corner]
    there = vertex[start[owner] + (corner + 1) % np.repeat(counts, counts)]
    return _Sides(owner.astype(np.int32), corner.astype(np.int32), positions[here], positions[there])


def _within(level: Level, passes_to: Int32) -> Int32:
    """The same without ways into sectors that cannot be computed with: those are blocked."""
    into = passes_to >= 0
    known = np.append(level.sound_sectors, False)[np.where(into, passes_to, -1)]
    return np.where(into & ~known, STOPS, passes_to).astype(np.int32)
