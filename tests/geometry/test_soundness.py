"""Closure, edges and overlaps on levels whose faults are known."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.geometry.soundness import sector_closure, sector_overlaps, surface_edges
from tests.geometry.portal_levels import Level, level_of
from tests.geometry.test_mesh import TWO_ROOMS
from tests.geometry.test_sight_extremes import cut_cells, rotation


def test_cut_cells_are_closed_and_fill_the_box() -> None:
    rng = np.random.default_rng(1)
    for axis in range(3):
        level = level_of(cut_cells(rng, 4 * axis, 1), rng)
        closure = sector_closure(level.mesh())
        assert closure.volume.sum() == pytest.approx(64)
        assert closure.certain.all()
        assert (closure.volume > 0).all()
    closure = sector_closure(TWO_ROOMS.mesh())
    assert closure.open.tolist() == [0, 0]
    assert closure.volume.tolist() == [32, 32]


def test_a_missing_surface_leaves_its_edges_open() -> None:
    mesh = TWO_ROOMS._replace(sector_count=[5, 6]).mesh()
    closure = sector_closure(mesh)
    assert closure.open.tolist() == [4, 0]
    assert closure.length[0] == 4
    assert closure.surface[0] in range(5)


def test_a_surface_wound_the_wrong_way_leaves_its_edges_open() -> None:
    vertices = list(TWO_ROOMS.surface_vertex)
    vertices[:4] = vertices[3::-1]
    assert sector_closure(TWO_ROOMS._replace(surface_vertex=vertices).mesh()).open.tolist() == [8, 0]


def test_a_sector_wound_outward_has_a_negative_volume() -> None:
    turned = [v for i in range(12) for v in TWO_ROOMS.surface_vertex[4 * i : 4 * i + 4][::-1]]
    closure = sector_closure(TWO_ROOMS._replace(surface_vertex=turned).mesh())
    assert closure.open.tolist() == [0, 0]
    assert closure.volume.tolist() == [-32, -32]


def test_edges_without_length_and_triangles_without_area() -> None:
    doubled = [TWO_ROOMS.surface_vertex[0], *TWO_ROOMS.surface_vertex]
    start = [0, *(s + 1 for s in TWO_ROOMS.surface_start[1:])]
    edges = surface_edges(TWO_ROOMS._replace(surface_vertex=doubled, surface_start=start).mesh())
    assert (edges.corner[0], edges.length[0], edges.degenerate[0]) == (0, 0, 1)
    assert edges.degenerate[1:].tolist() == [0] * 11
    assert edges.length[1:].min() == 2


def _shifted(by: list[float], turn: np.ndarray) -> Level:
    one, two = TWO_ROOMS.positions, (TWO_ROOMS.positions - 2) @ turn.T + 2 + by
    count, corners = len(one), TWO_ROOMS.surface_start[-1]
    return Level(
        np.concatenate([one, two]),
        TWO_ROOMS.surface_start + [s + corners for s in TWO_ROOMS.surface_start[1:]],
        TWO_ROOMS.surface_vertex + [v + count for v in TWO_ROOMS.surface_vertex],
        TWO_ROOMS.leads_to * 2,
        TWO_ROOMS.sector_first + [f + 12 for f in TWO_ROOMS.sector_first],
        TWO_ROOMS.sector_count * 2,
    )


@pytest.mark.parametrize("gap", [0.0, 1e-9, 1.0])
def test_neighbours_do_not_overlap(gap: float) -> None:
    assert sector_overlaps(_shifted([0, 0, 4 + gap], np.eye(3)).mesh()).first.tolist() == []


def test_overlaps_are_measured() -> None:
    found = sector_overlaps(_shifted([0, 0, 3.75], np.eye(3)).mesh())
    assert list(zip(found.first.tolist(), found.second.tolist(), strict=True)) == [(0, 2), (1, 3)]
    assert found.depth.tolist() == [0.25, 0.25]


def test_edges_that_cross_part_sectors_that_no_face_does() -> None:
    """A box turned on edge, crosswise above another turned on edge: only the two ridges' cross product parts them."""
    ridge = rotation(0, np.pi / 4, 0)
    across = rotation(0, 0, np.pi / 2) @ ridge
    base = TWO_ROOMS._replace(positions=(TWO_ROOMS.positions - 2) @ ridge.T)
    height = 2 * np.sqrt(2)
    for above, overlaps in ((1e-6, False), (-1e-3, True)):
        upper = (TWO_ROOMS.positions - 2) @ across.T + [0, 0, 2 * height + above]
        level = _shifted([0, 0, 0], np.eye(3))._replace(positions=np.concatenate([base.positions, upper]))
        found = sector_overlaps(level.mesh())
        crosswise = (found.first < 2) & (found.second >= 2)
        assert crosswise.any() == overlaps
        if overlaps:
            assert found.depth[crosswise] == pytest.approx(-above, rel=1e-6)


def test_overlap_keeps_its_measure_far_from_the_origin() -> None:
    level = _shifted([0, 0, 3.75], np.eye(3))
    assert sector_overlaps(level.moved(level.positions + 2.0**20).mesh()).depth.tolist() == [0.25, 0.25]
