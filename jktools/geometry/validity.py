"""Whether surfaces and sectors are what the engine takes them for, with the measured distance.

Records that cannot be computed with (broken, or naming vertices that do not exist) count as valid here: other
findings tell of them. Coordinates are the level's float32 values, exact in float64.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_geometry import points_outside as native_points_outside  # noqa: TID251 (this package is the door)
from jktools._native_geometry import sector_convexity as native_sector_convexity  # noqa: TID251 (this package is the door)
from jktools.geometry.corners import corners_of
from jktools.model import Level

Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]


class Convexity(NamedTuple):
    """One entry a sector: how many (surface, vertex) pairs are not convex, and the worst pair."""

    behind: Int32
    surface: Int32
    """-1 for a convex sector."""
    vertex: Int32
    distance: Float64
    """How far the vertex lies behind the surface, JKU."""


class Outside(NamedTuple):
    """One entry a point: the surface of its sector that it is farthest behind (-1: none), and by how much (JKU)."""

    surface: Int32
    distance: Float64


class Planarity(NamedTuple):
    """One entry a surface: the corner farthest from the surface's plane, and its distance (JKU)."""

    corner: Int32
    distance: Float64


class Turns(NamedTuple):
    """One entry a corner of the sound surfaces, in the order of the file.

    `cross` is the component along the normal of the cross product of the two edges, JKU squared, negative for a
    reflex corner: the figure that JED and SED compare. `depth` is how far the corner lies inside the line through
    its neighbours, JKU.
    """

    surface: npt.NDArray[np.intp]
    corner: npt.NDArray[np.intp]
    cross: Float64
    depth: Float64


class _Polygons(NamedTuple):
    """The level's sound polygons in the form of the native door; unsound records are empty."""

    positions: Float64
    surface_start: Int32
    surface_vertex: Int32
    sector_first: Int32
    sector_count: Int32


def _polygons(level: Level) -> _Polygons:
    surfaces, sectors = level.document.surfaces, level.document.sectors
    positions = np.where(np.isfinite(level.vertices), level.vertices, 0).astype(np.float64)
    corners = np.where(level.sound_surfaces, np.diff(surfaces.corner_start), 0)
    start = np.concatenate([[0], np.cumsum(corners)]).astype(np.int32)
    keep = np.repeat(level.sound_surfaces, np.diff(surfaces.corner_start))
    return _Polygons(
        positions.ravel(),
        start,
        surfaces.corner_vertex[keep],
        np.where(level.sound_sectors, sectors.first_surface, 0).astype(np.int32),
        np.where(level.sound_sectors, sectors.surface_count, 0).astype(np.int32),
    )


def sector_convexity(level: Level) -> Convexity:
    """Test every sector's vertices against its surfaces; the sides are exact (CGAL's orientation predicate)."""
    table = level.document.sectors
    counts = np.where(level.sound_sectors, np.diff(table.vertex_start), 0)
    start = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    vertex = table.vertex[np.repeat(level.sound_sectors, np.diff(table.vertex_start))]
    return Convexity(*native_sector_convexity(*_polygons(level), start, vertex))


def points_outside(level: Level, points: npt.ArrayLike, sectors: npt.ArrayLike) -> Outside:
    """Test points, (n, 3) JKU, against the surfaces of their sectors, (n,); the sides are exact.

    Raises ValueError when a sector does not exist or a point is not finite.
    """
    flat = np.ascontiguousarray(points, np.float64).reshape(-1)
    return Outside(*native_points_outside(*_polygons(level), flat, np.ascontiguousarray(sectors, np.int32)))


def collide_boxes_outside(level: Level) -> tuple[Int32, Outside]:
    """Test the corners of each collide box: its sectors' indices, and the worst corner of each."""
    boxes = level.document.sectors.collide_box
    sectors = np.flatnonzero(np.isfinite(boxes).all(axis=1) & level.sound_sectors).astype(np.int32)
    low, high = boxes[sectors, :3], boxes[sectors, 3:]
    pick = (np.arange(8)[:, None] >> np.arange(3)) & 1
    corners = np.where(pick[None] == 1, high[:, None], low[:, None])
    found = points_outside(level, corners, np.repeat(sectors, 8))
    distance = found.distance.reshape(-1, 8)
    worst = distance.argmax(axis=1)
    rows = np.arange(len(sectors))
    return sectors, Outside(found.surface.reshape(-1, 8)[rows, worst], distance[rows, worst])


def surface_planarity(level: Level) -> Planarity:
    """Measure every surface's corners against its plane.

    The plane has the direction of the polygon's vector area (Newell) and goes through its first corner; JED and SED
    measure from the first corner too, with the written normal, whose rounding at large coordinates exceeds the
    tolerance.
    """
    corners = corners_of(level)
    count = len(level.document.surfaces)
    corner, distance = np.full(count, -1, np.int32), np.zeros(count)
    off = np.abs(((corners.position - corners.position[corners.first]) * corners.normal[corners.surface]).sum(axis=1))
    order = np.argsort(off, kind="stable")
    order = order[off[order] > 0]
    corner[corners.surface[order]] = corners.place[order]  # assignment in order: the greatest one stays
    distance[corners.surface[order]] = off[order]
    return Planarity(corner, distance)


def corner_turns(level: Level) -> Turns:
    """Measure every corner's turn, as JED and SED do: (next - here) x (previous - here) along the normal."""
    corners = corners_of(level)
    forward = corners.edge
    backward = corners.position[corners.preceding] - corners.position
    cross = (np.cross(forward, backward) * corners.normal[corners.surface]).sum(axis=1)
    chord = np.linalg.norm(forward - backward, axis=1)
    depth = np.divide(-cross, chord, out=np.zeros_like(cross), where=chord > 0)
    return Turns(corners.surface, corners.place, cross, depth)
