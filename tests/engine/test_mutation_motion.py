"""The golden checks notice a change: of every golden value, and of every formula behind them.

A change is 2 %, or twice the golden tolerance where that is more, up and down; a flag loses its bit, a yes
becomes a no.
"""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
import pytest

from jktools.engine import (
    attachment,
    body,
    drag,
    gravity,
    hover,
    integration,
    orientation,
    reattach,
    simulation,
    thrust,
)
from jktools.engine.flags import WeaponFlag
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from tests.engine import motion_checks as checks
from tests.engine import pose_checks
from tests.engine.motion_checks import Check, Golden
from tests.engine.test_golden_motion import holding, motion_keys

SMALL = 0.02
TWICE_TOLERANCE = {
    "steady_speed.walk_floor.speed": 2 * 0.03 / 0.65,
    "steady_speed.walk_non_floor.speed": 2 * 0.02 / 1.2,
}


def is_noticed(check: Check, golden: Golden) -> bool:
    try:
        check(golden)
    except (AssertionError, AttributeError, KeyError, ValueError):
        return True
    return False


def variants(value: Any, path: str) -> Iterator[Any]:
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, str):
        yield "q" + value
    elif isinstance(value, int) and ".flags." in f".{path}":
        yield value << 1
    else:
        change = max(SMALL, TWICE_TOLERANCE.get(path, 0.0))
        # A golden 0 has no 2 %: what the document's last digit could hide stands for it.
        yield from (value * (1 - change), value * (1 + change)) if value else (-1e-6, 1e-6)


def replaced(golden: Golden, path: str, value: Any) -> Golden:
    changed = copy.deepcopy(golden)
    node: Any = changed
    *way, last = [int(key) if key.isdigit() else key for key in path.split(".")]
    for key in way:
        node = node[key]
    node[last] = value
    return changed


def value_at(golden: Golden, path: str) -> Any:
    node: Any = golden
    for key in path.split("."):
        node = node[int(key) if key.isdigit() else key]
    return node


def test_every_golden_value_is_read(golden: Golden) -> None:
    unnoticed = [
        (path, variant)
        for path in motion_keys(golden)
        for variant in variants(value_at(golden, path), path)
        if not any(is_noticed(check, replaced(golden, path, variant)) for check in holding(path))
    ]
    assert unnoticed == []


class Mutation(NamedTuple):
    """One formula made wrong: `attribute` of `module` goes through `change`, and `check` must fail."""

    check: Check
    module: Any
    attribute: str
    change: Callable[[Any, float], Any]
    amount: float = SMALL


def scale(value: Any, factor: float) -> Any:
    return value * factor


def scale_result(function: Any, factor: float) -> Any:
    return lambda *args, **kwargs: function(*args, **kwargs) * factor


def scale_field(name: str) -> Callable[[Any, float], Any]:
    return lambda value, factor: dataclasses.replace(value, **{name: getattr(value, name) * factor})


def scale_drag(function: Any, factor: float) -> Any:
    return lambda *args, **kwargs: function(*args, **kwargs)._replace(drag=function(*args, **kwargs).drag * factor)


def scale_static(function: Any, factor: float) -> Any:
    return lambda v, static, *engine: function(v, np.asarray(static) * factor, *engine)


def scale_frames(function: Any, factor: float) -> Any:
    return lambda k, dt: function(np.asarray(k) * factor, dt)


def scale_loss(function: Any, factor: float) -> Any:
    return lambda v, k, static, dt: function(v, k * factor, static, dt)


def scale_angles(function: Any, factor: float) -> Any:
    return lambda angles: function(np.asarray(angles) * factor)


def scale_seconds(function: Any, factor: float) -> Any:
    return lambda look, angvel, dt: function(look, angvel, dt * factor)


def scale_change(function: Any, factor: float) -> Any:
    def pushed(*args: Any) -> Any:
        push = function(*args)
        return push._replace(velocity_change=push.velocity_change * factor)

    return pushed


def scale_entry(key: Any) -> Callable[[Any, float], Any]:
    return lambda table, factor: {**table, key: table[key] * factor}


def scale_argument(function: Any, factor: float) -> Any:
    return lambda h: function(h * factor)


