"""Sector geometry: exact tests of what a level's polygons are, and sight among them."""

from jktools.geometry.adjoins import Alignment, adjoin_alignment
from jktools.geometry.closedness import OpenEdges, open_edges
from jktools.geometry.corners import Corners, corners_of
from jktools.geometry.drop import ABSENT, CARRIES, STOPS, Drop, Ending
from jktools.geometry.extent import Extent, centers_outside, sector_extent, sector_vertices
from jktools.geometry.mesh import BLOCKS, Accuracy, Explanation, Location, SectorMesh, Sight, Step
from jktools.geometry.nonconvexity import Behind, vertices_behind
from jktools.geometry.normals import NormalFit, normal_fit
from jktools.geometry.plan import Plan
from jktools.geometry.soundness import (
    Closure,
    Edges,
    Overlaps,
    sector_closure,
    sector_overlaps,
    surface_edges,
)
from jktools.geometry.validity import (
    Convexity,
    Outside,
    Planarity,
    Turns,
    collide_boxes_outside,
    corner_turns,
    points_outside,
    sector_convexity,
    surface_planarity,
)
from jktools.geometry.visibility import Progress, VisibleSectors, compressed, expanded, unpacked

__all__ = [
    "ABSENT",
    "BLOCKS",
    "CARRIES",
    "STOPS",
    "Accuracy",
    "Alignment",
    "Behind",
    "Closure",
    "Convexity",
    "Corners",
    "Drop",
    "Edges",
    "Ending",
    "Explanation",
    "Extent",
    "Location",
    "NormalFit",
    "OpenEdges",
    "Outside",
    "Overlaps",
    "Plan",
    "Planarity",
    "Progress",
    "SectorMesh",
    "Sight",
    "Step",
    "Turns",
    "VisibleSectors",
    "adjoin_alignment",
    "centers_outside",
    "collide_boxes_outside",
    "compressed",
    "corner_turns",
    "corners_of",
    "expanded",
    "normal_fit",
    "open_edges",
    "points_outside",
    "sector_closure",
    "sector_convexity",
    "sector_extent",
    "sector_overlaps",
    "sector_vertices",
    "surface_edges",
    "surface_planarity",
    "unpacked",
    "vertices_behind",
]
