"""What a sector says about its extent, against where its vertices are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.corners import Float64, Index
from jktools.geometry.validity import Outside, points_outside
from jktools.model import Level


class Extent(NamedTuple):
    """One entry a sector, NaN where it has no vertices, is not sound or does not say.

    `box` is the greatest difference of a coordinate of the written bound box from the vertices' box; `radius` is
    how far the farthest vertex from the written centre is. JKU.
    """

    box: Float64
    radius: Float64


def sector_extent(level: Level) -> Extent:
    """Measure each sector's vertices: those that it lists and the corners of its surfaces, listed or not."""
    table, surfaces = level.document.sectors, level.document.surfaces
    counts = np.diff(table.vertex_start)
    measured = level.sound_sectors & (counts > 0)
    sectors = np.flatnonzero(measured)
    box, radius = np.full(len(counts), np.nan), np.full(len(counts), np.nan)
    if len(sectors):
        first = table.first_surface[sectors]
        corner_start = surfaces.corner_start[first]
        corners = surfaces.corner_start[first + table.surface_count[sectors]] - corner_start
        places = np.repeat(corner_start - np.cumsum(corners) + corners, corners) + np.arange(corners.sum())
        listed = table.vertex[np.repeat(measured, counts)]
        numbers = np.arange(len(sectors))
        owner = np.concatenate([np.repeat(numbers, counts[sectors]), np.repeat(numbers, corners)])
        order = np.argsort(owner, kind="stable")
        owner = owner[order]
        position = level.vertices[np.concatenate([listed, surfaces.corner_vertex[places]])[order]].astype(np.float64)
        starts = np.flatnonzero(np.diff(owner, prepend=-1))
        ends = np.concatenate([np.minimum.reduceat(position, starts), np.maximum.reduceat(position, starts)], axis=1)
        box[sectors] = np.abs(table.bound_box[sectors] - ends).max(axis=1)
        away = np.linalg.norm(position - table.center[sectors].astype(np.float64)[owner], axis=1)
        radius[sectors] = np.maximum.reduceat(away, starts)
    return Extent(box, radius)


def centers_outside(level: Level) -> tuple[Index, Outside]:
    """Test where each sector's written centre lies: the sectors' indices, and how far each centre is outside."""
    center = level.document.sectors.center
    sectors = np.flatnonzero(level.sound_sectors & np.isfinite(center).all(axis=1))
    return sectors, points_outside(level, center[sectors], sectors)


def sector_vertices(level: Level) -> list[tuple[frozenset[int], frozenset[int]]]:
    """For each sector, the vertices that it lists and those that its surfaces use; empty where it is not sound."""
    sectors, surfaces = level.document.sectors, level.document.surfaces
    listed, used = sectors.vertex.tolist(), surfaces.corner_vertex.tolist()
    ends, corners = sectors.vertex_start.tolist(), surfaces.corner_start.tolist()
    found = []
    for i, sound in enumerate(level.sound_sectors.tolist()):
        first = int(sectors.first_surface[i])
        last = first + int(sectors.surface_count[i])
        found.append(
            (frozenset(listed[ends[i] : ends[i + 1]]), frozenset(used[corners[first] : corners[last]]))
            if sound
            else (frozenset[int](), frozenset[int]())
        )
    return found
