"""Jumping and landing: speed, apex, time, reach and what the fall costs.

The research document does not treat them: sithPlayerActions_JumpWithVel and sithCollision_FallHurt in the
decompiled engine, with the flight from `integration.closed_form`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.body import Body
from jktools.engine.bounds import bounded
from jktools.engine.flags import SurfaceFlag
from jktools.engine.gravity import WORLD_GRAVITY
from jktools.engine.integration import closed_form

CROUCHED_JUMP_FACTOR = 0.7
SAFE_LANDING_SPEED = 2.5
FALL_DAMAGE_FACTOR = 45.0
LEAST_FALL_DAMAGE = 1.0

_BISECTIONS = 200


class Apex(NamedTuple):
    """The top of a jump: height over the start (JKU) and seconds after it."""

    height: Float64
    seconds: Float64


def jump_speed(body: Body, *, crouching: bool = False, factor: float = 1.0) -> float:
    """Give the speed along z, JKU/s, that a jump adds: jumpspeed * factor, 0.7 of it from a crouch."""
    return body.jumpspeed * factor * (CROUCHED_JUMP_FACTOR if crouching else 1.0)


@np.errstate(under="ignore")
def apex(speed: npt.ArrayLike, airdrag: npt.ArrayLike = 0.0, gravity: npt.ArrayLike = WORLD_GRAVITY) -> Apex:
    """Find the top of a jump that starts upwards at `speed` (JKU/s) under gravity (> 0) and air drag (1/s).

    Time ln(1 + k v / g) / k, which is v / g without drag.
    """
    v, k, g = np.broadcast_arrays(bounded(speed), bounded(airdrag), bounded(gravity))
    ratio = k * v / g
    # Below this ratio ln(1 + r) / r differs from its limit 1 by less than one rounding.
    direct = ratio > 1e-16
    safe = np.where(direct, k, 1.0)
    seconds = np.where(direct, np.log1p(np.where(direct, ratio, 0.0)) / safe, v / g)
    return Apex(closed_form(0.0, v, -g, k, seconds).position, seconds)


def flight_seconds(
    speed: npt.ArrayLike,
    drop: npt.ArrayLike = 0.0,
    airdrag: npt.ArrayLike = 0.0,
    gravity: npt.ArrayLike = WORLD_GRAVITY,
) -> Float64:
    """Find when a jump comes down to `drop` JKU below its start (negative: above); NaN where it never gets so high.

    Found by bisection of the closed form, to its last bit.
    """
    v, d, k, g = np.broadcast_arrays(bounded(speed), bounded(drop), bounded(airdrag), bounded(gravity))
    top = apex(v, k, g)
    low, high = top.seconds, _after_landing(v, d, k, g)
    for _ in range(_BISECTIONS):
        middle = low + (high - low) / 2
        if ((middle == low) | (middle == high)).all():
            break
        above = closed_form(0.0, v, -g, k, middle).position > -d
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    return np.where(top.height < -d, np.nan, high)


def _after_landing(v: Float64, d: Float64, k: Float64, g: Float64) -> Float64:
    """A time by which the body is below the landing: double one until the closed form says so."""
    seconds = np.maximum(1e-3, 4 * v / g)
    for _ in range(_BISECTIONS):
        above = closed_form(0.0, v, -g, k, seconds).position > -d
        if not above.any():
            break
        seconds = np.where(above, 2 * seconds, seconds)
    return seconds


def reach(
    body: Body,
    run_up: npt.ArrayLike,
    drop: npt.ArrayLike = 0.0,
    *,
    steering: npt.ArrayLike = 0.0,
    crouching: bool = False,
    gravity: npt.ArrayLike = WORLD_GRAVITY,
) -> Float64:
    """Find how far, JKU, a jump carries over level ground or onto one `drop` JKU lower; NaN where it is too high.

    `run_up` is the horizontal speed at the start, `steering` the horizontal acceleration in the air (a held
    forward key gives 0.3 maxthrust).
    """
    seconds = flight_seconds(jump_speed(body, crouching=crouching), drop, body.airdrag, gravity)
    return closed_form(0.0, run_up, steering, body.airdrag, seconds).position


@np.errstate(under="ignore")
def landing_speed(
    drop: npt.ArrayLike,
    speed: npt.ArrayLike = 0.0,
    airdrag: npt.ArrayLike = 0.0,
    gravity: npt.ArrayLike = WORLD_GRAVITY,
) -> Float64:
    """Give the downward speed, JKU/s, on landing `drop` JKU below a start with upward `speed`; NaN if never there."""
    return -closed_form(0.0, speed, -bounded(gravity), airdrag, flight_seconds(speed, drop, airdrag, gravity)).velocity


@np.errstate(under="ignore")
def fall_damage(speed: npt.ArrayLike, surface: int = 0) -> Float64:
    """Give the damage of landing at `speed` (JKU/s, into the floor): (speed - 2.5)^2 * 45 beyond 2.5, else 0.

    None at or below 1 point (sithCollision_FallHurt), none on a surface flagged against it.
    """
    excess = np.maximum(bounded(speed) - SAFE_LANDING_SPEED, 0.0)
    damage = excess * excess * FALL_DAMAGE_FACTOR
    return np.where((damage > LEAST_FALL_DAMAGE) & (not surface & SurfaceFlag.NO_FALL_DAMAGE), damage, 0.0)
