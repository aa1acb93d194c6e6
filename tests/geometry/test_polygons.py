"""What is measured of polygons, on solids whose shape is known by construction."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.geometry import adjoin_alignment, corners_of, normal_fit, open_edges, sector_extent, vertices_behind
from jktools.geometry.corners import batches
from jktools.model import Level
from tests.support.levels import level_of

Point = npt.NDArray[np.float64]
Polygon = list[Point]

CUBE = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)], np.float64)
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Of the cube, counter-clockwise seen from inside."""


def level_with(sectors: Sequence[Sequence[Polygon]], adjoined: Sequence[tuple[int, int]] = ()) -> Level:
    """A level of nothing but geometry; every corner is a vertex of its own, so that only positions can join them."""
    polygons = [polygon for sector in sectors for polygon in sector]
    adjoin = {surface: i for i, surface in enumerate(s for pair in adjoined for s in pair)}
    vertices, surfaces, normals = [], [], []
    for i, polygon in enumerate(polygons):
        first = len(vertices)
        vertices += [f"{first + k}: {' '.join(map(repr, point.tolist()))}" for k, point in enumerate(polygon)]
        pairs = " ".join(f"{first + k},-1" for k in range(len(polygon)))
        light = " ".join("1" for _ in polygon)
        surfaces.append(f"{i}: -1 0x4 0x4 4 3 1 {adjoin.get(i, -1)} 0 {len(polygon)} {pairs} {light}")
        normals.append(f"{i}: 0 0 1")
    lines = [
        "section: georesource", "world colormaps 1", "0: a.cmp", f"world vertices {len(vertices)}", *vertices,
        "world texture vertices 0", f"world adjoins {len(adjoin)}",
        *(f"{i}: 0x7 {i ^ 1} 1" for i in range(len(adjoin))),
        f"world surfaces {len(surfaces)}", *surfaces, *normals, "section: sectors", f"world sectors {len(sectors)}",
    ]  # fmt: skip
    first_surface, first_vertex = 0, 0
    for i, sector in enumerate(sectors):
        count = sum(map(len, sector))
        lines += [
            f"sector {i}", "flags 0", "ambient light 0", "extra light 0", "colormap 0", "boundbox 0 0 0 1 1 1",
            "center 0 0 0", "radius 1", f"vertices {count}", *(f"{k}: {first_vertex + k}" for k in range(count)),
            f"surfaces {first_surface} {len(sector)}",
        ]  # fmt: skip
        first_surface, first_vertex = first_surface + len(sector), first_vertex + count
    level = level_of("\n".join(lines))
    assert level.sound_sectors.all()
    return level


def cube() -> list[Polygon]:
    return [[CUBE[i] for i in face] for face in FACES]


@st.composite
def placements(draw: st.DrawFn) -> tuple[Point, Point]:
    """A rotation and a shift of up to 500 JKU, where float32 steps are 3e-5 JKU."""
    axes = np.array(draw(st.lists(st.floats(-1, 1), min_size=9, max_size=9))).reshape(3, 3) + 3 * np.eye(3)
    rotation, _ = np.linalg.qr(axes)
    if np.linalg.det(rotation) < 0:
        rotation[:, 0] *= -1
    return rotation, np.array(draw(st.lists(st.floats(-500, 500), min_size=3, max_size=3)))


def moved(polygons: Sequence[Polygon], placement: tuple[Point, Point]) -> list[Polygon]:
    rotation, shift = placement
    return [[rotation @ point + shift for point in polygon] for polygon in polygons]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 3), st.floats(0.1, 0.9)), max_size=8), placements())
def test_a_solid_with_extra_vertices_within_its_edges_is_closed(
    extras: list[tuple[int, int, float]], placement: tuple[Point, Point]
) -> None:
    polygons = cube()
    for face, corner, share in extras:
        polygon = polygons[face]
        following = polygon[(corner + 1) % len(polygon)]
        polygon.insert(corner + 1, polygon[corner] + share * (following - polygon[corner]))
    level = level_with([moved(polygons, placement)])
    found = open_edges(level, corners_of(level), 1e-3)
    assert found.length[0] <= 1e-3
    assert found.edges[0] == 0


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 5), placements())
def test_a_solid_without_one_face_is_open_along_its_four_edges(face: int, placement: tuple[Point, Point]) -> None:
    polygons = cube()
    del polygons[face]
    level = level_with([moved(polygons, placement)])
    found = open_edges(level, corners_of(level), 1e-3)
    assert found.length[0] == pytest.approx(1, abs=2e-4)
    assert found.edges[0] == 4


