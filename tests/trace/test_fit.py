"""Fits of recordings whose truth is known: what made them comes out, and what cannot be told is left open."""

from __future__ import annotations

import math

import numpy as np
import pytest

from jktools.engine import integration
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.simulation import Phase
from jktools.engine.thrust import Keys
from jktools.trace import recording
from jktools.trace.fitting import FitError, fit
from jktools.trace.recording import Recording
from jktools.trace.write import recorded
from tests.engine.motion_checks import changed, run

EULERS = {Scheme.EXPLICIT_EULER, Scheme.SEMI_IMPLICIT_EULER, Scheme.ENGINE, Scheme.VERLET}


def log(
    scheme: Scheme,
    *,
    drag: float = 3.0,
    part: float = 1.0,
    yaw: float = 0.0,
    dt: np.ndarray | float = 0.021,
    noise: float = 0.0,
    kicks: float = 0.0,
    seed: int = 8,
    frames: int = 150,
    positions: bool = True,
) -> Recording:
    """Walk forward, then sideways, then coast, made here frame by frame."""
    dice = np.random.default_rng(seed)
    steps = np.broadcast_to(dt, frames)
    thrust = np.zeros((frames + 1, 3))
    thrust[1:60, 1], thrust[60:90, 0] = 2.0, 1.4
    turn = np.array([[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]])
    x = v = np.zeros(3)
    rows = [(x, v)]
    for i in range(frames):
        x, v = integration.step(scheme, x, v, part * (turn @ thrust[i + 1]), drag, steps[i])
        v = v + kicks * dice.normal(size=3) * (1, 1, 0)
        rows.append((x, v))
    position, velocity = (np.array(column) for column in zip(*rows, strict=True))
    velocity = velocity + noise * dice.normal(size=velocity.shape)
    time = np.concatenate([[0.0], np.cumsum(steps)])
    return Recording(time, thrust, velocity, position if positions else None)


UNEVEN = np.random.default_rng(1).uniform(0.01, 0.06, 150)


@pytest.mark.parametrize("scheme", Scheme)
def test_uneven_frames_tell_schemes_apart(scheme: Scheme) -> None:
    found = fit(log(scheme, dt=UNEVEN, part=0.3, yaw=0.7))
    (best,) = found.best
    assert scheme in best.schemes
    assert best.drag.value == pytest.approx(3.0, rel=1e-9)
    assert best.thrust and best.thrust.value == pytest.approx(0.3, rel=1e-9)
    assert best.yaw == pytest.approx(math.degrees(0.7), abs=1e-7)
    assert best.residual < 1e-12 < found.candidates[1].residual


def test_positions_tell_the_eulers_apart() -> None:
    made = log(Scheme.EXPLICIT_EULER, dt=UNEVEN)
    assert fit(made).best[0].schemes == (Scheme.EXPLICIT_EULER,)
    made = log(Scheme.SEMI_IMPLICIT_EULER, dt=UNEVEN)
    assert set(fit(made).best[0].schemes) == EULERS - {Scheme.EXPLICIT_EULER}
    without = Recording(made.time, made.thrust, made.velocity)
    assert set(fit(without).best[0].schemes) == EULERS


def test_even_frames_of_a_decay_fit_every_scheme() -> None:
    """With one frame time every scheme has its own drag for the same decay; the known one decides."""
    made = log(Scheme.SEMI_IMPLICIT_EULER).between(91 * 0.021, 9)
    found = fit(made)
    assert len(found.best) == 4
    drags = {c.schemes[0]: c.drag.value for c in found.candidates}
    assert drags[Scheme.EXPLICIT_EULER] == pytest.approx(3.0, rel=1e-9)
    assert drags[Scheme.EXACT] == pytest.approx(-math.log(1 - 3 * 0.021) / 0.021, rel=1e-6)
    (known,) = fit(made, known_drag=3.0).best
    assert set(known.schemes) <= EULERS


def test_the_document_s_single_step() -> None:
    """Tables 13 and 14 by this fit: its two samples and three made by the same rule give surfdrag 3."""
    speeds = [0.869554, 0.814772]
    for _ in range(3):
        speeds.append(round(speeds[-1] * (1 - 3 * 0.021), 6))
    time = 11.624 + 0.021 * np.arange(5)
    velocity = np.zeros((5, 3))
    velocity[:, 1] = speeds
    found = fit(Recording(time, np.zeros((5, 3)), velocity), known_drag=3.0)
    assert found.best[0].drag.value == pytest.approx(3.0, abs=1e-4)
    assert Scheme.SEMI_IMPLICIT_EULER in found.best[0].schemes


def held(noise: float, kicks: float) -> tuple[int, int]:
    """How many of 200 logs' intervals hold the true drag and part of thrust."""
    drags = parts = 0
    for seed in range(200):
        made = log(Scheme.ENGINE, noise=noise, kicks=kicks, seed=seed, frames=60, positions=False)
        (euler,) = (c for c in fit(made).candidates if Scheme.ENGINE in c.schemes)
        assert euler.thrust is not None
        drags += euler.drag.holds(3.0)
        parts += euler.thrust.holds(1.0)
    return drags, parts


def test_intervals_hold_the_truth_nineteen_times_in_twenty() -> None:
    # 190 expected, standard deviation 3.1: four of them either way.
    assert all(178 <= count <= 199 for count in held(noise=0.0, kicks=1e-3))


def test_intervals_are_safe_where_only_the_log_is_noisy() -> None:
    assert all(count >= 190 for count in held(noise=1e-3, kicks=0.0))


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("threshold", [0.15, 0.3, 0.6])
def test_static_threshold_is_bracketed(threshold: float, engine: Engine) -> None:
    walk = [Phase(0, Keys(forward=1)), Phase(2, Keys())]
    made = recorded(run(walk, 4.0, of=changed(staticdrag=threshold), engine=engine))
    found = fit(made)
    assert found.static is not None
    low, high = found.static
    assert low <= threshold < high
    assert high - low < 0.07 * threshold  # one frame's decay, 6 %


def test_single_precision_logs_are_good_to_four_digits() -> None:
    made = log(Scheme.ENGINE, dt=UNEVEN, positions=False)
    found = fit(recording.parse_raw(recording.to_raw(made)))
    assert Scheme.ENGINE in found.best[0].schemes
    assert found.best[0].drag.value == pytest.approx(3.0, rel=1e-4)
    assert found.best[0].drag.holds(3.0)


def test_too_little_motion() -> None:
    still = Recording(np.arange(9.0), np.zeros((9, 3)), np.zeros((9, 3)))
    with pytest.raises(FitError, match="0 frames of motion are too few"):
        fit(still)
