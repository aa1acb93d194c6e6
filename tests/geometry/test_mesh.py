"""Sight's rules one by one on small levels, and where points lie."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from jktools.geometry.mesh import BLOCKS, SectorMesh
from jktools.model import Level as RealLevel
from jktools.source import resolve
from jktools.syntax.jkl import read
from tests.geometry.portal_levels import Cells, Level, level_of, queries_of
from tests.geometry.test_sight_extremes import cut_cells

TIERS = ("balanced", "exact", "fast")
CORPUS = Path(__file__).parents[3] / "shared/corpus"


def boxes(*cuts: tuple[int, tuple[int, int, int], float]) -> Level:
    """The box (0, 4)^3 after cuts; sector 0 keeps the part ahead of each cut."""
    cells = Cells()
    for cut in cuts:
        cells.cut(*cut)
    return level_of(cells, np.random.default_rng(0))


TWO_ROOMS = boxes((0, (-1, 0, 0), -2.0))
"""Sector 0 is x < 2, sector 1 is x > 2."""
FOUR_ROOMS = boxes((0, (-1, 0, 0), -2.0), (0, (0, -1, 0), -2.0), (1, (0, -1, 0), -2.0))
"""Sectors 0, 1, 2, 3 in a square around the edge x = y = 2: (low, low), (high, low), (low, high), (high, high)."""


def surface_to(level: Level, sector: int, target: int) -> int:
    first, count = level.sector_first[sector], level.sector_count[sector]
    return next(s for s in range(first, first + count) if level.leads_to[s] == target)


def closed(level: Level, *ways: tuple[int, int]) -> Level:
    leads = list(level.leads_to)
    for sector, target in ways:
        leads[surface_to(level, sector, target)] = BLOCKS
    return level._replace(leads_to=leads)


def ask(level: Level, a: object, sector: int, b: object, tier: str) -> tuple[bool, int, int]:
    found = level.mesh().sight([a], [sector], [b], accuracy=tier)
    return bool(found.visible[0]), int(found.crossed[0]), int(found.blocker[0])


@pytest.mark.parametrize("tier", TIERS)
def test_through_an_adjoin_and_not_through_a_wall(tier: str) -> None:
    assert ask(TWO_ROOMS, [1, 1, 1], 0, [3, 2, 1], tier) == (True, 2, -1)
    wall = surface_to(TWO_ROOMS, 0, 1)
    assert ask(closed(TWO_ROOMS, (0, 1)), [1, 1, 1], 0, [3, 2, 1], tier) == (False, 1, wall)
    assert ask(closed(TWO_ROOMS, (0, 1)), [3, 2, 1], 1, [1, 1, 1], tier) == (True, 2, -1), "closed from one side only"


@pytest.mark.parametrize("tier", TIERS[:2])
def test_ending_on_a_wall_and_sliding_along_it_do_not_block(tier: str) -> None:
    assert ask(TWO_ROOMS, [1, 1, 1], 0, [0, 1, 1], tier) == (True, 1, -1), "ends on a wall"
    assert ask(TWO_ROOMS, [1, 1, 1], 0, [4, 1, 1], tier) == (True, 2, -1), "ends on the far wall"
    assert ask(TWO_ROOMS, [1, 1, 0], 0, [3, 3, 0], tier) == (True, 2, -1), "along the floor"
    assert ask(TWO_ROOMS, [0, 0, 0], 0, [4, 0, 0], tier) == (True, 2, -1), "along an edge"
    assert ask(TWO_ROOMS, [2, 1, 1], 0, [2, 3, 3], tier) == (True, 1, -1), "in the adjoin's plane"
    assert ask(TWO_ROOMS, [0, 1, 1], 0, [-1, 1, 1], tier)[0] is False, "from a wall outward"
    assert ask(TWO_ROOMS, [1, 1, 1], 0, [1, 1, 1], tier) == (True, 1, -1), "of no length"


@pytest.mark.parametrize("tier", TIERS[:2])
def test_an_edge_between_a_wall_and_a_window_blocks(tier: str) -> None:
    through_the_edge = [1, 1, 1], 0, [3, 3, 1]
    assert ask(FOUR_ROOMS, *through_the_edge, tier)[0]
    for closed_way in ((0, 1), (0, 2)):
        level = closed(FOUR_ROOMS, closed_way)
        assert ask(level, *through_the_edge, tier) == (False, 1, surface_to(FOUR_ROOMS, *closed_way))


@pytest.mark.parametrize("tier", TIERS[:2])
def test_an_edge_between_two_windows_is_passed_if_either_way_is_clear(tier: str) -> None:
    """Both ways lead to sector 3; with one of them walled up behind the window, the other still shows it."""
    for walled in ((1, 3), (2, 3)):
        assert ask(closed(FOUR_ROOMS, walled), [1, 1, 1], 0, [3, 3, 1], tier)[0]
    both = closed(FOUR_ROOMS, (1, 3), (2, 3))
    assert not ask(both, [1, 1, 1], 0, [3, 3, 1], tier)[0]


@pytest.mark.parametrize("tier", TIERS[:2])
def test_adjoins_that_lead_in_a_circle_end(tier: str) -> None:
    way = surface_to(TWO_ROOMS, 0, 1)
    leads = list(TWO_ROOMS.leads_to)
    leads[way] = 0
    assert ask(TWO_ROOMS._replace(leads_to=leads), [1, 1, 1], 0, [3, 1, 1], tier) == (True, 2, -1), (
        "entered anew at 1/2"
    )


def test_the_answers_do_not_depend_on_threads() -> None:
    rng = np.random.default_rng(5)
    level = level_of(cut_cells(rng, 12, 4), rng, 0.2, 0.1)
    queries = queries_of(level, rng, 5000)
    mesh = level.mesh()
    one = mesh.sight(*queries, threads=1)
    for threads in (0, 2, 7):
        for column, same in zip(one, mesh.sight(*queries, threads=threads), strict=True):
            assert (column == same).all()


def test_fast_is_nearly_right() -> None:
    rng = np.random.default_rng(6)
    level = level_of(cut_cells(rng, 10, 1 << 20), rng, 0.2)
    sectors = rng.integers(len(level.sector_first), size=4000)
    ends = [np.array([_inside(level, int(s), rng) for s in chosen]) for chosen in (sectors, sectors[::-1])]
    mesh = level.mesh()
    fast = mesh.sight(ends[0], sectors, ends[1], accuracy="fast").visible
    assert (fast != mesh.sight(ends[0], sectors, ends[1]).visible).mean() < 0.02


def test_explain_tells_the_way() -> None:
    explanation = TWO_ROOMS.mesh().explain(0, [1, 1, 1], [3, 1, 1])
    assert explanation.visible and explanation.blocker == -1
    assert [tuple(step) for step in explanation.steps] == [
        (0, surface_to(TWO_ROOMS, 0, 1), 0.5),
        (1, -1, 1.0),
    ]
    blocked = TWO_ROOMS.mesh().explain(0, [1, 1, 1], [9, 1, 1])
    assert not blocked.visible and blocked.steps[-1].leave == 3 / 8


def _inside(level: Level, sector: int, rng: np.random.Generator) -> np.ndarray:
    first = level.sector_first[sector]
    corners = range(level.surface_start[first], level.surface_start[first + level.sector_count[sector]])
    own = level.positions[[level.surface_vertex[c] for c in corners]]
    return rng.dirichlet(np.ones(len(own))) @ own


def _side(corners: np.ndarray, point: np.ndarray) -> Fraction:
    a, b, c, p = ([Fraction(float(x)) for x in v] for v in (*corners[:3], point))
    u, v, w = ([x - y for x, y in zip(q, a, strict=True)] for q in (b, c, p))
    return sum((u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) * w[i] for i in range(3))


def test_locate_equals_half_spaces_in_fractions() -> None:
    """Cuts by planes with small integer coordinates make exactly convex cells: half-spaces are then the truth."""
    rng = np.random.default_rng(8)
    cells = Cells()
    for axis, offset in ((0, 2), (1, 1), (2, 3), (0, 1), (1, 2)):
        for cell in range(len(cells.cells)):
            cells.cut(cell, tuple(-int(axis == k) for k in range(3)), -float(offset))
    level = level_of(cells, rng)
    points = np.concatenate([queries_of(level, rng, 300).targets, rng.uniform(-1, 5, (100, 3))])
    found = level.mesh().location(points)
    for i, point in enumerate(points):
        inside, touching = [], []
        for sector, first in enumerate(level.sector_first):
            surfaces = range(first, first + level.sector_count[sector])
            starts = [level.surface_vertex[level.surface_start[s] : level.surface_start[s + 1]] for s in surfaces]
            least = min(_side(level.positions[corners], point) for corners in starts)
            (inside if least > 0 else touching if least == 0 else []).append(sector)
        expected = ([*inside, *touching, -1][0], len(inside), len(touching))
        assert tuple(int(column[i]) for column in found) == expected


def test_locate_tells_overlaps_shared_faces_and_open_sectors() -> None:
    mesh = TWO_ROOMS.mesh()
    assert [int(x[0]) for x in mesh.location([[2, 1, 1]])] == [0, 0, 2]
    assert mesh.locate([[5, 1, 1], [3, 1, 1]]).tolist() == [-1, 1]
    twice = TWO_ROOMS._replace(
        sector_first=[*TWO_ROOMS.sector_first, TWO_ROOMS.sector_first[1]],
        sector_count=[*TWO_ROOMS.sector_count, TWO_ROOMS.sector_count[1]],
    )
    assert [int(x[0]) for x in twice.mesh().location([[3, 1, 1]])] == [1, 2, 0]
    opened = TWO_ROOMS._replace(sector_count=[TWO_ROOMS.sector_count[0] - 1, TWO_ROOMS.sector_count[1]])
    assert opened.mesh().locate([[1, 1, 1]]).tolist() == [0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"surface_vertex": [99, *TWO_ROOMS.surface_vertex[1:]]}, "surface_vertex 0 is out of bounds: 99"),
        ({"leads_to": [*TWO_ROOMS.leads_to[:-1], 2]}, "leads_to 11 is out of bounds: 2"),
        ({"sector_count": [6, 7]}, "sector_first 1 is out of bounds: 6"),
        ({"positions": TWO_ROOMS.positions + np.inf}, "position 0 is not finite"),
        ({"positions": TWO_ROOMS.positions * 2.0**149}, "has a coordinate of 2\\^150 or more"),
    ],
)
def test_bad_meshes_are_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        TWO_ROOMS._replace(**change).mesh()


def test_bad_queries_are_refused() -> None:
    mesh = TWO_ROOMS.mesh()
    with pytest.raises(ValueError, match="sector of origin 1 is out of bounds: 2"):
        mesh.sight(np.ones((2, 3)), [0, 2], np.ones((2, 3)))
    with pytest.raises(ValueError, match="target 0 is not finite"):
        mesh.sight([[1, 1, 1]], [0], [[np.nan, 1, 1]])
    with pytest.raises(ValueError, match="shape"):
        mesh.sight([[1, 1, 1]], [0, 1], [[1, 1, 1]])
    with pytest.raises(ValueError, match="accuracy"):
        mesh.sight([[1, 1, 1]], [0], [[1, 1, 1]], accuracy="best")  # type: ignore[arg-type]


@pytest.mark.skipif(not CORPUS.exists(), reason="no corpus of real levels here")
def test_things_of_real_levels_lie_in_the_sectors_that_they_name() -> None:
    level = RealLevel(read(resolve(str(CORPUS / "jkl/namek.jkl")).read()))
    table = level.document.things
    mesh = SectorMesh.from_level(level)
    agree = mesh.locate(table.position) == table.sector
    assert agree.mean() > 0.9


def test_locate_in_a_sector_that_is_not_convex() -> None:
    """A prism over an L: what lies on a face is on it, though it lies behind the planes of others."""
    corners = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    n = len(corners)
    positions = [(x, y, z) for z in (0, 1) for x, y in corners]
    walls = [(i, n + i, n + (i + 1) % n, (i + 1) % n) for i in range(n)]
    surfaces = [tuple(range(n)), tuple(range(2 * n - 1, n - 1, -1)), *walls]
    start = np.cumsum([0, *map(len, surfaces)])
    mesh = SectorMesh.from_arrays(
        positions, start, np.concatenate(surfaces), [BLOCKS] * len(surfaces), [0], [len(surfaces)]
    )
    faces = [(1.5, 1, 0.5), (1.5, 0.5, 0), (1, 1.5, 0.25), (0.5, 1.75, 1), (1, 1, 0.5), (2, 1, 1)]
    found = mesh.location([*faces, (0.5, 1.5, 0.5), (1.5, 0.5, 0.5), (1.5, 1.5, 0.5), (1.5, 1.5, 0)])
    assert found.sector.tolist() == [0] * len(faces) + [0, 0, -1, -1]
    assert found.touching.tolist() == [1] * len(faces) + [0] * 4
    assert found.inside.tolist() == [0] * len(faces) + [1, 1, 0, 0]
