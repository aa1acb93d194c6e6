"""The document's experiments on orientation, on what the compiled level says of the orientation room."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

from fixtures.smithdev.chambers.orientation_room import AWKWARD, ORIENTS, PLACED, SPIN
from jktools.engine import orientation
from jktools.engine.arrays import Float64
from jktools.engine.orientation import Creation
from tests.experiments.play import Play
from tests.experiments.scripts import placed
from tests.experiments.smithdev import GOLDEN, Experiment

ROOM = "orientation_room"
HALF = math.sqrt(0.5)
EXACT = 1e-7
"""Angles are float32 in the file."""


def angles_of(smithdev: Experiment, thing: str) -> Float64:
    held = smithdev.level.things
    assert held is not None
    row = np.flatnonzero(held.source == smithdev.thing(f"{ROOM}/{thing}"))
    return np.asarray(held.angles[row[0]], np.float64)


def template_of(smithdev: Experiment, thing: str) -> str:
    held = smithdev.level.things
    assert held is not None
    return str(
        smithdev.level.strings[held.template[np.flatnonzero(held.source == smithdev.thing(f"{ROOM}/{thing}"))[0]]]
    )


def made(smithdev: Experiment, cog: str) -> list[Float64]:
    """The look matrices of the three strifles that a placed script makes as the level starts, each at its ghost."""
    play = Play(smithdev, f"{ROOM}/door")
    found = []
    for i, name in enumerate(ORIENTS):
        ghost = play.things[smithdev.thing(f"{ROOM}/{cog} {i}")]
        (strifle,) = (
            thing
            for thing in play.living(f"sd_strifle_{name}")
            if (thing.place == ghost.place).all() and thing.number not in smithdev.handles[ROOM]["things"].values()
        )
        found.append(strifle.look)
    return found


def looks(matrices: Sequence[Float64]) -> list[list[float]]:
    """Look and up vectors, one after the other."""
    return [[*m[:, 1], *m[:, 2]] for m in matrices]


def test_orient_template_property(smithdev: Experiment) -> None:
    says = GOLDEN["orientation"]
    assert says["placed_in_jkl"] == "the JKL placement's pitch/yaw/roll; the template's orient is ignored"
    assert [tuple(smithdev.template(f"sd_strifle_{name}")["orient"]) for name in ORIENTS] == list(ORIENTS.values())
    for i, name in enumerate(ORIENTS):
        assert template_of(smithdev, f"placed {i}") == f"sd_strifle_{name}"
        assert angles_of(smithdev, f"placed {i}") == pytest.approx(PLACED, abs=1e-5)
        held = orientation.created(Creation.PLACED, ORIENTS[name], placed=angles_of(smithdev, f"placed {i}"))
        # Pitch 10, yaw 20: the look vector is (-sin 20 cos 10, cos 20 cos 10, sin 10), whatever the template says.
        assert held[:, 1] == pytest.approx([-0.3368241, 0.9254166, 0.1736482], abs=EXACT)

    assert says["created_at_ghost_0"] == "the template's orient"
    straight = made(smithdev, "ghost at 0")
    by_hand = [[0, 1, 0, 0, 0, 1], [0, HALF, HALF, 0, -HALF, HALF], [0, 1, 0, HALF, 0, HALF]]
    assert np.asarray(looks(straight)) == pytest.approx(np.array(by_hand), abs=EXACT)

    assert says["created_at_ghost_45"] == "ghost orientation composed with the template's orient"
    turned = made(smithdev, "ghost at 45")
    by_hand = [[-HALF, HALF, 0, 0, 0, 1], [-0.5, 0.5, HALF, 0.5, -0.5, HALF], [-HALF, HALF, 0, 0.5, 0.5, HALF]]
    assert np.asarray(looks(turned)) == pytest.approx(np.array(by_hand), abs=EXACT)


def test_creatething_vs_createthingnr(smithdev: Experiment) -> None:
    """`sd_creatething.cog` and `sd_createthingnr.cog` at ghosts turned alike: 'there is no difference'."""
    for script, verb in (("ghost at 45", "creatething"), ("ghost at 45, NR", "createthingnr")):
        code = placed(smithdev, f"{ROOM}/{script}").program
        assert [known.name for _, known in code.calls] == [verb] * len(ORIENTS)
    plain, other = made(smithdev, "ghost at 45"), made(smithdev, "ghost at 45, NR")
    same = all((a == b).all() for a, b in zip(plain, other, strict=True))
    assert same is GOLDEN["orientation"]["create_thing_nr_same_as_create_thing"]


def test_order_of_operations(smithdev: Experiment) -> None:
    """A thing with angvel, placed at an awkward angle, keeps its own up vector while it spins."""
    assert GOLDEN["orientation"]["angvel_axis"] == "local to the final orientation"
    look = orientation.matrix(angles_of(smithdev, "spinning"))
    assert angles_of(smithdev, "spinning") == pytest.approx(AWKWARD, abs=1e-5)
    spin = smithdev.template(template_of(smithdev, "spinning"))["angvel"]
    assert tuple(spin) == SPIN
    now = look
    for _ in range(50):
        now = orientation.spin(now, spin, 0.02)
        assert now[:, 2] == pytest.approx(look[:, 2], abs=1e-12)
    # 90 degrees a second, after a second: the look vector is where the left was.
    assert now[:, 1] == pytest.approx(-look[:, 0], abs=1e-12)
    # Not the world's up: that would have kept the look vector's height.
    assert abs(now[2, 1] - look[2, 1]) > 0.1


def test_internal_representation(smithdev: Experiment) -> None:
    """Look, up and right vectors hold all of an orientation: every thing's angles come back out of its matrix.

    The document finds verbs for the vectors and none for the angles, and concludes that vectors are what is kept.
    """
    held = smithdev.level.things
    assert held is not None
    angles = np.asarray(held.angles, np.float64)
    again = orientation.angles(orientation.matrix(angles))
    off = (again - angles + 180) % 360 - 180
    assert np.abs(off).max() < 1e-9
