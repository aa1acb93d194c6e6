"""The floors that simulations stand on: sweeps against a dense march of the sphere."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.engine.ground import SURFACES, UP, Steps, Tread

R = 0.065
PIT = Steps.pit(0.2, 1.0)


def clearance(ground: Steps, y: float, z: float) -> float:
    """Distance from a point to the solid below the treads, negative inside."""
    if z < ground.tread_at(y).height:
        return -1.0
    gaps = []
    for i, tread in enumerate(ground.treads):
        low = tread.start if i else -math.inf
        high = ground.treads[i + 1].start if i + 1 < len(ground.treads) else math.inf
        beside = max(low - y, y - high, 0.0)
        gaps.append(math.hypot(beside, max(0.0, z - tread.height)))
    return min(gaps)


@settings(deadline=None)
@given(st.floats(-0.5, 1.5), st.floats(-0.13, 0.4), st.floats(-0.6, 0.6), st.floats(-0.6, 0.6))
def test_sweep_stops_where_a_fine_march_does(y: float, z: float, dy: float, dz: float) -> None:
    size = math.hypot(dy, dz)
    if clearance(PIT, y, z) <= R + 1e-6 or size < 1e-3:
        return
    contact = PIT.sweep((0.0, y, z), (0.0, dy, dz), R)
    free = [clearance(PIT, y + t * dy, z + t * dz) > R - 1e-6 for t in np.linspace(0.0, 1.0, 601)]
    marched = size * (free.index(False) / 600 if False in free else math.inf)
    swept = contact.distance if contact else math.inf
    # The march takes a graze shallower than its slack for a miss: what it does hit must be found in time.
    assert swept <= marched + 1e-9
    if contact:
        touch = clearance(PIT, y + swept / size * dy, z + swept / size * dz)
        assert touch == pytest.approx(R, abs=1e-7)
        assert np.dot(contact.normal, (0.0, dy, dz)) < 0


def test_falls_on_a_floor() -> None:
    contact = PIT.sweep((3.0, -0.5, 0.5), (0.0, 0.0, -1.0), R)
    assert contact and contact.normal == UP and contact.distance == pytest.approx(0.5 - R)
    assert contact.floor and contact.floor.point == (3.0, -0.5, 0.0)


def test_walks_into_a_wall() -> None:
    contact = PIT.sweep((0.0, 0.5, -0.13), (0.0, 1.0, 0.0), R)
    assert contact and contact.normal == (0.0, -1.0, 0.0) and contact.floor is None
    assert contact.distance == pytest.approx(0.5 - R)


def test_rolls_off_an_edge() -> None:
    contact = PIT.sweep((0.0, 0.03, 0.5), (0.0, 0.0, -1.0), R)
    assert contact and contact.distance == pytest.approx(0.5 - math.sqrt(R * R - 0.03**2))
    assert contact.normal[1] == pytest.approx(0.03 / R)


def test_floor_below_by_ray_and_by_sphere() -> None:
    def below(y: float, reach: float, radius: float, required: int = SURFACES["floor"]) -> float | None:
        floor = PIT.floor_below((0.0, y, 0.12), reach, radius, required)
        return None if floor is None else floor.point[2]

    assert below(-0.01, 0.24, 0.0) == 0.0
    assert below(0.0, 0.24, 0.0) == 0.0  # on an edge, the higher floor
    assert below(0.01, 0.24, 0.0) is None
    assert below(0.01, 0.33, 0.0) == -0.2
    assert below(0.06, 0.24, R) == 0.0  # the sphere still hangs on the edge
    assert below(0.07, 0.24, R) is None  # 0.32 - 0.065 is farther than 0.24
    assert below(0.07, 0.26, R) == -0.2
    assert below(0.01, 9.0, 0.0, SURFACES["icy"]) is None


def test_surface_without_collision_lets_through() -> None:
    assert Steps.flat(0).sweep((0.0, 0.0, 1.0), (0.0, 0.0, -2.0), R) is None


def test_treads_come_in_order() -> None:
    with pytest.raises(ValueError, match="one after another"):
        Steps((Tread(1.0, 0.0), Tread(0.0, 0.0)))
