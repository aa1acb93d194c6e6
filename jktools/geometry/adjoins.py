"""Whether the two surfaces of an adjoin are one polygon seen from both sides."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.corners import Corners, Float64, Index, batches
from jktools.model import Level


class Alignment(NamedTuple):
    """One entry a pair of adjoins that name each other and are both carried by sound surfaces.

    `distance` is the farthest that a corner of one polygon lies from the other's outline, JKU. `facing` is the
    cosine of the angle between their normals: -1 where they face each other, 0 where one has no area.
    """

    adjoin: Index
    distance: Float64
    facing: Float64


def adjoin_alignment(level: Level, corners: Corners) -> Alignment:
    """Measure how far the surfaces of each pair are from being one polygon; corners within an edge do not count."""
    adjoin = _pairs(level)
    mirror = level.document.adjoins.mirror[adjoin]
    here, there = level.adjoin_surface[adjoin], level.adjoin_surface[mirror]
    away = _farthest(corners, np.concatenate([here, there]), np.concatenate([there, here]))
    facing = (corners.normal[here] * corners.normal[there]).sum(axis=1)
    return Alignment(adjoin, np.maximum(away[: len(adjoin)], away[len(adjoin) :]), facing)


def _pairs(level: Level) -> Index:
    """The lower adjoin of each pair that can be measured."""
    mirror = level.document.adjoins.mirror
    here = np.arange(len(mirror))
    low = np.flatnonzero((mirror > here) & (mirror < len(mirror)) & ~level.document.adjoins.broken)
    back = mirror[low]
    low = low[mirror[back] == low]
    carriers = np.stack([level.adjoin_surface[low], level.adjoin_surface[mirror[low]]])
    sound = np.append(level.sound_surfaces, False)  # -1, no surface, finds the last one
    corners = np.append(np.diff(level.document.surfaces.corner_start), 0)
    return np.asarray(low[(sound[carriers] & (corners[carriers] > 0)).all(axis=0)])


def _farthest(corners: Corners, of: Index, from_: Index) -> Float64:
    """For each pair of surfaces, the farthest that a corner of the first lies from the outline of the second."""
    start = np.searchsorted(corners.surface, np.arange(len(corners.area) + 1))
    sizes = np.diff(start)[of] * np.diff(start)[from_]
    return np.concatenate([np.zeros(0), *(_farthest_of(corners, start, of[b], from_[b]) for b in batches(sizes))])


def _farthest_of(corners: Corners, start: Index, of: Index, from_: Index) -> Float64:
    """The same for some of the pairs; `start` is where the corners of each surface begin."""
    points, edges = np.diff(start)[of], np.diff(start)[from_]
    # Every corner of the first with every edge of the second: rows of one pair, then of one corner, stand together.
    pair = np.repeat(np.arange(len(of)), points * edges)
    row = np.arange(len(pair)) - np.repeat(np.cumsum(points * edges) - points * edges, points * edges)
    point = start[of[pair]] + row // edges[pair]
    edge = start[from_[pair]] + row % edges[pair]
    away = _distance_to_segment(
        corners.position[point], corners.position[edge], corners.position[corners.following[edge]]
    )
    nearest = np.minimum.reduceat(away, np.flatnonzero(row % edges[pair] == 0))
    return np.asarray(np.maximum.reduceat(nearest, np.cumsum(points) - points))


def _distance_to_segment(point: Float64, start: Float64, end: Float64) -> Float64:
    """(n,) distances of points from segments, all (n, 3)."""
    along = end - start
    squared = (along * along).sum(axis=1)
    t = np.divide(((point - start) * along).sum(axis=1), squared, out=np.zeros(len(point)), where=squared > 0)
    return np.asarray(np.linalg.norm(point - start - np.clip(t, 0, 1)[:, None] * along, axis=1))