MUTATIONS = [
    *(
        Mutation(checks.walkplayer, body, "WALKPLAYER", scale_field(name))
        for name in ("staticdrag", "surfdrag", "airdrag", "maxthrust", "movesize", "insert_offset_z")
    ),
    Mutation(checks.movement_table, thrust, "BACKWARD_FACTOR", scale),
    Mutation(checks.movement_table, thrust, "STRAFE_FACTOR", scale),
    Mutation(checks.movement_table, body, "WALKPLAYER", scale_field("maxthrust")),
    Mutation(checks.thrust_follows_the_look, orientation, "matrix", scale_angles),
    Mutation(checks.thrust_follows_the_look, thrust, "thrust_acceleration", scale_result),
    Mutation(checks.unattached_thrust, thrust, "UNATTACHED_FACTOR", scale),
    Mutation(checks.gaits, thrust, "RUN_FACTOR", scale),
    Mutation(checks.gaits, thrust, "CROUCH_FACTOR", scale),
    Mutation(checks.surfaces_and_thrust, thrust, "surface_thrust_factor", scale_result),
    Mutation(checks.actors_accelerate_at_maxthrust, thrust, "actor_acceleration", scale_result),
    Mutation(checks.steady_speeds, thrust, "player_thrust", scale_result),
    Mutation(checks.steady_speeds, drag, "coefficients", scale_drag),
    Mutation(checks.steady_speeds, integration, "steady_speed", scale_result, 2 * 0.03 / 0.65),
    Mutation(checks.decay_times, drag, "decay_frames", scale_frames),
    Mutation(checks.decay_times, drag, "REST_SPEED", scale_entry(Engine.RESEARCH)),
    Mutation(checks.single_step, drag, "apply_drag", scale_loss),
    Mutation(checks.single_step, body, "WALKPLAYER", scale_field("surfdrag")),
    Mutation(checks.no_drag, simulation, "thrust_acceleration", scale_result),
    Mutation(checks.only_airdrag, drag, "coefficients", scale_drag),
    Mutation(checks.static_drag, drag, "coefficients", scale_drag),
    Mutation(checks.static_drag, drag, "stops", scale_static),
    Mutation(checks.gravity_and_mass, gravity, "apply_force", scale_change),
    Mutation(checks.sector_thrust, gravity, "sector_acceleration", scale_result),
    Mutation(checks.sector_thrust, gravity, "gravity_acceleration", scale_result),
    Mutation(pose_checks.strifles, orientation, "matrix", scale_angles),
    Mutation(pose_checks.angular_velocity_axis, orientation, "spin", lambda f, s: lambda m, w, dt: f(m, w, dt * s)),
    Mutation(pose_checks.default_insert_offset, hover, "hover_height", scale_result),
    Mutation(pose_checks.crouching, hover, "CROUCHED_CLEARANCE", scale),
    Mutation(pose_checks.crouching, hover, "LEAST_CLEARANCE", scale),
    Mutation(pose_checks.landing_transition, hover, "SETTLING_SPEED", scale),
    Mutation(pose_checks.changeovers, reattach, "reattach_distance", scale_result),
    Mutation(pose_checks.settling_bump, hover, "SETTLING_SPEED", scale),
    Mutation(pose_checks.settling_bump, simulation.Simulation, "hover_height", scale_result),
]


@pytest.mark.parametrize("direction", [-1, 1], ids=["less", "more"])
@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda m: f"{m.check.__name__}-{m.attribute}")
def test_wrong_formula_is_noticed(
    mutation: Mutation, direction: int, golden: Golden, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = getattr(mutation.module, mutation.attribute)
    changed = mutation.change(original, 1 + direction * mutation.amount)
    monkeypatch.setattr(mutation.module, mutation.attribute, changed)
    assert is_noticed(mutation.check, golden)


def rotating(how: Any, template: Any, spawner: Any) -> Any:
    return orientation.matrix(template) + (how is orientation.Creation.CREATE_THING_NR)


def ignoring_the_ghost(how: Any, template: Any, placed: Any = None, spawner: Any = None) -> Any:
    return orientation.matrix(template)


def always(value: Any) -> Any:
    return lambda *args, **kwargs: value


INVERSIONS = [
    (checks.falling_shows_no_thrust, simulation, "player_thrust", always(np.array([0.0, 0.0, -4.0]))),
    (checks.actors_read_no_thrust, thrust, "ACTOR_READABLE_THRUST", 1e-6),
    (pose_checks.create_thing_nr, orientation, "created", rotating),
    (pose_checks.physics_flags, pose_checks, "PHYSICS_NAMES", {}),
    (pose_checks.attach_flags, attachment, "READING_OF", {}),
    (pose_checks.weapon_flags, attachment, "weapon_sticks", always(True)),
    (checks.surface_flags, checks, "SurfaceFlag", WeaponFlag),
    (pose_checks.larger_insert_offset, simulation.Simulation, "hover_height", always(0.120114)),
    (pose_checks.pits, reattach, "search_distance", always(0.12)),
    (pose_checks.pits, reattach, "search_distance", always(9.0)),
    (pose_checks.stationary_bodies_notice_nothing, attachment, "looks_for_floor", always(True)),
    (pose_checks.strifles, orientation, "created", ignoring_the_ghost),
    (checks.gravity_and_mass, gravity, "gravity_acceleration", lambda of, *args, **kwargs: -4.0 * of.mass),
]


@pytest.mark.parametrize(("check", "module", "attribute", "wrong"), INVERSIONS)
def test_opposite_rule_is_noticed(
    check: Check, module: Any, attribute: str, wrong: Any, golden: Golden, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, attribute, wrong)
    assert is_noticed(check, golden)


def test_every_check_is_mutated() -> None:
    mutated = {mutation.check for mutation in MUTATIONS} | {inversion[0] for inversion in INVERSIONS}
    assert set(checks.CHECKS.values()) - mutated == set()


@pytest.mark.parametrize("scheme", Scheme)
def test_steps_of_every_scheme_are_noticed(scheme: Scheme, monkeypatch: pytest.MonkeyPatch) -> None:
    # The closed form of the walk, by hand: 2/3 (1 - exp(-3 t)).
    def check() -> bool:
        v = 0.0
        for _ in range(1000):
            v = float(integration.step(scheme, 0.0, v, 2.0, 3.0, 0.001).velocity)
        return abs(v - 2 / 3 * (1 - np.exp(-3.0))) < 1e-3

    assert check()
    original = integration._FACTORS[scheme]
    monkeypatch.setitem(integration._FACTORS, scheme, scale_argument(original, 1 + SMALL))
    assert not check()
