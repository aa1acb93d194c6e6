"""Dynamic light beyond the golden tables: models, sums, limits, brightness."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine import light

UP = [0.0, 0.0, 1.0]


def test_reach() -> None:
    """A light of 1 reaches 1.25 JKU on the level and 2.5 on models, not 1."""
    assert light.reach([1.0, 0.0, -1.0, np.nan]).tolist() == [1.25, 0.0, 0.0, 0.0]
    assert light.reach(1.0, light.MODEL_FALLOFF) == 2.5
    dark = light.light_on_vertices([[1.249, 0, 0], [1.25, 0, 0]], [[0, 0, 0]], [1.0])
    assert dark[0] == pytest.approx(0.0008)
    assert dark[1] == 0.0


def test_lights_add_up_and_are_clamped_at_the_end() -> None:
    lamps = [[0.0, 0.0, 0.5]] * 3
    total = light.light_on_vertices([[0.0, 0.0, 0.0]], lamps, [1.0, 1.0, -4.0])
    assert total.tolist() == pytest.approx([1.2])
    assert light.surface_brightness(0.1, 0.3, total, 0.2).tolist() == [1.0]
    assert light.surface_brightness([0.1, 0.9], 0.3, -0.5, 0.2).tolist() == [0.1, 0.9]
    assert light.thing_brightness([0.2, 2.0, -1.0], 0.25).tolist() == [0.45, 1.0, 0.0]


def test_only_32_lights_shine() -> None:
    lamps = np.zeros((40, 3))
    assert light.light_on_vertices([[0.0, 0.0, 0.0]], lamps, np.full(40, 0.01)) == pytest.approx(0.32)


def test_models_are_lit_from_the_front() -> None:
    """Facing the lamp: 1 - 0.4 d; at 60 degrees half of it; edge on and from behind nothing."""
    normals = [UP, [0.0, np.sqrt(0.75), 0.5], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]
    lit = light.light_on_model(np.zeros((4, 3)), normals, [[0.0, 0.0, 1.5]], [1.0])
    assert lit.tolist() == pytest.approx([0.4, 0.2, 0.0, 0.0])
    assert light.light_on_model([[0.0] * 3], [UP], [[0, 0, 2.5], [0, 0, 0]], [1.0, 9.0]).tolist() == [0.0]
    assert light.light_on_model([[0.0] * 3], [UP], [[0, 0, 0.1]] * 5, [0.5] * 5).tolist() == [1.0]


def test_surfaces_are_lit_at_their_centre() -> None:
    assert light.light_on_surfaces([1.0, 0.0, 0.5, 0.25, 0.75], [0, 3]).tolist() == [0.5, 0.5]
    assert light.light_on_surfaces([], []).tolist() == []


@pytest.mark.parametrize(
    "call",
    [
        lambda: light.light_on_vertices([0.0, 0.0, 0.0], [[0, 0, 0]], [1.0]),
        lambda: light.light_on_vertices([[0.0, 0.0, 0.0]], [[0, 0, 0]], [1.0, 2.0]),
        lambda: light.light_on_model([[0.0, 0.0, 0.0]], [UP, UP], [[0, 0, 0]], [1.0]),
        lambda: light.light_on_surfaces([1.0, 1.0], [0, 2]),
        lambda: light.light_on_surfaces([1.0, 1.0], [0, 0]),
    ],
)
def test_shapes_that_do_not_fit_are_refused(call: object) -> None:
    assert callable(call)
    with pytest.raises(ValueError, match=r"vertices|vertex|intensities|normal"):
        call()
