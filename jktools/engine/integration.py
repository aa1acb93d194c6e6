"""Integration schemes for a body under constant acceleration and linear drag, behind one interface.

The equation is dv/dt = acceleration - drag * v, dx/dt = v. Every scheme is linear in it, so one step is

    v' = R(h) v + dt S(h) acceleration      x' = x + dt P(h) v + dt^2 Q(h) acceleration      h = drag * dt

and a scheme is the four functions R, S, P, Q. The document works with Euler (research document, "Integration
Schemes") and leaves open which one the game uses; the decompiled engine does velocity first, then position
with the new velocity (sithPhysics_ThingPhysGeneral), drag clamped (sithPhysics_ApplyDrag).
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.bounds import bounded


class Scheme(enum.StrEnum):
    """A way to step a body. Order, stability limit and cost of each are in `TRAITS`."""

    EXPLICIT_EULER = "explicit-euler"
    """Position from the old velocity."""
    SEMI_IMPLICIT_EULER = "semi-implicit-euler"
    """Position from the new velocity: the document's code fragment."""
    ENGINE = "engine"
    """Semi-implicit Euler that takes away at most the whole velocity: what the decompiled engine does."""
    VERLET = "verlet"
    """Positions only, velocity = (position - last position) / dt, as the document starts and reads it."""
    VELOCITY_VERLET = "velocity-verlet"
    """The end's acceleration taken at the velocity that Euler predicts, since drag depends on velocity."""
    RK4 = "rk4"
    EXACT = "exact"
    """The closed form: no error at any dt."""


class Traits(NamedTuple):
    """What is known of a scheme before it runs."""

    order: float
    """Global order of accuracy under drag, of position and velocity alike."""
    stability_limit: float
    """Greatest dt * drag at which speed does not grow by itself."""
    reversal_limit: float
    """Greatest dt * drag at which drag alone never reverses a velocity."""
    evaluations: int
    """Evaluations of the acceleration a step, the usual measure of cost; 0 for the closed form."""


RK4_LIMIT = 2.7852935634052818
"""The positive root of h^3/24 - h^2/6 + h/2 - 1, where RK4's factor returns to 1."""

TRAITS = {
    Scheme.EXPLICIT_EULER: Traits(1, 2.0, 1.0, 1),
    Scheme.SEMI_IMPLICIT_EULER: Traits(1, 2.0, 1.0, 1),
    Scheme.ENGINE: Traits(1, math.inf, math.inf, 1),
    Scheme.VERLET: Traits(1, 2.0, 1.0, 1),
    Scheme.VELOCITY_VERLET: Traits(2, 2.0, math.inf, 2),
    Scheme.RK4: Traits(4, RK4_LIMIT, math.inf, 4),
    Scheme.EXACT: Traits(math.inf, math.inf, math.inf, 0),
}


class Factors(NamedTuple):
    """R, S, P, Q of the module's equation for given h."""

    keep: Float64
    gain: Float64
    drift: Float64
    bend: Float64


class Motion(NamedTuple):
    """Position (JKU) and velocity (JKU/s) after a step, in the shape that the inputs broadcast to."""

    position: Float64
    velocity: Float64


def _explicit_euler(h: Float64) -> Factors:
    one = np.ones_like(h)
    return Factors(1 - h, one, one, np.zeros_like(h))


def _semi_implicit_euler(h: Float64) -> Factors:
    one = np.ones_like(h)
    return Factors(1 - h, one, 1 - h, one)


def _engine(h: Float64) -> Factors:
    keep, one = 1 - np.minimum(h, 1), np.ones_like(h)
    return Factors(keep, one, keep, one)


def _velocity_verlet(h: Float64) -> Factors:
    return Factors(1 - h + h * h / 2, 1 - h / 2, 1 - h / 2, np.full_like(h, 0.5))


def _rk4(h: Float64) -> Factors:
    bend = 1 / 2 - h / 6 + h * h / 24
    gain = 1 - h * bend
    return Factors(1 - h * gain, gain, gain, bend)


def _exact(h: Float64) -> Factors:
    phi1 = decay_mean(h)
    return Factors(np.exp(-h), phi1, phi1, _decay_mean_of_mean(h))


