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


class Beyond(NamedTuple):
    """Intervals in the order of the edges asked about, (n,) each."""

    edge: Int32
    """Row of the edge."""
    start: Float64
    end: Float64
    """0 .. 1 along the edge."""
    over: UInt8
    """An `Over`."""
    met: Int32
    """The surface come onto, the adjoin's into the water, or the one that blocks; -1 for none."""
    sector: Int32
    """Where the way ends."""
    drop_start: Float64
    drop_end: Float64
    """From the edge down to what is come onto, JKU, at both ends; NaN for VOID and BLOCKED."""
    rise: Int32
    """How many times the body had to rise by the step asked for to pass."""
    past: Float64
    far: Float64
    """The drop one and two radii past the edge, at the middle of the interval; infinite where no floor is, NaN where
    the body does not get there."""


class Gait(NamedTuple):
    """How a body goes over an edge, JKU: its centre `hover` over its floor; where that is blocked, `rise` higher, up to
    `rises` times."""

    hover: float
    radius: float
    rise: float
    rises: int


class EdgeWalker:
    """A level made ready for questions about the edges of its floors."""

    def __init__(self, level: Level) -> None:
        """Take the sectors that can be computed with; a way into another is blocked."""
        positions, start, vertex, _, first, count = mesh_arrays(level)
        ground = ground_of(level)
        self._native = Strides(
            positions, start, vertex, _within(level, ground.passes_to), ground.under_water.view(np.uint8), first, count
        )
        self.floors: Bool = self._native.floors().view(np.bool_)
        """(surfaces,): what bodies stand on: solid, with flag 0x1, facing up."""
        surfaces = np.flatnonzero(self.floors)
        corners = np.diff(start)[surfaces]
        self.surface: Int32 = np.repeat(surfaces, corners).astype(np.int32)
        """(edges,): the floor of each edge."""
        self.corner: Int32 = (np.arange(len(self.surface)) - np.repeat(np.cumsum(corners) - corners, corners)).astype(
            np.int32
        )
        """(edges,): the corner of the surface that it begins at; it ends at the following one."""
        self._start, self._vertex, self._positions = start, vertex, positions.reshape(-1, 3)

    def ends(self, edges: npt.ArrayLike) -> tuple[Float64, Float64]:
        """Both ends of edges, (n, 3) JKU."""
        rows = np.asarray(edges, np.intp)
        surface, corner = self.surface[rows], self.corner[rows]
        first, count = self._start[surface], np.diff(self._start)[surface]
        here, there = self._vertex[first + corner], self._vertex[first + (corner + 1) % count]
        return self._positions[here], self._positions[there]

    def beyond(self, gait: Gait, samples: int = 0, threads: int = 0) -> Beyond:
        """Answer for every edge: exact intervals, or `samples` places an edge that each stand for their part.

        Seen is what lies straight below `BEYOND` past the edge, when the body's centre came there on a straight way.
        Its width, and headroom above its centre, are not looked at.
        """
        return Beyond(*self._native.ledges(self.surface, self.corner, *gait, samples, threads))


def _within(level: Level, passes_to: Int32) -> Int32:
    """The same without ways into sectors that cannot be computed with: those are blocked."""
    into = passes_to >= 0
    known = np.append(level.sound_sectors, False)[np.where(into, passes_to, -1)]
    return np.where(into & ~known, STOPS, passes_to).astype(np.int32)
