"""Where points lie, at each tier."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from jktools.geometry import SectorMesh
from jktools.geometry.mesh import BLOCKS
from jktools.session import load
from jktools.tradeoff.passes import KINDS
from tests.geometry.portal_levels import Cells, level_of, queries_of
from tests.support.levels import CORPUS

PLAN = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
"""An L seen from above, counter-clockwise."""


def angled_room(scale: float = 1.0) -> SectorMesh:
    """One closed sector over PLAN, one JKU high: its planes run on through its inside."""
    count = len(PLAN)
    positions = np.array([(*place, z) for z in (0, 1) for place in PLAN], np.float64) * scale
    floor, ceiling = list(range(count)), [count, *range(2 * count - 1, count, -1)]
    walls = [[(i + 1) % count, i, i + count, (i + 1) % count + count] for i in range(count)]
    surfaces = [floor, ceiling, *walls]
    start = np.cumsum([0, *map(len, surfaces)])
    return SectorMesh.from_arrays(
        positions, start, np.concatenate(surfaces), [BLOCKS] * len(surfaces), [0], [len(surfaces)]
    )


def holds(x: float, y: float, z: float) -> tuple[int, int, int]:
    """Sector, inside and touching of a point and the angled room."""
    closed = 0 <= z <= 1 and ((0 <= x <= 2 and 0 <= y <= 1) or (0 <= x <= 1 and 0 <= y <= 2))
    inside = 0 < z < 1 and ((0 < x < 2 and 0 < y < 1) or (0 < x < 1 and 0 < y < 2))
    return 0 if closed else -1, int(inside), int(closed and not inside)


@pytest.mark.parametrize("scale", [1.0, 2.0**140, 2.0**-1000, 2.0**-1072])
@pytest.mark.parametrize("tier", ["balanced", "exact"])
def test_points_in_on_and_around_a_room_with_a_notch(tier: str, scale: float) -> None:
    axis, heights = np.arange(-1, 10) / 4, (-0.25, 0.0, 0.25, 0.5, 1.0, 1.25)
    points = list(itertools.product(axis.tolist(), axis.tolist(), heights))
    found = angled_room(scale).location(np.array(points) * scale, accuracy=tier)  # type: ignore[arg-type]
    wrong = [p for p, *row in zip(points, *(c.tolist() for c in found), strict=True) if tuple(row) != holds(*p)]
    assert wrong == []


def test_fast_is_right_off_the_faces() -> None:
    """Also straight below and above edges and corners."""
    axis = [-0.3, 0.25, 0.5, 1.0, 1.3, 2.6]
    points = [p for p in itertools.product(axis, axis, (-0.25, 0.5, 1.25)) if holds(*p)[2] == 0]
    assert any(holds(*p)[1] and 1.0 in p[:2] for p in points)
    found = angled_room().location(points, accuracy="fast")
    assert found.sector.tolist() == [holds(*p)[0] for p in points]


def test_fast_knows_a_floor_of_triangles_that_it_stands_on() -> None:
    assert [int(c[0]) for c in angled_room().location([[0.5, 0.75, 0.0]], accuracy="fast")] == [0, 0, 1]


@pytest.mark.parametrize("scale", [1.0, 2.0**-1060])
def test_balanced_is_exact_on_cut_cells(scale: float) -> None:
    """At and beside vertices, edges and faces of random convex cells, also where products underflow."""
    rng = np.random.default_rng(11)
    cells = Cells()
    for _ in range(12):
        cells.cut(int(rng.integers(len(cells.cells))), tuple(rng.normal(size=3).tolist()), float(rng.normal()))
    level = level_of(cells, rng)
    points = queries_of(level, rng, 500).targets * scale
    mesh = level.moved(level.positions * scale).mesh()
    balanced, exact = mesh.location(points), mesh.location(points, accuracy="exact")
    assert exact.touching.any()
    assert exact.inside.any()
    for one, other in zip(balanced, exact, strict=True):
        assert one.tolist() == other.tolist()


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize("name", ["gob/canyon_camera.gob", "jkl/hell.jkl"])
def test_balanced_is_exact_on_real_levels(name: str) -> None:
    """Both levels have sectors that are not convex; things stand on their floors."""
    level = load(str(CORPUS / name))
    mesh, rng = SectorMesh.from_level(level), np.random.default_rng(1997)
    for kind, make in KINDS.items():
        points = make(level, 500, rng).targets
        balanced, exact = mesh.location(points), mesh.location(points, accuracy="exact")
        for one, other in zip(balanced, exact, strict=True):
            assert one.tolist() == other.tolist(), kind


def test_what_cannot_be_asked_is_refused() -> None:
    with pytest.raises(ValueError, match="accuracy"):
        angled_room().locate([[1, 1, 1]], accuracy="best")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="point 1 is not finite"):
        angled_room().locate([[1, 1, 1], [np.nan, 0, 0]], accuracy="exact")
