"""Motion at the extremes: nothing overflows, no NaN out without NaN in, nothing turns round by itself.

Every test runs with all of numpy's floating-point errors raised.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.engine import bounds, drag, gravity, hover, integration, jump, orientation, reattach, simulation, thrust
from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.ground import Steps
from jktools.engine.integration import TRAITS, Scheme
from jktools.engine.profile import Engine
from jktools.engine.simulation import Phase, Simulation, simulate
from jktools.engine.thrust import Keys, Support


@pytest.fixture(autouse=True, scope="module")
def raising() -> Iterator[None]:
    with np.errstate(all="raise"):
        yield


DRAGS = st.sampled_from([0.0, 1e-12, 0.5, 3.0, 50.0, 999.0, 1e9, 1e30, math.inf]) | st.floats(0, 1e9)
STEPS = st.sampled_from([1e-9, 1e-3, 0.02, 1 / 3, 1.0]) | st.floats(1e-9, 1.0)
MASSES = st.sampled_from([0.0, 1e-12, 0.1, 150.0, 1e12]) | st.floats(0, 1e12)
ANY = st.floats(allow_nan=False) | st.sampled_from([0.0, -0.0, 1e30, -1e30, math.inf, -math.inf, 5e-324])
WILD = ANY | st.just(math.nan)
SPEEDS = st.floats(-1e30, 1e30)
DROPS = st.just(0.0) | st.floats(1e-9, 1e6) | st.floats(-1e6, -1e-9)
Triple = tuple[float, float, float]

SCHEMES, ENGINES = st.sampled_from(list(Scheme)), st.sampled_from(list(Engine))


def vectors(numbers: st.SearchStrategy[float]) -> st.SearchStrategy[Triple]:
    return st.tuples(numbers, numbers, numbers)


def test_inputs_are_kept_in_bounds() -> None:
    given = [math.inf, -math.inf, 1e31, -1e31, 1e30, 1e-30, 1e-31, -1e-31, 5e-324, 0.0, 3.0]
    kept = [1e30, -1e30, 1e30, -1e30, 1e30, 1e-30, 0.0, 0.0, 0.0, 0.0, 3.0]
    assert bounds.bounded(given).tolist() == kept
    assert [float(bounds.bounded(one)) for one in given] == kept
    assert np.isnan(bounds.bounded([math.nan])).all() and math.isnan(bounds.bounded(math.nan))


def test_length_of_extreme_vectors() -> None:
    assert bounds.length([[3e29, 4e29, 0.0], [3e-29, 0.0, 4e-29]]) == pytest.approx([5e29, 5e-29])
    assert bounds.length([0.0, 0.0, 0.0]) == 0.0


@settings(deadline=None)
@given(SCHEMES, WILD, WILD, WILD, DRAGS, STEPS)
def test_step_gives_nan_only_for_nan(scheme: Scheme, x: float, v: float, a: float, k: float, dt: float) -> None:
    motion = integration.step(scheme, x, v, a, k, dt)
    assert math.isnan(motion.velocity) == (math.isnan(v) or math.isnan(a))
    assert math.isnan(motion.position) == (math.isnan(x) or math.isnan(v) or math.isnan(a))


@settings(deadline=None)
@given(SCHEMES, SPEEDS, DRAGS, STEPS)
def test_drag_alone_never_reverses_within_the_limit(scheme: Scheme, v: float, k: float, dt: float) -> None:
    if min(k, 1e30) * dt <= TRAITS[scheme].reversal_limit:
        after = integration.step(scheme, 0.0, v, 0.0, k, dt).velocity
        assert after * np.sign(v) >= 0


@settings(deadline=None)
@given(SCHEMES, SPEEDS, DRAGS, STEPS)
def test_drag_alone_never_speeds_up_within_the_limit(scheme: Scheme, v: float, k: float, dt: float) -> None:
    if integration.is_stable(scheme, k, dt):
        after = integration.step(scheme, 0.0, v, 0.0, k, dt).velocity
        assert abs(after) <= abs(v) * (1 + 1e-12)
    else:
        assert "blows up" in str(integration.instability(scheme, k, dt))


@settings(deadline=None)
@given(DRAGS, st.floats(-1e6, 1e6), st.floats(0, 1e6))
def test_thrust_and_drag_stay_between_start_and_steady_speed(k: float, v: float, a: float) -> None:
    steady = float(integration.steady_speed(a, k))
    after = float(integration.closed_form(0.0, v, a, k, 1.0).velocity)
    slack = 1e-9 * max(1.0, abs(v), a)
    assert min(v, steady) - slack <= after <= max(v, steady) + slack


@settings(deadline=None)
@given(vectors(WILD), DRAGS, WILD, STEPS, ENGINES)
def test_apply_drag(v: Triple, k: float, static: float, dt: float, engine: Engine) -> None:
    after = drag.apply_drag(v, k, static, dt, engine)
    if not any(map(math.isnan, v)):
        assert not np.isnan(after).any()
    if engine is Engine.OPENJKDF2 or min(k, 1e30) * dt <= 1:
        kept = ~np.isnan(after) & ~np.isnan(v)
        assert (after[kept] * np.sign(np.array(v)[kept]) >= 0).all()
        assert (np.abs(after[kept]) <= np.abs(np.array(v)[kept])).all()


@settings(deadline=None)
@given(DRAGS, STEPS, ENGINES)
def test_decay_frames(k: float, dt: float, engine: Engine) -> None:
    frames = float(drag.decay_frames(k, dt, engine=engine))
    over = min(k, 1e30) * dt > 1
    assert math.isnan(frames) == (over and engine is Engine.RESEARCH)
    assert math.isnan(frames) or frames >= 1


@settings(deadline=None)
@given(MASSES, vectors(ANY))
def test_push(mass: float, force: Triple) -> None:
    push = gravity.apply_force(Body(mass=mass), force)
    assert np.isfinite(push.velocity_change).all()
    assert (push.velocity_change * np.sign(force) >= 0).all()


@settings(deadline=None)
@given(MASSES, vectors(ANY), ENGINES, st.sampled_from(list(Support)))
def test_sector_thrust(mass: float, force: Triple, engine: Engine, support: Support) -> None:
    body = dataclasses.replace(WALKPLAYER, mass=mass)
    assert np.isfinite(gravity.sector_acceleration(body, force, support)).all()
    assert gravity.sector_thrust_detaches(body, force, engine=engine) in (True, False)


@settings(deadline=None)
@given(vectors(ANY), st.floats(0, 1e30))
def test_actor_acceleration(direction: Triple, maxthrust: float) -> None:
    push = thrust.actor_acceleration(Body(maxthrust=maxthrust), direction, three_dimensional=True)
    assert np.isfinite(push).all()
    assert float(np.abs(push).max()) <= maxthrust * (1 + 1e-12)


@settings(deadline=None)
@given(st.floats(0, 1e9), st.sampled_from([0.0, 1e-12, 1e-6, 0.5, 999.0, 1e9]), st.floats(1e-6, 1e6))
def test_apex(speed: float, k: float, g: float) -> None:
    top = jump.apex(speed, k, g)
    assert 0 <= top.height <= speed * speed / (2 * g) * (1 + 1e-9) + 1e-300
    assert 0 <= top.seconds <= speed / g * (1 + 1e-12)


@settings(deadline=None)
@given(st.floats(0, 1e6), DROPS, st.sampled_from([0.0, 1e-12, 0.5, 999.0, 1e9]), st.floats(1e-3, 1e6))
def test_flight(speed: float, drop: float, k: float, g: float) -> None:
    seconds = float(jump.flight_seconds(speed, drop, k, g))
    top = jump.apex(speed, k, g)
    assert math.isnan(seconds) == bool(top.height < -drop)
    if not math.isnan(seconds):
        assert seconds >= top.seconds
        # What one rounding of the time moves the body by, and of the distances that cancel.
        slack = 1e-12 * (1e-9 + abs(drop) + top.height + (speed + g * seconds) * seconds)
        assert abs(float(integration.closed_form(0.0, speed, -g, k, seconds).position) + drop) <= slack


@settings(deadline=None)
@given(ANY, ANY, st.just(0.0) | st.floats(1e-9, 1e9))
def test_fall_damage_and_hover(speed: float, insert: float, radius: float) -> None:
    assert float(jump.fall_damage(speed)) >= 0
    for engine in Engine:
        height = float(hover.hover_height(insert, radius, engine=engine))
        assert height >= radius
        assert float(reattach.reattach_distance(insert, radius, engine=engine)) >= radius
        left = float(hover.settle(insert, 0.02))
        assert abs(left) <= abs(insert) and left * np.sign(insert) >= 0


@settings(deadline=None)
@given(vectors(st.floats(-1e9, 1e9)))
def test_angles_round_trip(angles: Triple) -> None:
    look = orientation.matrix(angles)
    assert look.T @ look == pytest.approx(np.eye(3), abs=1e-14)
    assert orientation.matrix(orientation.angles(look)) == pytest.approx(look, abs=1e-7)


@settings(deadline=None)
@given(vectors(WILD))
def test_angles_give_nan_only_for_nan(angles: Triple) -> None:
    look = orientation.matrix(angles)
    assert bool(np.isnan(look).any()) == any(map(math.isnan, angles))


@settings(deadline=None)
@given(
    DRAGS,
    st.sampled_from([1e-9, 1e-4, 0.02, 1.0]),
    MASSES,
    vectors(st.sampled_from([0.0, -3.0, 1e30, -1e30])),
    ENGINES,
)
def test_simulation(k: float, dt: float, mass: float, v: Triple, engine: Engine) -> None:
    body = dataclasses.replace(WALKPLAYER, surfdrag=k, airdrag=k, mass=mass)
    run = Simulation(body, Steps.flat(), engine=engine, velocity=np.array(v))
    run.rest_on_ground()
    keys = [Phase(0, Keys(forward=1)), Phase(5 * dt, Keys(jump=True)), Phase(20 * dt, Keys())]
    history = simulate(run, keys, 40 * dt, dt)
    for rows in (history.time, history.thrust, history.velocity, history.position):
        assert not np.isnan(rows).any()
    blows_up = min(k, 1e30) * dt > TRAITS[simulation.SCHEME_OF[engine]].stability_limit
    assert bool(history.warnings) is blows_up


def test_a_blow_up_is_told_and_the_engine_clamps_it() -> None:
    body = dataclasses.replace(WALKPLAYER, surfdrag=999.0, staticdrag=0.0)
    histories = {}
    for engine in Engine:
        run = Simulation(body, engine=engine, velocity=np.array([0.0, 1.0, 0.0]))
        run.rest_on_ground()
        histories[engine] = simulate(run, [], 1.0, 0.02)
    assert np.abs(histories[Engine.RESEARCH].velocity).max() > 1e20
    assert "surfdrag: semi-implicit-euler blows up" in histories[Engine.RESEARCH].warnings[0]
    assert not histories[Engine.OPENJKDF2].velocity[1:].any()
    assert histories[Engine.OPENJKDF2].warnings == ()
