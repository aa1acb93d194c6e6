"""
Native geometry with exact predicates; only jktools.geometry imports it.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


class Strides:
    """A level's sectors as walking bodies meet them; immutable."""

    def __init__(self, positions: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], passes_to: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], under_water: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_count: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], solid_positions: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], face_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], face_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], face_solid: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], face_carries: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        Copy and check the mesh: positions (3n,) float64, JKU; under_water uint8; the rest int32.

        passes_to is the sector behind each surface, -1 for one that carries where it faces up, -2 for another
        that stops bodies, -3 for one that they do not meet. Face i of the things that carry bodies has the vertices
        face_vertex[face_start[i]:face_start[i + 1]] and belongs to the solid face_solid[i]. Raises ValueError
        naming the index that is out of bounds.
        """

    def floors(self) -> Annotated[NDArray[numpy.uint8], dict(shape=(None,))]:
        """Answer uint8, one entry a surface: whether bodies stand on it."""

    def ledges(self, surface: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], face: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corner: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], active: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], hover: float, radius: float, rise: float, rises: int, shallow: float, samples: int, threads: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
        """
        Answer (edge, start, end, over, met, face, sector, drop0, drop1, rise, past0, past1, far0, far1), one entry
        an interval.

        What lies beyond edge corner[i] of floor surface[i], int32, or of face[i] where that is -1, among the
        solids whose entry of active, uint8, is not 0. native/geometry/ledges.hpp says what each holds; int32,
        float64, and uint8 for over. Raises ValueError naming the row that is out of bounds.
        """

    def exact_ledges(self, surface: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], face: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corner: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], active: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], hover: float, radius: float, rise: float, rises: int, shallow: float, threads: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
        """Answer the same in exact constructions."""

class Viewer:
    """A level's sectors made ready for sight queries; immutable."""

    def __init__(self, positions: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], leads_to: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_count: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        Copy and check the mesh: positions (3n,) float64, JKU; the rest int32.

        leads_to is the sector behind each surface, -1 where sight does not pass. Raises ValueError naming the
        index that is out of bounds.
        """

    def sight(self, origins: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], sectors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], targets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], accuracy: str, threads: int) -> tuple[Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
        """
        Answer (visible, crossed, blocker), uint8 and int32, one entry a query.

        origins and targets are (3n,) float64, JKU; sectors (n,) int32. Raises ValueError naming the row that is
        out of bounds.
        """

    def sees(self, origins: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], sectors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], targets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], target_sectors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], visible: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], threads: int) -> Annotated[NDArray[numpy.uint8], dict(shape=(None,))]:
        """
        Answer whether each target is seen in its sector, uint8, one entry a query.

        target_sectors is (n,) int32, -1 for a target in none; visible the rows of bits of visible_sectors, flat
        uint8, or empty. Raises ValueError naming the row that is out of bounds.
        """

    def locate(self, points: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], accuracy: str, threads: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
        """
        Answer (sector, inside, touching), int32, one entry a point of (3n,) float64, JKU.

        sector is the first that holds the point inside, else the first on whose boundary it lies, else -1;
        inside and touching count the sectors of either kind. Raises ValueError naming the point.
        """

    def explain(self, origin: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], sector: int, target: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[bool, Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
        """
        Answer (visible, sectors, surfaces, leave) of the way that decides one query.

        Entry i is a sector, the surface through which it is left (-1: the segment ends there) and how far along
        the segment, 0 to 1.
        """

    def doubts(self, origins: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], sectors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], targets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[int, int]:
        """
        Count (sectors, queries) that the walk of `balanced` left to the complete search.
        """

    @property
    def memory(self) -> int:
        """Bytes of native memory held."""

class Faller:
    """A level's sectors made ready for falls straight down; immutable."""

    def __init__(self, viewer: Viewer, passes_to: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], under_water: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        Take a viewer's mesh: passes_to (surfaces,) int32, under_water (sectors,) uint8.

        passes_to is the sector that a body falls into through each surface, -1 where it is carried, -2 where it
        is stopped and not carried, -3 for a surface that it does not meet. Raises ValueError naming the index
        that is out of bounds.
        """

    def drop(self, points: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], sectors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], limits: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], accuracy: str, threads: int) -> tuple[Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
        """
        Answer (ending, met, sector, distance), uint8, int32, int32 and float64, one entry a fall: see Landing.

        points are (3n,) float64, JKU; sectors (n,) int32; limits (n,) float64, JKU. Raises ValueError naming the
        row that is out of bounds.
        """

    @property
    def memory(self) -> int:
        """Bytes of native memory held, without the viewer's."""

def sector_closure(viewer: Viewer) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))]]:
    """
    Match each sector's directed edges by exact position.

    Returns (open, surface, corner, length, volume, certain), one entry a sector: see Closure.
    """

def surface_edges(viewer: Viewer) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Find each surface's shortest edge and its triangles without area.

    Returns (corner, length, degenerate), one entry a surface: see Edges.
    """

def sector_overlaps(viewer: Viewer) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
    """
    Find the pairs of sectors that overlap.

    Returns (first, second, depth), sorted, one entry a pair, depth in JKU: see Overlaps.
    """

def visibility(viewer: Viewer, leads_to: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], accuracy: str, threads: int, progress: object | None) -> tuple[Annotated[NDArray[numpy.uint8], dict(shape=(None,))], int, int]:
    """
    Answer (rows, portals, cut_short): which sectors can be seen from which.

    rows is uint8, (n + 7) // 8 bytes a sector, the least bit first. leads_to is (surfaces,) int32, as the viewer
    takes it. progress(done, all) may raise to stop the work. Raises ValueError naming the surface that leads
    to no sector.
    """

def sector_convexity(positions: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_count: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
    """
    Test each sector's vertices against its surfaces, exactly.

    positions is (3n,) float64, JKU; the rest are int32 as in SectorPolygons. Returns (behind, surface, vertex,
    distance), one entry a sector: the number of (surface, vertex) pairs with the vertex strictly behind the
    surface, the worst pair (-1, -1 when convex) and its distance in JKU. Raises ValueError naming the index
    that is out of bounds or the position that is not finite.
    """

def points_outside(positions: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sector_count: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], points: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], sectors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
    """
    Test points against the surfaces of their sectors, exactly.

    positions (3n,) and points (3m,) are float64, JKU; sectors (m,) int32. Returns (surface, distance), one entry
    a point: the surface that it is farthest behind and by how much in JKU, or -1 and 0. Raises ValueError naming
    the index that is out of bounds or the point that is not finite.
    """
