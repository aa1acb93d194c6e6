"""Whether each sector's surfaces close it: every edge of one must run back along others.

Made for rules, where vertices that lie along an edge are no fault: edges are laid along each other, within a tolerance.
`jktools.geometry.soundness.sector_closure` asks something else, whether edges match one for one and exactly, as it must
be for the volume that it gives to mean anything. A sector that is closed here may be open there, and the volume needs
the mesh: so there are two.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.geometry.corners import Corners, Float64, Index, greatest_by
from jktools.model import Level

Bool = npt.NDArray[np.bool_]


class OpenEdges(NamedTuple):
    """One entry a sector: its longest open stretch of an edge (JKU), and the corner that the edge starts at.

    `corner` is a position in `Corners`, -1 for a closed sector; `edges` says how many are open.
    """

    corner: Index
    length: Float64
    edges: Index


def open_edges(level: Level, corners: Corners, tolerance: float) -> OpenEdges:
    """Find edges that no other surface of the sector runs back along.

    Edges that meet vertex by vertex are settled by their exact positions. What remains is laid along each other:
    an edge may run back along several, and its ends may lie up to `tolerance` (JKU) beside them.
    """
    sector = level.surface_sector[corners.surface]
    count = len(level.sectors)
    left = np.flatnonzero(_unpaired(corners, sector.astype(np.intp)) & (sector >= 0))
    left = left[level.sound_sectors[sector[left]]]
    gaps = np.zeros(len(left))
    for group in _groups(sector[left].astype(np.intp)):
        edges = left[group]
        start, end = corners.position[edges], corners.position[corners.following[edges]]
        gaps[group] = [_longest_gap(start, end, i, tolerance) for i in range(len(edges))]
    owner = sector[left].astype(np.intp)
    at, length = greatest_by(owner, gaps, count)
    corner = np.where(at >= 0, left[at], -1) if len(left) else at
    return OpenEdges(corner, length, np.bincount(owner[gaps > tolerance], minlength=count).astype(np.intp))


def _unpaired(corners: Corners, sector: Index) -> Bool:
    """Edges that another edge of the sector does not undo, end for end."""
    start = _same(*(corners.position.T + 0.0))  # -0 becomes 0
    end = start[corners.following]
    edge = _same(sector, np.minimum(start, end), np.maximum(start, end))
    balance = np.bincount(edge, np.sign(end - start))
    return np.asarray(balance[edge] != 0)


def _same(*columns: npt.NDArray[np.generic]) -> Index:
    """Number the distinct rows of some columns: the number of each row, from 0."""
    number = np.zeros(len(columns[0]), np.int64)
    for column in columns:
        _, own = np.unique(column, return_inverse=True)
        # Renumbered at each step, the product stays below the square of the number of rows.
        _, number = np.unique(number * (len(own) + 1) + own.reshape(-1), return_inverse=True)
        number = number.reshape(-1)
    return number.astype(np.intp)


def _groups(owner: Index) -> Iterator[Index]:
    """Positions of equal values, group by group."""
    order = np.argsort(owner, kind="stable")
    yield from np.split(order, np.flatnonzero(np.diff(owner[order])) + 1) if len(order) else ()


def _longest_gap(start: Float64, end: Float64, i: int, tolerance: float) -> float:
    """The longest stretch of edge i that the edges along it do not undo, JKU."""
    length = float(np.linalg.norm(end[i] - start[i]))
    if length <= tolerance:
        return 0.0
    direction = (end[i] - start[i]) / length
    along = np.stack([start - start[i], end - start[i]]) @ direction
    low, high = np.clip(along, 0, length).min(axis=0), np.clip(along, 0, length).max(axis=0)
    near = (high > low) & (_beside(start, end, along, start[i], direction, length) <= tolerance)
    low, high, sense = low[near], high[near], np.sign(along[1] - along[0])[near]
    cuts = np.unique(np.concatenate([low, high]))
    middle = (cuts[1:] + cuts[:-1]) / 2
    cover = ((low <= middle[:, None]) & (middle[:, None] <= high)) @ sense
    return _longest_run(cuts, cover > 0)


def _beside(
    start: Float64, end: Float64, along: Float64, origin: Float64, direction: Float64, length: float
) -> Float64:
    """How far edges lie beside a line, over the stretch from its origin to `length` alone.

    Beyond it a short edge, whose ends are rounded, says little of where its line goes.
    """
    reach = along[1] - along[0]
    farthest = np.zeros(len(start))
    for to in np.clip(along, 0, length):
        share = np.divide(to - along[0], reach, out=np.zeros(len(start)), where=reach != 0)
        point = start + share[:, None] * (end - start) - origin
        aside = point - (point @ direction)[:, None] * direction
        farthest = np.maximum(farthest, np.linalg.norm(aside, axis=1))
    return farthest


def _longest_run(cuts: Float64, open_: Bool) -> float:
    longest = run = 0.0
    for width, is_open in zip(np.diff(cuts).tolist(), open_.tolist(), strict=True):
        run = run + width if is_open else 0.0
        longest = max(longest, run)
    return longest
