"""Where sectors are not convex by what the engine draws and by what it collides with."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.corners import Corners, Float64, Index
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
    sectors, surfaces = level.document.sectors, level.document.surfaces
    own = np.diff(sectors.vertex_start).astype(np.intp)
    sector = np.repeat(np.arange(len(own)), np.where(level.sound_sectors, sectors.surface_count, 0))
    surface = np.arange(len(sector)) - np.searchsorted(sector, sector) + sectors.first_surface[sector]
    # Every surface of a sector with every vertex that the sector lists: rows of one surface stand together.
    pairs = own[sector]
    row = np.repeat(np.arange(len(sector)), pairs)
    place = np.arange(len(row)) - np.repeat(np.cumsum(pairs) - pairs, pairs) + sectors.vertex_start[sector[row]]
    vertex = sectors.vertex[place].astype(np.intp)
    first = surfaces.corner_vertex[np.minimum(surfaces.corner_start[surface], len(surfaces.corner_vertex) - 1)]
    away = (level.vertices[vertex].astype(np.float64) - level.vertices[first[row]]) if len(row) else np.zeros((0, 3))
    written = np.full((len(surfaces), 3), np.nan)
    rows = min(len(surfaces), len(level.document.normals))
    written[:rows] = level.document.normals.direction[:rows]
    drawn = -(away * corners.normal[surface[row]]).sum(axis=1)
    collided = -(away * written[surface[row]]).sum(axis=1)
    distance = np.fmin(drawn, collided)  # of a missing normal, NaN, the other counts
    far = np.flatnonzero(distance > tolerance)
    return Behind(sector[row[far]], surface[row[far]], vertex[far], distance[far])
