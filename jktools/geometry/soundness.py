"""Whether a mesh is sound: sectors closed, wound one way and apart, edges with a length; each with the distance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools._native_geometry import sector_closure as native_closure  # noqa: TID251 (this package is the door)
from jktools._native_geometry import sector_overlaps as native_overlaps  # noqa: TID251 (this package is the door)
from jktools._native_geometry import surface_edges as native_edges  # noqa: TID251 (this package is the door)
from jktools.geometry.mesh import Bool, Float64, Int32, SectorMesh


class Closure(NamedTuple):
    """One entry a sector: its open edges, the longest of them, and the volume within its surfaces."""

    open: Int32
    """Directed edges that no edge of the sector matches the other way; an edge along two shorter ones counts."""
    surface: Int32
    """Of the longest open edge; -1 for a closed sector."""
    corner: Int32
    """At which that edge starts, within its surface; -1 for a closed sector."""
    length: Float64
    """JKU."""
    volume: Float64
    """JKU cubed; negative when the surfaces of a closed sector face outward on the whole."""
    certain: Bool
    """Whether the sign of the volume is beyond rounding."""


class Edges(NamedTuple):
    """One entry a surface: its shortest edge, and the triangles of its fan that have no area."""

    corner: Int32
    """At which the shortest edge starts; -1 for a surface without corners."""
    length: Float64
    """JKU; 0 exactly when both ends coincide."""
    degenerate: Int32
    """Triangles (v0, vi, vi+1) whose corners lie on one line, exactly; sight leaves them out."""


class Overlaps(NamedTuple):
    """One entry a pair of sectors that overlap, sorted."""

    first: Int32
    second: Int32
    depth: Float64
    """How far one must be moved to be clear of the other, JKU; neighbours overlap by as much as their face is bent."""


def sector_closure(mesh: SectorMesh) -> Closure:
    """Match each sector's directed edges by exact position and measure its volume.

    An edge that runs back along two shorter ones is open here: the fans do not bound a solid then, to the bit. For
    rules `open_edges` lays edges along each other with a tolerance, and such an edge is closed; it works on a level's
    corners and tells no volume.
    """
    count, surface, corner, length, volume, certain = native_closure(mesh.native)
    return Closure(count, surface, corner, length, volume, certain.view(np.bool_))


def surface_edges(mesh: SectorMesh) -> Edges:
    """Find each surface's shortest edge and its triangles without area, exactly."""
    return Edges(*native_edges(mesh.native))


def sector_overlaps(mesh: SectorMesh) -> Overlaps:
    """Find the pairs of sectors whose convex hulls overlap, and how deep.

    A pair is apart when the plane of one of their triangles parts them exactly. The depth of the others is
    measured over all separating axes in float64; what does not exceed rounding (2^-44 of the pair's size) is
    apart too.
    """
    return Overlaps(*native_overlaps(mesh.native))