def test_part_of_an_edge_is_open_where_a_face_falls_short() -> None:
    polygons = cube()
    polygons[0] = [np.array(p, np.float64) for p in ((0, 0, 0), (0.75, 0, 0), (0.75, 1, 0), (0, 1, 0))]
    level = level_with([polygons])
    found = open_edges(level, corners_of(level), 1e-3)
    # The short face's own side at 0.75 and the wall's edge at 1 are open whole, two edges over the last quarter.
    assert found.length[0] == pytest.approx(1)
    assert found.edges[0] == 4


@settings(max_examples=40, deadline=None)
@given(placements(), st.floats(0, 0.2), st.floats(0.1, 0.9))
def test_adjoined_squares_lie_as_far_apart_as_they_were_shifted(
    placement: tuple[Point, Point], apart: float, share: float
) -> None:
    here = [CUBE[i] for i in FACES[0]]
    there = [point + np.array([0, 0, apart]) for point in reversed(here)]
    there.insert(1, there[0] + share * (there[1] - there[0]))  # an extra vertex within an edge does not count
    level = level_with([moved([here], placement), moved([there], placement)], [(0, 1)])
    (distance,) = adjoin_alignment(level, corners_of(level)).distance
    assert distance == pytest.approx(apart, abs=2e-4)
    (facing,) = adjoin_alignment(level, corners_of(level)).facing
    assert facing == pytest.approx(-1, abs=1e-3)


def test_the_fit_of_a_normal_is_measured_in_degrees_and_in_jku() -> None:
    # Written is 0 0 1: right for the floor, opposite for the ceiling, a right angle for the walls.
    level = level_with([cube()])
    fit = normal_fit(level, corners_of(level))
    assert fit.length.tolist() == [1] * 6
    assert fit.angle.tolist() == pytest.approx([0, 180, 90, 90, 90, 90])
    assert fit.distance.tolist() == pytest.approx([0, 0, 1, 1, 1, 1])


def test_an_extent_is_that_of_the_vertices() -> None:
    extent = sector_extent(level_with([cube()]))
    assert extent.box.tolist() == [0]
    assert extent.radius.tolist() == pytest.approx([3**0.5])


def test_nothing_is_measured_of_no_level() -> None:
    level = level_of("section: jk")
    corners = corners_of(level)
    assert len(open_edges(level, corners, 1e-3).length) == 0
    assert len(adjoin_alignment(level, corners).distance) == 0
    assert len(normal_fit(level, corners).angle) == 0
    assert len(sector_extent(level).box) == 0


@given(st.lists(st.integers(0, 9), max_size=20), st.integers(1, 12))
def test_batches_hold_everything_once_and_no_more_than_they_may(sizes: list[int], most: int) -> None:
    cut = list(batches(np.array(sizes, np.intp), most))
    assert [i for b in cut for i in range(b.start, b.stop)] == list(range(len(sizes)))
    assert all(sum(sizes[b]) <= most or b.stop - b.start == 1 for b in cut)


def test_batches_change_no_measure(monkeypatch: pytest.MonkeyPatch) -> None:
    # The floor of the first cube, whose written normal is right, is raised: the corners of the walls lie behind it.
    polygons = cube()
    polygons[0] = [point + np.array([0, 0, 0.3]) for point in polygons[0]]
    level = level_with([polygons, moved(cube(), (np.eye(3), np.array([0, 0, -1.0])))], [(0, 7)])
    corners = corners_of(level)
    whole = vertices_behind(level, corners, 1e-3), adjoin_alignment(level, corners)
    assert len(whole[0].vertex)
    monkeypatch.setattr("jktools.geometry.corners.batches.__defaults__", (5,))
    parts = vertices_behind(level, corners, 1e-3), adjoin_alignment(level, corners)
    for before, after in zip(whole, parts, strict=True):
        assert all((a == b).all() for a, b in zip(before, after, strict=True))
