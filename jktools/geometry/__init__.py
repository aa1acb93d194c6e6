"""Sector geometry: exact tests of what a level's polygons are."""

from jktools.geometry.adjoins import Alignment, adjoin_alignment
from jktools.geometry.closedness import OpenEdges, open_edges
from jktools.geometry.corners import Corners, corners_of
from jktools.geometry.extent import Extent, centers_outside, sector_extent, sector_vertices
from jktools.geometry.nonconvexity import Behind, vertices_behind
from jktools.geometry.normals import NormalFit, normal_fit
from jktools.geometry.validity import (
    Concavity,
    Convexity,
    Outside,
    Planarity,
    collide_boxes_outside,
    points_outside,
    sector_convexity,
    surface_concavity,
    surface_planarity,
)

__all__ = [
    "Alignment",
    "Behind",
    "Concavity",
    "Convexity",
    "Corners",
    "Extent",
    "NormalFit",
    "OpenEdges",
    "Outside",
    "Planarity",
    "adjoin_alignment",
    "centers_outside",
    "collide_boxes_outside",
    "corners_of",
    "normal_fit",
    "open_edges",
    "points_outside",
    "sector_convexity",
    "sector_extent",
    "sector_vertices",
    "surface_concavity",
    "surface_planarity",
    "vertices_behind",
]
