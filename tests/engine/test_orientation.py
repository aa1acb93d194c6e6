"""Pitch, yaw and roll against vectors worked by hand, and back."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine import orientation
from jktools.engine.orientation import angles, matrix
from tests.engine.motion_checks import exactly

HALF = np.sqrt(0.5)


@pytest.mark.parametrize(
    ("pyr", "right", "look", "up"),
    [
        ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, 90, 0), (0, 1, 0), (-1, 0, 0), (0, 0, 1)),  # yaw turns left
        ((90, 0, 0), (1, 0, 0), (0, 0, 1), (0, -1, 0)),  # pitch lifts the nose
        ((0, 0, 90), (0, 0, -1), (0, 1, 0), (1, 0, 0)),  # roll drops the right wing
        ((45, 90, 0), (0, 1, 0), (-HALF, 0, HALF), (HALF, 0, HALF)),
        ((0, 45, 90), (0, 0, -1), (-HALF, HALF, 0), (HALF, HALF, 0)),
    ],
)
def test_known_attitudes(pyr: tuple[float, ...], right: object, look: object, up: object) -> None:
    assert pytest.approx(np.array([right, look, up]), abs=1e-15) == matrix(pyr).T


def test_is_the_product_of_three_turns() -> None:
    p, y, r = np.deg2rad([20.0, 50.0, -70.0])
    turn_z = np.array([[np.cos(y), -np.sin(y), 0], [np.sin(y), np.cos(y), 0], [0, 0, 1]])
    turn_x = np.array([[1, 0, 0], [0, np.cos(p), -np.sin(p)], [0, np.sin(p), np.cos(p)]])
    turn_y = np.array([[np.cos(r), 0, np.sin(r)], [0, 1, 0], [-np.sin(r), 0, np.cos(r)]])
    assert matrix((20, 50, -70)) == pytest.approx(turn_z @ turn_x @ turn_y, abs=1e-15)


def test_quarter_turns_are_exact() -> None:
    turns = np.array(np.meshgrid(*[[-270, -90, 0, 90, 180, 360000090]] * 3)).reshape(3, -1).T
    assert set(np.unique(np.abs(matrix(turns)))) == {0.0, 1.0}


def test_round_trip_in_angles() -> None:
    some = np.random.default_rng(8).uniform((-89.9, -180, -180), (89.9, 180, 180), (2000, 3))
    assert angles(matrix(some)) == pytest.approx(some, abs=1e-10)


@pytest.mark.parametrize("pitch", [90.0, -90.0])
def test_gimbal_lock(pitch: float) -> None:
    """Straight up or down only yaw + roll (up) or yaw - roll (down) shows: roll comes back 0."""
    for yaw, roll in ((0, 0), (30, 0), (30, 50), (-170, 100)):
        look = matrix((pitch, yaw, roll))
        read = angles(look)
        assert (read[0], read[2]) == (pitch, 0.0)
        assert matrix(read) == pytest.approx(look, abs=1e-15)
        whole = yaw + roll * np.sign(pitch)
        assert (read[1] - whole + 180) % 360 - 180 == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("off", [1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-12])
def test_near_gimbal_lock(off: float) -> None:
    look = matrix((90 - off, 30, 50))
    assert matrix(angles(look)) == pytest.approx(look, abs=2e-8)


def test_order_of_creation_matters() -> None:
    ghost = matrix((0, 45, 0))
    made = orientation.created(orientation.Creation.CREATE_THING, (30, 0, 0), spawner=ghost)
    assert made == pytest.approx(matrix((30, 45, 0)), abs=1e-15)
    assert not np.allclose(made, matrix((30, 0, 0)) @ ghost)


def test_created_velocity() -> None:
    left = matrix((0, 90, 0))
    assert orientation.created_velocity((0, 3, 0), left) == exactly([-3, 0, 0])
    assert orientation.created_velocity((0, 3, 0), left, rotate=False).tolist() == [0, 3, 0]


def test_spin_is_local() -> None:
    upside_down = matrix((0, 0, 180))
    quarter = orientation.spin(upside_down, (0, 90, 0), 1.0)
    # To the thing's own left, which is the world's right while it lies on its back.
    assert quarter[:, 1] == pytest.approx([1, 0, 0], abs=1e-15)


def test_renormalising_takes_drift_out() -> None:
    look = matrix((10, 20, 30))
    drifted = look * 1.01 + np.random.default_rng(8).normal(0, 1e-3, (3, 3))
    square = orientation.renormalised(drifted)
    assert square.T @ square == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(square) == pytest.approx(1)
    assert square == pytest.approx(look, abs=1e-2)
    assert square[:, 1] == pytest.approx(drifted[:, 1] / np.linalg.norm(drifted[:, 1]), abs=1e-15)
