"""Sector geometry: exact tests of what a level's polygons are, and sight among them."""

from jktools.geometry.mesh import BLOCKS, Accuracy, Explanation, Location, SectorMesh, Sight, Step
from jktools.geometry.soundness import (
    Closure,
    Edges,
    Overlaps,
    sector_closure,
    sector_overlaps,
    surface_edges,
)
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
    "BLOCKS",
    "Accuracy",
    "Closure",
    "Concavity",
    "Convexity",
    "Edges",
    "Explanation",
    "Location",
    "Outside",
    "Overlaps",
    "Planarity",
    "SectorMesh",
    "Sight",
    "Step",
    "collide_boxes_outside",
    "points_outside",
    "sector_closure",
    "sector_convexity",
    "sector_overlaps",
    "surface_concavity",
    "surface_edges",
    "surface_planarity",
]
