"""A cloud of particles over time: places, cels and sizes, from its creation to the end of its thing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Bool, Float64, Int32
from jktools.engine.particle_spawn import RandomNumbers, Stream, spawn
from jktools.engine.particle_template import ParticleFlag, ParticleTemplate
from jktools.engine.profile import Engine

LEAST_SCALE = 0.01
"""Below this share of its spawn size a shrinking cloud is set back to it (`sithParticle_Update`)."""

LONGEST_FADE_STEP_MS = 100


@dataclass(frozen=True, slots=True)
class ParticleTrack:
    """Hold a simulated cloud: t frames of n particles.

    `positions` are local to the thing: see `to_world`. A particle that is gone has size 0; its place and
    cel then mean nothing.
    """

    times: Float64
    """(t,) seconds since the creation."""
    positions: Float64
    """(t, n, 3) JKU."""
    cels: Int32
    """(t, n)."""
    sizes: Float64
    """(t, n) side of the drawn square, JKU."""
    alive: Bool
    """(t, n)."""

    @property
    def died_at(self) -> float | None:
        """When the thing was removed, which is when its last particle was gone; None if it lives on."""
        gone = np.flatnonzero(~self.alive.any(axis=1))
        return float(self.times[gone[0]]) if len(gone) else None


@np.errstate(under="ignore")  # what is too small for a float is 0
def simulate(
    template: ParticleTemplate,
    seed: int = 0,
    *,
    seconds: float = 10.0,
    step_ms: int = 20,
    destroyed_at: float | None = None,
    engine: Engine = Engine.RESEARCH,
) -> ParticleTrack:
    """Run a cloud for some seconds in frames of whole milliseconds; the same arguments give the same bits.

    A longer run begins with the shorter one. `destroyed_at` removes the thing at that second. Raises
    ValueError for a negative or infinite time, a step below 1 ms or a negative seed.
    """
    if not 0.0 <= seconds < float("inf") or step_ms < 1 or seed < 0:
        raise ValueError(f"cannot run for {seconds} s in steps of {step_ms} ms with seed {seed}")
    frames = int(seconds * 1000.0 / step_ms + 1e-9) + 1
    times = np.arange(frames) * step_ms / 1000.0
    places, first = spawn(template, seed, engine)
    count, left_ms = _survivors(template, frames, step_ms, RandomNumbers(seed, Stream.FADE))
    if destroyed_at is not None:
        count[times >= destroyed_at] = 0
    alive = np.arange(template.spawned) < count[:, None]
    cels = _cels(template, first, left_ms, step_ms, RandomNumbers(seed, Stream.CELS), engine)
    scale = scales(template, frames, step_ms)
    sizes = np.where(alive, template.elementsize, 0.0)
    return ParticleTrack(times, places * scale[:, None, None], cels, sizes, alive)


@np.errstate(under="ignore")  # what is too small for a float is 0
def to_world(positions: Float64, origin: npt.ArrayLike, orientation: npt.ArrayLike) -> Float64:
    """Place local positions (..., 3) in the level: the cloud follows its thing.

    Source: research document, "Coordinate space". `origin` is the thing's position, (3,) or broadcast with
    one a frame; `orientation` is (3, 3), its columns the right, look and up vectors of the thing.
    """
    right, look, up = np.asarray(orientation, np.float64).T
    x, y, z = positions[..., :1], positions[..., 1:2], positions[..., 2:]
    # Not a matrix product: those of numpy's BLAS differ in the last bit between processors.
    return np.asarray(x * right + y * look + z * up + np.asarray(origin, np.float64))


@np.errstate(under="ignore")  # what is too small for a float is 0
def scales(template: ParticleTemplate, frames: int, step_ms: int) -> Float64:
    """Give the size of the cloud in each frame, in spawn sizes: (t,) float64.

    Typeflag 0x1: 1 + maxthrust * t, each particle straight away from the centre. The document saw the
    direction and that maxthrust governs the speed, not its unit: that is `sithParticle_Update` in the
    decompiled engine.
    """
    size = np.ones(frames)
    if template.has(ParticleFlag.EXPAND):
        for frame in range(1, frames):
            before = size[frame - 1]
            grown = before + template.maxthrust * (step_ms / 1000.0)
            size[frame] = LEAST_SCALE if before < LEAST_SCALE else grown
    return size


def _survivors(
    template: ParticleTemplate, frames: int, step_ms: int, random: RandomNumbers
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Count the particles of each frame, and the milliseconds then left to the next event.

    Without typeflag 0x8 all vanish when the timer ends; with it each event removes the last few and sets the
    next 1..100 ms ahead (`sithParticle_DestroyParticle`, `sithThing_TickAll` in the decompiled engine).
    """
    count, left = np.zeros(frames, np.intp), np.zeros(frames, np.intp)
    living, to_event = template.spawned, template.timer_ms
    for frame in range(frames):
        if frame and to_event > step_ms:
            to_event -= step_ms
        elif frame and to_event:
            fading = template.has(ParticleFlag.FADE) and template.lost_a_step < living
            living = living - template.lost_a_step if fading else 0
            to_event = int(random.draw(1)[0] * LONGEST_FADE_STEP_MS) + 1
        count[frame], left[frame] = living, to_event
        if not living:
            break
    return count, left


def _cels(
    template: ParticleTemplate,
    first: Int32,
    left_ms: npt.NDArray[np.intp],
    step_ms: int,
    random: RandomNumbers,
    engine: Engine,
) -> Int32:
    """Give the cel of each particle in each frame.

    Typeflag 0x20, research document ("Cel Animation"): evenly, the last cel as the timer ends, then it stays;
    without a timer no cel changes. Decompiled engine: in each frame a particle advances with the chance cels
    left * elapsed / remaining * step, so it is about there when the timer ends, and at once without a timer.
    """
    frames, last = len(left_ms), template.cels - 1
    timer = template.timer_ms
    endless = engine is Engine.RESEARCH and not timer
    if not template.has(ParticleFlag.CYCLE_CELS) or last < 1 or endless:
        return np.repeat(first[None], frames, axis=0)
    if engine is Engine.OPENJKDF2:
        return _cels_by_chance(template, first, left_ms, step_ms, random)
    elapsed = np.minimum(np.arange(frames, dtype=np.int64) * step_ms, timer)[:, None]
    return (first + (last - first) * elapsed // timer).astype(np.int32)


def _cels_by_chance(
    template: ParticleTemplate,
    first: Int32,
    left_ms: npt.NDArray[np.intp],
    step_ms: int,
    random: RandomNumbers,
) -> Int32:
    drawn = random.draw(len(left_ms), len(first))
    cels = np.empty(drawn.shape, np.int32)
    # Without a random start the engine counts from -1, which it draws as cel 0.
    now = first.copy() if template.has(ParticleFlag.RANDOM_CEL) else np.full_like(first, -1)
    for frame, left in enumerate(left_ms.tolist()):
        elapsed_ms = frame * step_ms
        share = min(elapsed_ms * step_ms / (left * 1000.0), 1.0) if left else 1.0
        if frame:
            now += (template.cels - 1 - now) * share > drawn[frame]
        cels[frame] = now
    return np.maximum(cels, 0)
