"""Intervals of edges as columns: cut where values pass limits or at places, looked up, and put together."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from jktools.geometry.ledges import Beyond

Float64 = npt.NDArray[np.float64]
Rows = npt.NDArray[np.intp]

PAIRS = (("drop_start", "drop_end"), ("past_start", "past_end"), ("far_start", "far_end"))
"""The columns that change evenly along an interval."""


def take(found: Beyond, rows: npt.NDArray[np.bool_] | Rows) -> Beyond:
    """Give some of the intervals."""
    return Beyond._make(column[rows] for column in found)


def between(start: Float64, end: Float64, part: Float64) -> Float64:
    """Give the values a part, 0 to 1, of the way from start to end; infinite ones stay."""
    with np.errstate(invalid="ignore"):
        return np.where(start == end, start, start + (end - start) * part)


def rows_at(found: Beyond, edges: npt.ArrayLike, places: npt.ArrayLike) -> Rows:
    """Find the interval that holds each place, 0 to 1, of its edge; one that ends there holds it too."""
    wanted = np.asarray(edges, np.float64) + np.asarray(places, np.float64)
    return np.minimum(np.searchsorted(found.edge + found.end, wanted), max(len(found.edge) - 1, 0))


def cut_at(found: Beyond, edges: npt.ArrayLike, places: npt.ArrayLike) -> tuple[Beyond, Rows]:
    """Cut intervals at places, 0 to 1, of edges; also which interval each piece is of."""
    at, on = np.asarray(places, np.float64), np.asarray(edges, np.int64)
    whole = np.arange(len(found.edge))
    if not len(at) or not len(whole):
        return found, whole
    row = rows_at(found, on, at)
    inside = (found.edge[row] == on) & (found.start[row] < at) & (at < found.end[row])
    cuts = np.unique(np.stack([row[inside].astype(np.float64), at[inside]], axis=1), axis=0)
    source = np.concatenate([whole, cuts[:, 0].astype(np.intp)])
    start = np.concatenate([found.start, cuts[:, 1]])
    order = np.lexsort([start, source])
    source, start = source[order], start[order]
    last = np.append(source[1:] != source[:-1], True)
    end = np.where(last, found.end[source], np.append(start[1:], 1.0))
    pieces = take(found, source)
    width = pieces.end - pieces.start
    changed = {"start": start, "end": end}
    for first, second in PAIRS:
        values = getattr(pieces, first), getattr(pieces, second)
        for name, place in ((first, start), (second, end)):
            changed[name] = between(*values, (place - pieces.start) / width)
    return pieces._replace(**changed), source


def cut_through(found: Beyond, pair: tuple[str, str], limits: Iterable[float]) -> Beyond:
    """Cut intervals where a value passes a limit."""
    edges, places = [], []
    first, second = (getattr(found, name) for name in pair)
    for limit in limits:
        before, after = first - limit, second - limit
        crossing = np.flatnonzero((before < 0) & (after > 0) | (before > 0) & (after < 0))
        crossing = crossing[np.isfinite(before[crossing]) & np.isfinite(after[crossing])]
        part = before[crossing] / (before[crossing] - after[crossing])
        edges.append(found.edge[crossing])
        places.append(found.start[crossing] + part * (found.end - found.start)[crossing])
    return cut_at(found, np.concatenate(edges), np.concatenate(places))[0]
