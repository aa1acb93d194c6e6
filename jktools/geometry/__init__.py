"""Sector geometry: exact tests of what a level's polygons are."""

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
    "Concavity",
    "Convexity",
    "Outside",
    "Planarity",
    "collide_boxes_outside",
    "points_outside",
    "sector_convexity",
    "surface_concavity",
    "surface_planarity",
]
