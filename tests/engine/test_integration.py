"""Order of accuracy, stability limit and cost of every scheme, against the closed form and by hand."""

from __future__ import annotations

import math
from decimal import Decimal, getcontext

import numpy as np
import pytest

from jktools.engine import integration
from jktools.engine.integration import TRAITS, Motion, Scheme, closed_form, factors, step

THRUST, DRAG = 2.0, 3.0
STEPPED = [scheme for scheme in Scheme if scheme is not Scheme.EXACT]


def march(scheme: Scheme, seconds: float, dt: float, *, v: float = 0.0, a: float = THRUST) -> Motion:
    motion = Motion(np.float64(0), np.float64(v))
    for _ in range(round(seconds / dt)):
        motion = step(scheme, *motion, a, DRAG, dt)
    return motion


@pytest.mark.parametrize("scheme", STEPPED)
@pytest.mark.parametrize("quantity", ["position", "velocity"])
@pytest.mark.parametrize(("v", "a"), [(0.0, 2.0), (1.0, 0.0)], ids=["walk", "stop"])
def test_order_of_accuracy(scheme: Scheme, quantity: str, v: float, a: float) -> None:
    true = getattr(closed_form(0.0, v, a, DRAG, 1.0), quantity)
    errors = [abs(float(getattr(march(scheme, 1.0, dt, v=v, a=a), quantity) - true)) for dt in (1 / 50, 1 / 100)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(TRAITS[scheme].order, abs=0.1)


@pytest.mark.parametrize("scheme", [s for s in Scheme if math.isfinite(TRAITS[s].stability_limit)])
def test_stability_limit(scheme: Scheme) -> None:
    limit = TRAITS[scheme].stability_limit
    for h, grows in ((limit * (1 - 1e-9), False), (limit * (1 + 1e-9), True)):
        assert bool(abs(factors(scheme, h, 1.0).keep) > 1) is grows
    # By 300 steps of drag alone: beyond the limit speed grows without end, within it not at all.
    for h, grows in ((0.99 * limit, False), (1.01 * limit, True)):
        v = 1.0
        for _ in range(300):
            v = float(step(scheme, 0.0, v, 0.0, h, 1.0).velocity)
        assert (abs(v) > 1) is grows
    assert integration.is_stable(scheme, limit, 1.0) and not integration.is_stable(scheme, limit * 1.01, 1.0)


@pytest.mark.parametrize("scheme", Scheme)
def test_reversal_limit(scheme: Scheme) -> None:
    limit = min(TRAITS[scheme].reversal_limit, 1e9)
    h = np.concatenate([np.linspace(0, min(limit, 10.0), 10_001), np.geomspace(1e-9, limit, 1000)])
    assert (factors(scheme, h, 1.0).keep >= 0).all()
    if math.isfinite(TRAITS[scheme].reversal_limit):
        assert factors(scheme, limit * 1.001, 1.0).keep < 0


def acceleration(v: float) -> float:
    return THRUST - DRAG * v


def textbook(scheme: Scheme, x: float, v: float, dt: float) -> tuple[float, float, int]:
    """One step as each scheme is usually written, and how often it asked for the acceleration."""
    asked = 0

    def a(v: float) -> float:
        nonlocal asked
        asked += 1
        return acceleration(v)

    if scheme is Scheme.EXPLICIT_EULER:
        return x + v * dt, v + a(v) * dt, asked
    if scheme in (Scheme.SEMI_IMPLICIT_EULER, Scheme.ENGINE):
        new = v + a(v) * dt
        return x + new * dt, new, asked
    if scheme is Scheme.VERLET:
        last = x - v * dt
        new_x = 2 * x - last + a((x - last) / dt) * dt * dt
        return new_x, (new_x - x) / dt, asked
    if scheme is Scheme.VELOCITY_VERLET:
        first = a(v)
        return x + v * dt + first * dt * dt / 2, v + (first + a(v + first * dt)) * dt / 2, asked
    k1 = a(v)
    k2 = a(v + k1 * dt / 2)
    k3 = a(v + k2 * dt / 2)
    k4 = a(v + k3 * dt)
    slopes = v, v + k1 * dt / 2, v + k2 * dt / 2, v + k3 * dt
    new_x = x + dt / 6 * (slopes[0] + 2 * slopes[1] + 2 * slopes[2] + slopes[3])
    return new_x, v + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4), asked


