"""Drop's rules one by one on small levels."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from jktools.geometry import ABSENT, CARRIES, STOPS, Drop, Ending, SectorMesh
from jktools.geometry.drop import ground_of
from tests.geometry.portal_levels import Level
from tests.geometry.test_mesh import boxes, surface_to
from tests.support.levels import level_of, two_rooms

TIERS = ("balanced", "exact", "fast")
STACK = boxes((0, (0, 0, 1), 2.0))
"""Sector 0 is z > 2, sector 1 is z < 2."""
STEP = boxes((0, (0, 0, 1), 2.0), (1, (1, 0, 0), 2.0), (1, (0, 0, 1), 1.0))
"""Sector 0 is z > 2; below it the side x > 2 is cut once more, at z = 1."""


def floor_of(level: Level, sector: int) -> int:
    """The lowest surface of a sector that leads nowhere and faces up."""
    first, count = level.sector_first[sector], level.sector_count[sector]

    def height(s: int) -> tuple[float, float]:
        z = level.positions[level.surface_vertex[level.surface_start[s] : level.surface_start[s + 1]], 2]
        return z.max() - z.min(), z.max()

    return min(range(first, first + count), key=height)


def drop(level: Level, point: list[float], sector: int, tier: str, limit: float = np.inf, **ground: object) -> tuple:
    mesh = SectorMesh.from_arrays(*level, **ground)
    return row(mesh.drop([point], [sector], limit, accuracy=tier))


def row(found: Drop) -> tuple:
    return int(found.surface[0]), float(found.distance[0]), Ending(found.ending[0]), int(found.sector[0])


@pytest.mark.parametrize("tier", TIERS)
def test_through_an_adjoin_onto_the_floor(tier: str) -> None:
    floor = floor_of(STACK, 1)
    assert drop(STACK, [1, 1, 3], 0, tier) == (floor, 3.0, Ending.FLOOR, 1)
    assert drop(STACK, [1, 1, 0], 1, tier) == (floor, 0.0, Ending.FLOOR, 1), "on the floor itself"
    assert drop(STACK, [1, 1, -0.5], 1, tier) == (-1, np.inf, Ending.NOTHING, 1), "below it"
    for point in ([0, 1, 3], [0, 0, 3], [4, 4, 4], [2, 2, 2]):
        assert drop(STACK, point, 0, tier)[:2] == (floor, point[2]), (
            "down a wall, an edge, from a ceiling, on the adjoin"
        )


@pytest.mark.parametrize("tier", TIERS)
def test_the_greatest_distance(tier: str) -> None:
    floor = floor_of(STACK, 1)
    assert drop(STACK, [1, 1, 3], 0, tier, 3.0) == (floor, 3.0, Ending.FLOOR, 1), "as far as asked"
    assert drop(STACK, [1, 1, 3], 0, tier, 2.5) == (-1, 2.5, Ending.FAR, 1)
    assert drop(STACK, [1, 1, 3], 0, tier, 0.5) == (-1, 0.5, Ending.FAR, 0)
    assert drop(STACK, [1, 1, 0], 1, tier, 0.0) == (floor, 0.0, Ending.FLOOR, 1)


@pytest.mark.parametrize("tier", TIERS)
def test_what_ends_a_fall(tier: str) -> None:
    hole, floor = surface_to(STACK, 0, 1), floor_of(STACK, 1)
    passes = np.where(np.array(STACK.leads_to) < 0, CARRIES, STACK.leads_to)

    def with_(surface: int, kind: int) -> list[int]:
        return [kind if s == surface else int(p) for s, p in enumerate(passes)]

    assert drop(STACK, [1, 1, 3], 0, tier, passes_to=with_(hole, CARRIES)) == (hole, 1.0, Ending.FLOOR, 0)
    assert drop(STACK, [1, 1, 3], 0, tier, passes_to=with_(hole, STOPS)) == (-1, 1.0, Ending.SOLID, 0)
    assert drop(STACK, [1, 1, 3], 0, tier, passes_to=with_(floor, STOPS)) == (-1, 3.0, Ending.SOLID, 1)
    assert drop(STACK, [1, 1, 3], 0, tier, passes_to=with_(floor, ABSENT)) == (-1, np.inf, Ending.NOTHING, 1)
    assert drop(STACK, [1, 1, 3], 0, tier, under_water=[False, True]) == (-1, 1.0, Ending.WATER, 1)
    assert drop(STACK, [1, 1, 1], 1, tier, under_water=[False, True]) == (-1, 0.0, Ending.WATER, 1)


@pytest.mark.parametrize("tier", TIERS[:2])
def test_where_ways_part_the_nearest_ending_counts(tier: str) -> None:
    """Above the edge of a step, x = 2: the floor of x > 2 is at z = 1, that of x < 2 at z = 0."""
    heights = {}
    for x in (1.0, 3.0, 2.0):
        surface, heights[x], ending, _ = drop(STEP, [x, 1, 3], 0, tier, passes_to=_step())
        assert ending is Ending.FLOOR
        assert surface >= 0
    assert heights == {1.0: 3.0, 3.0: 2.0, 2.0: 2.0}


def _step() -> list[int]:
    """Every way passes but the one from z > 1 to z < 1 on the side x > 2."""
    passes = []
    for s, leads in enumerate(STEP.leads_to):
        corners = STEP.positions[STEP.surface_vertex[STEP.surface_start[s] : STEP.surface_start[s + 1]]]
        ledge = bool((corners[:, 2] == 1).all()) and bool((corners[:, 0] >= 2).all())
        passes.append(CARRIES if leads < 0 or ledge else leads)
    return passes


@pytest.mark.parametrize("tier", TIERS[:2])
def test_the_distance_is_the_nearest_double(tier: str) -> None:
    """A floor through (0, 0, 0), (3, 0, 1), (0, 7, 0.1): against rational arithmetic."""
    rng = np.random.default_rng(3)
    corners = np.array([[0, 0, 0], [3, 0, 1], [0, 7, 0.1]])
    mesh = SectorMesh.from_arrays(corners, [0, 3], [0, 1, 2], [-1], [0], [1])
    points = rng.dirichlet([1, 1, 1], 300) @ corners + [0, 0, 1e-5] + rng.random((300, 1)) ** 9 * [0, 0, 5]
    points[::3] = points[::3].astype(np.float32)
    found = mesh.drop(points, np.zeros(300, np.int32), accuracy=tier)
    a, b, c = (tuple(map(Fraction, corner)) for corner in corners.tolist())
    u, v = ([q - p for p, q in zip(a, corner, strict=True)] for corner in (b, c))
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    exact = [sum(n * Fraction(x) for n, x in zip(normal, p, strict=True)) / normal[2] for p in points.tolist()]
    assert found.ending.tolist() == [Ending.FLOOR] * 300
    assert found.distance.tolist() == [float(depth) for depth in exact]  # Fraction rounds to nearest, ties to even


@pytest.mark.parametrize("tier", TIERS)
def test_bad_arguments_are_refused(tier: str) -> None:
    mesh = STACK.mesh()
    with pytest.raises(ValueError, match="max_distance 1 is negative or not a number"):
        mesh.drop([[1, 1, 3]] * 2, [0, 0], [1.0, -1.0], accuracy=tier)
    with pytest.raises(ValueError, match="sector of point 0 is out of bounds: 9"):
        mesh.drop([[1, 1, 3]], [9], accuracy=tier)
    with pytest.raises(ValueError, match="point 0 is not finite"):
        mesh.drop([[1, 1, np.nan]], [0], accuracy=tier)
    with pytest.raises(ValueError, match="passes_to 0 is out of bounds: 7"):
        SectorMesh.from_arrays(*STACK, passes_to=[7] * len(STACK.leads_to))


def test_no_points_and_many_threads() -> None:
    mesh = STACK.mesh()
    assert mesh.drop(np.zeros((0, 3)), []).surface.shape == (0,)
    rng = np.random.default_rng(2)
    points = rng.uniform(0, 4, (5000, 3))
    sectors = mesh.locate(points)
    one, many = mesh.drop(points, sectors, threads=1), mesh.drop(points, sectors, threads=7)
    for a, b in zip(one, many, strict=True):
        np.testing.assert_array_equal(a, b)


def test_what_a_level_says() -> None:
    """What surface 0, which has no adjoin, does by its flags."""
    for flags, kind in ((0x5, CARRIES), (0x1, ABSENT), (0x4, STOPS), (0x0, ABSENT)):
        level = level_of(two_rooms("World surfaces 12", f"0: 0 {flags:#x} 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1"))
        assert ground_of(level).passes_to[0] == kind, flags


def test_adjoins_of_a_level() -> None:
    level = level_of(two_rooms())
    carriers = np.flatnonzero(level.document.surfaces.adjoin >= 0)
    assert len(carriers)
    before = ground_of(level).passes_to[carriers]
    assert (before >= 0).all()
    level.document.adjoins.flags[:] = 0x5
    level.document.surfaces.flags[carriers] = 0x0
    assert (ground_of(level).passes_to[carriers] == STOPS).all()
    level.document.surfaces.flags[carriers] = 0x1
    assert (ground_of(level).passes_to[carriers] == CARRIES).all()


def test_a_sector_that_could_not_be_read_is_unknown() -> None:
    level = level_of(two_rooms())
    level.sound_sectors[:] = False
    found = SectorMesh.from_level(level).drop([[1.0, 1.0, 1.0]], [0])
    assert (row(found)[0], row(found)[2]) == (-1, Ending.UNKNOWN)
    assert np.isnan(found.distance[0])