_FACTORS: dict[Scheme, Callable[[Float64], Factors]] = {
    Scheme.EXPLICIT_EULER: _explicit_euler,
    Scheme.SEMI_IMPLICIT_EULER: _semi_implicit_euler,
    Scheme.ENGINE: _engine,
    # With v = (x - last x) / dt, x' = 2x - last x + a dt^2 is v' = v + a dt, x' = x + v' dt, letter for
    # letter.
    Scheme.VERLET: _semi_implicit_euler,
    Scheme.VELOCITY_VERLET: _velocity_verlet,
    Scheme.RK4: _rk4,
    Scheme.EXACT: _exact,
}


def decay_mean(h: npt.ArrayLike) -> Float64:
    """Average exp(-s) over s from 0 to h: (1 - exp(-h)) / h, and 1 at h = 0."""
    h = bounded(h)
    with np.errstate(under="ignore"):
        return np.divide(-np.expm1(-h), h, out=np.ones_like(h), where=h != 0)


def _decay_mean_of_mean(h: Float64) -> Float64:
    """(1 - decay_mean(h)) / h; below 0.1 by its series, where the difference would cancel."""
    small = h < 0.1
    safe = np.where(small, 1.0, h)
    near = np.where(small, h, 0.0)
    series = np.full_like(h, 1 / 3628800)
    for factorial in (362880, 40320, 5040, 720, 120, 24, 6, 2):
        series = 1 / factorial - near * series
    return np.where(small, series, (1 - decay_mean(safe)) / safe)


@np.errstate(under="ignore")  # what underflows here is a rest too small to hold, and 0 is its value
def factors(scheme: Scheme, drag: npt.ArrayLike, dt: npt.ArrayLike) -> Factors:
    """Give R, S, P and Q of the module's equation; `drag` in 1/s and `dt` in s are not negative."""
    return _FACTORS[scheme](np.asarray(bounded(drag) * bounded(dt)))


@np.errstate(under="ignore")
def step(
    scheme: Scheme,
    position: npt.ArrayLike,
    velocity: npt.ArrayLike,
    acceleration: npt.ArrayLike,
    drag: npt.ArrayLike,
    dt: npt.ArrayLike,
) -> Motion:
    """Advance bodies by one step of `dt` seconds; all arguments broadcast.

    `acceleration` (JKU/s^2) leaves drag out and is constant over the step. Inputs saturate at `bounds.LIMIT`,
    so infinities give no NaN; NaN gives NaN.
    """
    x, v, a, dt = bounded(position), bounded(velocity), bounded(acceleration), bounded(dt)
    keep, gain, drift, bend = factors(scheme, drag, dt)
    return Motion(x + dt * (drift * v) + dt * dt * (bend * a), keep * v + dt * gain * a)


def closed_form(
    position: npt.ArrayLike,
    velocity: npt.ArrayLike,
    acceleration: npt.ArrayLike,
    drag: npt.ArrayLike,
    seconds: npt.ArrayLike,
) -> Motion:
    """Give the true motion after `seconds`: one exact step, stable down to drag 0."""
    return step(Scheme.EXACT, position, velocity, acceleration, drag, seconds)


def steady_speed(thrust: npt.ArrayLike, drag: npt.ArrayLike) -> Float64:
    """Give the speed at which drag balances thrust, JKU/s; infinite without drag, 0 without thrust."""
    thrust, drag = np.broadcast_arrays(bounded(thrust), bounded(drag))
    limit = np.where(thrust == 0, 0.0, np.copysign(np.inf, thrust))
    with np.errstate(over="ignore", under="ignore"):
        speed: Float64 = np.divide(thrust, drag, out=limit, where=drag != 0)
    return speed


def is_stable(scheme: Scheme, drag: npt.ArrayLike, dt: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Say whether the scheme's speed stays bounded at this drag and dt: dt * drag up to its limit."""
    return np.asarray(bounded(drag) * bounded(dt) <= TRAITS[scheme].stability_limit)


def instability(scheme: Scheme, drag: float, dt: float) -> str | None:
    """Say in one sentence that and why a scheme will blow up, or None when it will not."""
    if is_stable(scheme, drag, dt):
        return None
    limit = TRAITS[scheme].stability_limit
    growth = abs(float(factors(scheme, drag, dt).keep))
    return (
        f"{scheme} blows up: dt x drag = {dt * drag:.6g} exceeds {limit:.6g}, "
        f"so each step multiplies the speed by {growth:.6g}"
    )
