"""What an integrator's accuracy costs, on three motions of walkplayer that have a closed form."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from jktools.engine import drag
from jktools.engine.arrays import Float64
from jktools.engine.body import WALKPLAYER
from jktools.engine.gravity import WORLD_GRAVITY
from jktools.engine.integration import TRAITS, Motion, Scheme, closed_form, step

FRAME_RATES = (10, 15, 20, 30, 50, 75, 100, 200, 500, 1000)
STEADY = WALKPLAYER.maxthrust / WALKPLAYER.surfdrag


class Case(NamedTuple):
    """A motion along one axis: seconds, JKU."""

    name: str
    seconds: float
    velocity: float
    acceleration: float
    drag: float
    static: float
    true: Callable[[Float64], Float64]
    """Position by time."""


def _walk(time: Float64) -> Float64:
    return closed_form(0.0, 0.0, WALKPLAYER.maxthrust, WALKPLAYER.surfdrag, time).position


def _stop(time: Float64) -> Float64:
    until = math.log(STEADY / WALKPLAYER.staticdrag) / WALKPLAYER.surfdrag
    return closed_form(0.0, STEADY, 0.0, WALKPLAYER.surfdrag, np.minimum(time, until)).position


def _fall(time: Float64) -> Float64:
    return closed_form(0.0, 0.0, -WORLD_GRAVITY, WALKPLAYER.airdrag, time).position


CASES = (
    Case("walk", 2.0, 0.0, WALKPLAYER.maxthrust, WALKPLAYER.surfdrag, 0.0, _walk),
    Case("stop", 1.0, STEADY, 0.0, WALKPLAYER.surfdrag, WALKPLAYER.staticdrag, _stop),
    Case("fall", 1.0, 0.0, -WORLD_GRAVITY, WALKPLAYER.airdrag, 0.0, _fall),
)


class Point(NamedTuple):
    """One integrator at one frame rate: evaluations a simulated second, and the worst position error (JKU)."""

    scheme: Scheme
    rate: int
    cost: float
    error: float


def march(scheme: Scheme, case: Case, rate: int) -> Float64:
    """Step a case through its seconds; gives the position of every frame, `(n + 1,)` JKU."""
    motion = Motion(np.float64(0.0), np.float64(case.velocity))
    rows = [float(motion.position)]
    for _ in range(round(case.seconds * rate)):
        if drag.stops(motion.velocity[None], case.static):
            motion = Motion(motion.position, np.float64(0.0))
        motion = step(scheme, *motion, case.acceleration, case.drag, 1 / rate)
        rows.append(float(motion.position))
    return np.array(rows)


def measure(scheme: Scheme, case: Case, rate: int) -> Point:
    """Compare every frame with the closed form. The closed form itself counts as one evaluation, for its exp."""
    position = march(scheme, case, rate)
    time = np.arange(len(position)) / rate
    error = float(np.abs(position - case.true(time)).max())
    return Point(scheme, rate, max(1, TRAITS[scheme].evaluations) * rate, error)


def front(points: Sequence[Point]) -> list[Point]:
    """Keep the points that no other beats in both cost and error, cheapest first."""
    kept: list[Point] = []
    for point in sorted(points, key=lambda p: (p.cost, p.error)):
        if not kept or point.error < kept[-1].error:
            kept.append(point)
    return kept
