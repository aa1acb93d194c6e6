"""The corners of a level's surfaces as arrays, and each surface's plane."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.model import Level

Float64 = npt.NDArray[np.float64]
Index = npt.NDArray[np.intp]

MOST_ROWS = 1 << 20
"""Rows of a table of pairs at a time: some 100 MB."""


class Corners(NamedTuple):
    """Corners of the sound surfaces, in the order of the file, with float64 positions in JKU.

    `following` and `preceding` are positions in these arrays, as is `first`, each corner's surface's first one.
    """

    surface: Index
    vertex: Index
    position: Float64
    first: Index
    following: Index
    preceding: Index
    area: Float64
    """(surfaces, 3): twice the vector area (Newell), 0 for a surface that is not sound."""

    @property
    def normal(self) -> Float64:
        """(surfaces, 3): the unit normal of each surface's polygon, 0 where it has no area."""
        length = np.linalg.norm(self.area, axis=1, keepdims=True)
        unit: Float64 = np.divide(self.area, length, out=np.zeros_like(self.area), where=length > 0)
        return unit

    @property
    def edge(self) -> Float64:
        """(corners, 3): from each corner to the following one."""
        return np.asarray(self.position[self.following] - self.position)

    @property
    def place(self) -> Index:
        """(corners,): which corner of its surface each one is, from 0."""
        return np.asarray(np.arange(len(self.first)) - self.first)


def corners_of(level: Level) -> Corners:
    """Gather the corners of every surface that was read and whose vertices exist."""
    table = level.document.surfaces
    written = np.diff(table.corner_start)
    counts = np.where(level.sound_surfaces, written, 0)
    surface = np.repeat(np.arange(len(counts)), counts)
    vertex = table.corner_vertex[np.repeat(level.sound_surfaces, written)].astype(np.intp)
    position = level.vertices[vertex].astype(np.float64)
    starts = np.concatenate([[0], np.cumsum(counts)])
    first, last = starts[surface], starts[surface + 1] - 1
    here = np.arange(len(surface))
    following = np.where(here == last, first, here + 1)
    preceding = np.where(here == first, last, here - 1)
    # Newell's vector area about each surface's first corner, which keeps the products small far from the origin.
    local = position - position[first]
    area = sum_by(surface, np.cross(local, local[following]), len(counts))
    return Corners(surface, vertex, position, first, following, preceding, area)


def sum_by(group: Index, vectors: Float64, count: int) -> Float64:
    """Add (n, 3) vectors up by their group, 0 .. count - 1: (count, 3)."""
    # Without a single value bincount falls back to whole numbers.
    return np.stack([np.bincount(group, vectors[:, axis], count) for axis in range(3)], axis=1).astype(np.float64)


def greatest_by(group: Index, values: Float64, count: int) -> tuple[Index, Float64]:
    """The position of the greatest positive value of each group (-1: none), the first of equals, and that value."""
    at, greatest = np.full(count, -1, np.intp), np.zeros(count)
    order = np.argsort(values, kind="stable")
    order = order[values[order] > 0]
    greatest[group[order]] = values[order]  # assignment in order: the greatest one stays
    at[group[order]] = order
    return at, greatest


def batches(sizes: Index, most: int = MOST_ROWS) -> Iterator[slice]:
    """Cut a sequence into runs whose sizes add up to at most `most`; a greater one stands alone."""
    start = total = 0
    for i, size in enumerate(sizes.tolist()):
        if total + size > most and i > start:
            yield slice(start, i)
            start, total = i, 0
        total += size
    if len(sizes):
        yield slice(start, len(sizes))
