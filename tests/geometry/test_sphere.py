"""A sphere against a triangle: where it stops, by the distance to its nearest point."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from jktools.engine.ground import Vector
from jktools.geometry.sphere import Path, Touch, above, polygon, touches

R = 0.25
SQUARE = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0))

coordinate = st.integers(-64, 64).map(lambda n: n / 32)
points = st.tuples(coordinate, coordinate, coordinate)


def path(start: Vector, end: Vector) -> Path:
    way = np.subtract(end, start)
    size = float(np.linalg.norm(way))
    x, y, z = (way / size).tolist()
    return Path(start, (x, y, z), size, R)


def first(corners: tuple[Vector, ...], way: Path) -> Touch | None:
    face = polygon(0, 0, corners)
    assert face is not None
    return min(touches(face, way), key=lambda touch: touch.distance, default=None)


def distances(corners: tuple[Vector, ...], places: np.ndarray) -> np.ndarray:
    """Distance of each place from the triangle: the least over its sides, and over its face by weights of corners."""
    a, b, c = np.array(corners)
    found = [_to_segment(places, p, q) for p, q in ((a, b), (b, c), (c, a))]
    weights = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), (places - a).T, rcond=None)[0]
    over = (weights >= 0).all(axis=0) & (weights.sum(axis=0) <= 1)
    height = np.linalg.norm(a + weights.T @ np.stack([b - a, c - a]) - places, axis=1)
    return np.min([*found, np.where(over, height, np.inf)], axis=0)


def _to_segment(places: np.ndarray, p: np.ndarray, q: np.ndarray) -> np.ndarray:
    part = np.clip((places - p) @ (q - p) / ((q - p) @ (q - p)), 0, 1)
    return np.asarray(np.linalg.norm(p + part[:, None] * (q - p) - places, axis=1))


@settings(deadline=None, max_examples=400)
@given(st.tuples(points, points, points), points, points)
def test_stops_at_its_radius_and_not_before(corners: tuple[Vector, ...], start: Vector, end: Vector) -> None:
    area = np.linalg.norm(np.cross(np.subtract(corners[1], corners[0]), np.subtract(corners[2], corners[0])))
    assume(area > 0.01 and start != end)
    face, way = polygon(0, 0, corners), path(start, end)
    assert face is not None
    assume(above(face, start) > 0 and distances(corners, np.array([start]))[0] > R + 1e-6)
    touch = first(corners, way)
    places = np.array([way.at(float(t)) for t in np.linspace(0, touch.distance if touch else way.length, 200)])
    # From behind a polygon is not met: its sector ends there.
    ahead = np.logical_and.accumulate([above(face, (x, y, z)) > 0 for x, y, z in places.tolist()])
    assert (distances(corners, places[ahead]) >= R - 1e-7).all()
    if touch:
        assert distances(corners, places[-1:])[0] == pytest.approx(R, abs=1e-7)
        assert np.dot(touch.normal, way.way) < 0 and np.linalg.norm(touch.normal) == pytest.approx(1)


@pytest.mark.parametrize(
    ("start", "end", "distance", "normal"),
    [
        ((0.5, 0.5, 1.0), (0.5, 0.5, 0.0), 0.75, (0, 0, 1)),  # the face
        ((1.15, 0.5, 1.0), (1.15, 0.5, 0.0), 0.8, (0.6, 0, 0.8)),  # a side: 0.15 beside it, 0.2 above
        ((1.15, 1.0, 1.0), (1.15, 1.0, 0.0), 0.8, (0.6, 0, 0.8)),  # a corner
        ((0.5, 0.5, 0.125), (0.5, 0.5, 0.0), 0.0, (0, 0, 1)),  # in it already: no deeper
    ],
)
def test_touches_by_hand(start: Vector, end: Vector, distance: float, normal: Vector) -> None:
    touch = first(SQUARE, path(start, end))
    assert touch and touch.distance == pytest.approx(distance) and touch.normal == pytest.approx(normal)


@pytest.mark.parametrize(
    ("start", "end"),
    [
        ((0.5, 0.5, -1.0), (0.5, 0.5, 1.0)),  # from behind
        ((0.5, 0.5, 1.0), (0.5, 0.5, 0.26)),  # not that far
        ((0.5, 0.5, 0.25), (0.9, 0.5, 0.25)),  # along it, touching
        ((0.5, 0.5, 0.125), (0.5, 0.5, 1.0)),  # out of it
        ((1.26, 0.5, 1.0), (1.26, 0.5, -1.0)),  # past its side
    ],
)
def test_what_is_no_touch(start: Vector, end: Vector) -> None:
    assert first(SQUARE, path(start, end)) is None


def test_a_polygon_without_area_is_none() -> None:
    assert polygon(0, 0, ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (2.0, 2.0, 2.0))) is None


def test_turned_motion_is_free() -> None:
    """A motion along a slanted plane goes into it by rounding only: it must not stop there."""
    slanted = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.3), (1.0, 1.0, 1.0), (0.0, 1.0, 0.7))
    face = polygon(0, 0, slanted)
    assert face is not None
    normal, middle = np.array(face.normal), np.array(face.point)
    for turn in np.linspace(0, math.tau, 50):
        way = np.array([math.cos(turn), math.sin(turn), 0.1])
        along = way - normal * (normal @ way)
        start, end = (middle + normal * R).tolist(), (middle + normal * R + along / 8).tolist()
        assert first(slanted, path(tuple(start), tuple(end))) is None
