"""The document's own method, automated: which drag, thrust and integrator explain a recorded motion.

One frame of any scheme is v' = R(k dt) v + dt S(k dt) C T (see `engine.integration`), with drag k and thrust
T. T is logged in the look frame and v in the world, so C is a complex number in the plane of x and y: its
size is the part of the thrust that acts (1 on a floor, the friction on ice), its angle the look's yaw, taken
as constant. k and C are found by least squares (Gauss-Newton), the intervals are from its covariance and
Student's t.

What a recording cannot tell is said: explicit and semi-implicit Euler, Verlet and the engine's clamp all give
the same velocities, and with a constant frame time every scheme explains a decay equally well, with its own
k. Then a known drag decides, which is how the research document found surfdrag 3 from Table 13.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine import integration
from jktools.engine.arrays import Float64
from jktools.engine.integration import Scheme
from jktools.trace.recording import Recording

Complex128 = npt.NDArray[np.complex128]

CONFIDENCE = 0.95
TIE = 2.0
"""Schemes whose n ln(sum of squares) lies within this of the best are as good: a likelihood ratio below e."""
LEAST_FRAMES = 4
ROUNDING = 1e-12
"""JKU/s: what float64 leaves of a perfect fit."""

_ITERATIONS = 60
_FAMILIES = (
    (Scheme.EXPLICIT_EULER, Scheme.SEMI_IMPLICIT_EULER, Scheme.ENGINE, Scheme.VERLET),
    (Scheme.VELOCITY_VERLET,),
    (Scheme.RK4,),
    (Scheme.EXACT,),
)
"""Schemes by the velocities that they give."""


class FitError(ValueError):
    """A recording that shows too little motion to fit anything."""


class Interval(NamedTuple):
    """An estimate and the ends of its 95 % confidence interval."""

    value: float
    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Say whether a value lies within the interval."""
        return self.low <= value <= self.high


class Candidate(NamedTuple):
    """What one family of schemes makes of a recording."""

    schemes: tuple[Scheme, ...]
    drag: Interval
    thrust: Interval | None
    """Part of the logged thrust that acted; None where no thrust was logged."""
    yaw: float
    """Degrees, of the look; 0 without thrust."""
    residual: float
    """Root mean square of what is left, JKU/s a frame."""


@dataclass(frozen=True, slots=True)
class Fit:
    """All candidates, best first."""

    candidates: tuple[Candidate, ...]
    best: tuple[Candidate, ...]
    """The first, and those that the recording cannot tell from it."""
    static: tuple[float, float] | None
    """Bounds of the static threshold, low <= it < high, from the stops seen; None without a stop."""
    frames: int


class _Frames(NamedTuple):
    dt: Float64
    before: Complex128
    after: Complex128
    thrust: Complex128
    position: Complex128 | None
    """Way of each frame."""


def fit(recording: Recording, *, known_drag: float | None = None) -> Fit:
    """Fit drag, thrust and integrator to a recording of one regime: one surface, one look, or free fall's plane.

    `known_drag` (1/s), from the template, ranks schemes by how near their drag comes to it instead of by what
    they leave over. Raises FitError when fewer than four moving frames remain.
    """
    frames = _moving(recording)
    if len(frames.dt) < LEAST_FRAMES:
        raise FitError(f"{len(frames.dt)} frames of motion are too few to fit, {LEAST_FRAMES} are needed")
    found = [_candidate(family, frames) for family in _FAMILIES]
    if known_drag is not None:
        ranked = sorted(found, key=lambda c: abs(c.drag.value - known_drag))
        best = ranked[:1]
    else:
        ranked = sorted(found, key=lambda c: c.residual)
        best = [c for c in ranked if _as_good(c, ranked[0], len(frames.dt))]
    chosen = tuple(_by_position(c, frames) for c in best)
    return Fit(tuple(ranked), chosen, _static_bounds(recording), len(frames.dt))


def _as_good(one: Candidate, best: Candidate, frames: int) -> bool:
    """Whether a recording cannot tell two candidates apart; below `ROUNDING` no residual means anything."""
    ratio = max(one.residual, ROUNDING) / max(best.residual, ROUNDING)
    return 4 * frames * math.log(ratio) <= TIE


def _moving(recording: Recording) -> _Frames:
    """Frames of motion: not at rest, and not the frame in which the static threshold stops the body."""
    velocity = recording.velocity[:, 0] + 1j * recording.velocity[:, 1]
    thrust = (recording.thrust[:, 0] + 1j * recording.thrust[:, 1])[1:]
    before, after = velocity[:-1], velocity[1:]
    keep = ((before != 0) | (thrust != 0)) & ~((after == 0) & (thrust == 0))
    way = None
    if recording.position is not None:
        way = np.diff(recording.position[:, 0] + 1j * recording.position[:, 1])[keep]
    return _Frames(np.diff(recording.time)[keep], before[keep], after[keep], thrust[keep], way)


