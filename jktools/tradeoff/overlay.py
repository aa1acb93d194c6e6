"""Two sets of intervals along the same edges, cut at each other's ends."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Float64 = npt.NDArray[np.float64]
Intp = npt.NDArray[np.intp]


class Intervals(NamedTuple):
    """Intervals in the order of their edges and along them, (n,) each: `start` to `end` in 0 .. 1."""

    edge: npt.NDArray[np.int32]
    start: Float64
    end: Float64


class Pieces(NamedTuple):
    """What no end of either set cuts, (n,) each."""

    edge: Intp
    start: Float64
    end: Float64
    one: Intp
    """Row of the first set, -1 where it has none there."""
    other: Intp

    @property
    def middle(self) -> Float64:
        """0 .. 1 along the edge."""
        return (self.start + self.end) / 2


def overlay(one: Intervals, other: Intervals) -> Pieces:
    """Cut all edges at the ends of both."""
    edges = [np.repeat(np.asarray(each.edge, np.int64), 2) for each in (one, other)]
    places = [np.stack([each.start, each.end], axis=1).reshape(-1) for each in (one, other)]
    cuts = np.unique(np.stack([np.concatenate(edges).astype(np.float64), np.concatenate(places)], axis=1), axis=0)
    follows = cuts[1:, 0] == cuts[:-1, 0]
    edge, start, end = cuts[:-1, 0][follows].astype(np.intp), cuts[:-1, 1][follows], cuts[1:, 1][follows]
    rows = [_row(each, edge, (start + end) / 2) for each in (one, other)]
    return Pieces(edge, start, end, *rows)


def _row(intervals: Intervals, edge: Intp, place: Float64) -> Intp:
    """The interval that holds each place."""
    if not len(intervals.edge):
        return np.full(len(edge), -1, np.intp)
    # Places are within 0 and 1, so that edges order before them; ties of rounding are settled by the check below.
    row = np.searchsorted(intervals.edge + intervals.end, edge + place)
    row = np.minimum(row, len(intervals.edge) - 1)
    for step in (-1, 1):
        misses = ~_holds(intervals, row, edge, place)
        beside = np.clip(row + step, 0, len(intervals.edge) - 1)
        row = np.where(misses & _holds(intervals, beside, edge, place), beside, row)
    return np.where(_holds(intervals, row, edge, place), row, -1)


def _holds(intervals: Intervals, row: Intp, edge: Intp, place: Float64) -> npt.NDArray[np.bool_]:
    return np.asarray((intervals.edge[row] == edge) & (intervals.start[row] <= place) & (place <= intervals.end[row]))