@pytest.mark.parametrize("scheme", STEPPED)
def test_textbook_step(scheme: Scheme) -> None:
    for x, v, dt in ((0.5, 0.2, 0.1), (-3.0, 4.0, 0.02), (0.0, 0.0, 0.3)):
        position, velocity, _ = textbook(scheme, x, v, dt)
        assert step(scheme, x, v, THRUST, DRAG, dt) == pytest.approx((position, velocity), rel=1e-13, abs=1e-15)


@pytest.mark.parametrize("scheme", STEPPED)
def test_cost(scheme: Scheme) -> None:
    calls = 0

    def counted(v: float) -> float:
        nonlocal calls
        calls += 1
        return THRUST - DRAG * v

    original = globals()["acceleration"]
    globals()["acceleration"] = counted
    try:
        textbook(scheme, 0.0, 0.1, 0.02)
    finally:
        globals()["acceleration"] = original
    assert calls == TRAITS[scheme].evaluations


def test_logs_cannot_tell_verlet_from_euler() -> None:
    """Started as the document starts it, Verlet is semi-implicit Euler, position and velocity alike."""
    x, last = 0.5, 0.5 - 0.3 * 0.02
    motion = Motion(np.float64(0.5), np.float64(0.3))
    for _ in range(200):
        x, last = 2 * x - last + acceleration((x - last) / 0.02) * 0.02**2, x
        motion = step(Scheme.SEMI_IMPLICIT_EULER, *motion, THRUST, DRAG, 0.02)
    assert motion.position == pytest.approx(x, rel=1e-12)
    assert motion.velocity == pytest.approx((x - last) / 0.02, rel=1e-10)


def test_engine_clamps() -> None:
    """Below dt x drag = 1 the engine's step is semi-implicit Euler; from there drag takes all and no more."""
    for h in (0.0, 0.5, 1.0):
        assert factors(Scheme.ENGINE, h, 1.0) == factors(Scheme.SEMI_IMPLICIT_EULER, h, 1.0)
    for h in (1.0, 2.0, 1e9, math.inf):
        assert step(Scheme.ENGINE, 0.0, 5.0, 0.0, h, 1.0) == (0.0, 0.0)


def test_blow_up_is_said() -> None:
    said = integration.instability(Scheme.SEMI_IMPLICIT_EULER, 999.0, 0.02)
    assert said == (
        "semi-implicit-euler blows up: dt x drag = 19.98 exceeds 2, so each step multiplies the speed by 18.98"
    )
    assert integration.instability(Scheme.ENGINE, 999.0, 0.02) is None
    assert integration.instability(Scheme.EXPLICIT_EULER, 100.0, 0.02) is None


def reference(speed: float, acceleration: float, drag: float, seconds: float) -> tuple[float, float]:
    """The closed form in 60 digits, where no cancellation matters."""
    getcontext().prec = 60
    v, a, k, t = (Decimal(n) for n in (speed, acceleration, drag, seconds))
    if k == 0:
        return float(v * t + a * t * t / 2), float(v + a * t)
    decay = (-k * t).exp()
    return float(a / k * t + (v - a / k) * (1 - decay) / k), float(a / k + (v - a / k) * decay)


@pytest.mark.parametrize("k", [0.0, 1e-12, 1e-6, 1e-3, 0.049, 0.0999, 0.1001, 0.5, 3.0, 100.0, 999.0])
@pytest.mark.parametrize("t", [1e-9, 0.02, 1.0])
def test_closed_form_keeps_its_digits(k: float, t: float) -> None:
    for v, a in ((1.0, 0.0), (0.0, 2.0), (1.5, -4.0)):
        assert closed_form(0.0, v, a, k, t) == pytest.approx(reference(v, a, k, t), rel=3e-14, abs=1e-26)


def test_closed_form_composes() -> None:
    """Two halves make a whole: what only the true flow does."""
    half = closed_form(0.3, 1.0, 2.0, 3.0, 0.25)
    assert closed_form(*half, 2.0, 3.0, 0.25) == pytest.approx(closed_form(0.3, 1.0, 2.0, 3.0, 0.5), rel=1e-14)


def test_step_broadcasts() -> None:
    bodies = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]])
    drags = np.array([[0.5], [3.0]])
    for scheme in Scheme:
        whole = step(scheme, bodies, bodies, 1.0, drags, 0.02)
        for i, j in np.ndindex(bodies.shape):
            one = step(scheme, bodies[i, j], bodies[i, j], 1.0, drags[i, 0], 0.02)
            assert (whole.position[i, j], whole.velocity[i, j]) == one


def test_steady_speed() -> None:
    assert integration.steady_speed([2.0, 0.0, 1.0, -1.0], [3.0, 0.0, 0.0, 0.0]) == pytest.approx(
        [2 / 3, 0.0, math.inf, -math.inf]
    )