def _candidate(schemes: tuple[Scheme, ...], frames: _Frames) -> Candidate:
    thrusting = bool(frames.thrust.any())
    parameters = _start(frames)[: 3 if thrusting else 1]
    for _ in range(_ITERATIONS):
        jacobian, left = _jacobian(schemes[0], frames, parameters), _left(schemes[0], frames, parameters)
        change = np.linalg.lstsq(jacobian, left, rcond=None)[0].astype(np.float64)
        parameters += change
        if np.abs(change).max() <= 1e-11 * max(1.0, float(np.abs(parameters).max())):
            break
    left = _left(schemes[0], frames, parameters)
    freedom = max(1, _informative(frames) - len(parameters))
    jacobian = _jacobian(schemes[0], frames, parameters)
    covariance = np.linalg.pinv(jacobian.T @ jacobian) * float(left @ left) / freedom
    wide = _student(freedom)
    drag = _interval(float(parameters[0]), wide * math.sqrt(covariance[0, 0]))
    residual = math.sqrt(float(left @ left) / _informative(frames))
    if not thrusting:
        return Candidate(schemes, drag, None, 0.0, residual)
    size = float(np.hypot(*parameters[1:]))
    along = parameters[1:] / size if size else np.array([1.0, 0.0])
    spread = wide * math.sqrt(max(0.0, float(along @ covariance[1:, 1:] @ along)))
    yaw = math.degrees(math.atan2(parameters[2], parameters[1]))
    return Candidate(schemes, drag, _interval(size, spread), yaw, residual)


def _start(frames: _Frames) -> Float64:
    """Euler's own answer, where the equation is linear: (v' - v) / dt = -k v + C T."""
    slope = (frames.after - frames.before) / frames.dt
    columns = (-frames.before, frames.thrust, 1j * frames.thrust)
    matrix = np.stack([_parts(column) for column in columns], axis=1)
    return np.linalg.lstsq(matrix, _parts(slope), rcond=None)[0].astype(np.float64)


def _parts(values: Complex128) -> Float64:
    return np.concatenate([values.real, values.imag])


def _informative(frames: _Frames) -> int:
    """Readings that could be off: a walk along an axis has zeros across it that say nothing of the noise."""
    return int(np.count_nonzero((_parts(frames.before) != 0) | (_parts(frames.after) != 0)))


def _predicted(scheme: Scheme, frames: _Frames, parameters: Float64) -> Complex128:
    keep, gain, _, _ = integration.factors(scheme, parameters[0], frames.dt)
    part = complex(parameters[1], parameters[2]) if len(parameters) == 3 else 0.0
    return keep * frames.before + frames.dt * gain * part * frames.thrust


def _left(scheme: Scheme, frames: _Frames, parameters: Float64) -> Float64:
    return _parts(frames.after - _predicted(scheme, frames, parameters))


def _jacobian(scheme: Scheme, frames: _Frames, parameters: Float64) -> Float64:
    """Derivatives of the prediction: by k as a difference, by C as it is."""
    h = 1e-6 * max(1.0, abs(float(parameters[0])))
    shift = np.zeros_like(parameters)
    shift[0] = h
    by_drag = _predicted(scheme, frames, parameters + shift) - _predicted(scheme, frames, parameters - shift)
    columns = [_parts(by_drag / (2 * h))]
    if len(parameters) == 3:
        push = frames.dt * integration.factors(scheme, parameters[0], frames.dt).gain * frames.thrust
        columns += [_parts(push), _parts(1j * push)]
    return np.stack(columns, axis=1)


def _student(freedom: int) -> float:
    """Two-sided Student quantile, by its expansion about the normal one: within 1 % from 4 degrees of freedom."""
    z = NormalDist().inv_cdf((1 + CONFIDENCE) / 2)
    terms = (
        (z**3 + z) / 4,
        (5 * z**5 + 16 * z**3 + 3 * z) / 96,
        (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384,
    )
    return z + math.fsum(term / freedom**power for power, term in enumerate(terms, start=1))


def _interval(value: float, half: float) -> Interval:
    return Interval(value, value - half, value + half)


def _by_position(candidate: Candidate, frames: _Frames) -> Candidate:
    """Leave only the schemes whose way of a frame fits the logged positions best, where there are any."""
    if frames.position is None or len(candidate.schemes) == 1:
        return candidate
    part = complex(0.0)
    if candidate.thrust is not None:
        part = candidate.thrust.value * np.exp(1j * np.deg2rad(candidate.yaw))
    misses = {}
    for scheme in candidate.schemes:
        _, _, drift, bend = integration.factors(scheme, candidate.drag.value, frames.dt)
        way = frames.dt * drift * frames.before + frames.dt**2 * bend * part * frames.thrust
        misses[scheme] = float(np.abs(way - frames.position).max())
    least = min(misses.values())
    # Schemes that are one and the same differ by rounding alone, the others by a frame's change of velocity.
    kept = tuple(scheme for scheme, miss in misses.items() if miss <= least * (1 + 1e-6) + 1e-12)
    return candidate._replace(schemes=kept)


def _static_bounds(recording: Recording) -> tuple[float, float] | None:
    """Bracket the threshold: a stop from speed v shows static >= v, a speed that coasted on static < v."""
    speed: Float64 = np.hypot(recording.velocity[:, 0], recording.velocity[:, 1])
    before, after = speed[:-1], speed[1:]
    coasting = (np.abs(recording.thrust).max(axis=1)[1:] == 0) & (before > 0)
    stops = before[coasting & (after == 0)]
    if not len(stops):
        return None
    low = float(stops.max())
    went_on = before[coasting & (after > 0) & (before > low)]
    return low, float(went_on.min()) if len(went_on) else math.inf
