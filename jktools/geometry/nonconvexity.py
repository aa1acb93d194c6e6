"""Where sectors are not convex by what the engine draws and by what it collides with."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.corners import Corners, Float64, Index, batches
from jktools.geometry.normals import written_normals
from jktools.model import Level


class Behind(NamedTuple):
    """Vertices of sectors behind surfaces of the same sector, one entry a pair, sector by sector.

    `distance` is the lesser of two: behind the polygon's plane, and behind the plane of the written normal through
    the first corner (JKU).
    """

    sector: Index
    surface: Index
    vertex: Index
    distance: Float64


def vertices_behind(level: Level, corners: Corners, tolerance: float) -> Behind:
    """Find the pairs with more than `tolerance` (JKU) between them, of the sectors that are sound.

    A vertex must be behind both planes. Where coordinates are in the hundreds, float32 tilts the polygon of a long
    and low surface, and six decimals tilt its normal; each alone calls sectors bent that their author made convex.
    """
    sectors = level.document.sectors
    counts = np.where(level.sound_sectors, sectors.surface_count, 0)
    sector = np.repeat(np.arange(len(counts)), counts)
    surface = np.arange(len(sector)) - np.searchsorted(sector, sector) + sectors.first_surface[sector]
    vertices = np.diff(sectors.vertex_start).astype(np.intp)[sector]
    found = [_behind(level, corners, sector[b], surface[b], tolerance) for b in batches(vertices)]
    if not found:
        nothing = np.zeros(0, np.intp)
        return Behind(nothing, nothing, nothing, np.zeros(0))
    return Behind._make(np.concatenate(column) for column in zip(*found, strict=True))


def _behind(level: Level, corners: Corners, sector: Index, surface: Index, tolerance: float) -> Behind:
    """Test some surfaces with every vertex that their sectors list."""
    sectors, table = level.document.sectors, level.document.surfaces
    start, end = sectors.vertex_start[sector].astype(np.intp), sectors.vertex_start[sector + 1]
    row = np.repeat(np.arange(len(sector)), end - start)
    place = np.arange(len(row)) - np.searchsorted(row, row) + start[row]
    vertex = sectors.vertex[place].astype(np.intp)
    # A sound surface without corners has no plane: its area of 0 tells, whichever vertex stands in.
    first = table.corner_vertex[np.minimum(table.corner_start[surface], max(len(table.corner_vertex) - 1, 0))]
    away = level.vertices[vertex].astype(np.float64) - level.vertices[first[row]]
    drawn = -(away * corners.normal[surface][row]).sum(axis=1)
    collided = -(away * written_normals(level)[surface][row]).sum(axis=1)
    distance = np.fmin(drawn, collided)  # of a missing normal, NaN, the other counts
    far = np.flatnonzero(distance > tolerance)
    return Behind(sector[row[far]], surface[row[far]], vertex[far], distance[far])
