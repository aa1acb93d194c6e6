"""Where the particles of a cloud are created, and with which cel; and the random numbers that decide it."""

from __future__ import annotations

import enum

import numpy as np

from jktools.engine.arrays import Float64, Int32
from jktools.engine.degrees import sine_cosine
from jktools.engine.particle_template import ParticleFlag, ParticleTemplate
from jktools.engine.profile import Engine

FULL_CIRCLE = {Engine.RESEARCH: 180.0, Engine.OPENJKDF2: 360.0}
"""Degrees to each side that a pitchrange or yawrange of 0 stands for: the same places, by other numbers."""


class Stream(enum.IntEnum):
    """Name the independent random streams of one cloud, so that a longer run begins as a shorter one did."""

    SPAWN = 0
    FADE = 1
    CELS = 2


class RandomNumbers:
    """Draw numbers in 0 <= x < 1 that are the same on every machine and with every numpy.

    numpy promises for ever the raw 64 bit output of a bit generator, but not the floats of `Generator`: so
    PCG64's raw words are taken and their top 53 bits divided here. The engine's own generator is not
    modelled.
    """

    def __init__(self, seed: int, stream: Stream) -> None:
        """Start a stream of the seed (an integer from 0)."""
        self._bits = np.random.PCG64(np.random.SeedSequence(entropy=seed, spawn_key=(int(stream),)))

    def draw(self, *shape: int) -> Float64:
        """Give an array of fresh numbers."""
        raw = np.asarray(self._bits.random_raw(int(np.prod(shape))), np.uint64)
        return np.asarray((raw >> np.uint64(11)).astype(np.float64) * 2.0**-53).reshape(shape)


@np.errstate(under="ignore")  # what is too small for a float is 0
def spawn(template: ParticleTemplate, seed: int, engine: Engine = Engine.RESEARCH) -> tuple[Float64, Int32]:
    """Create a cloud: positions (n, 3) float64, JKU, about the thing's own position, and cels (n,) int32.

    Research document, "Creation"; `sithParticle_Initalize` in the decompiled engine: pitch and yaw uniform to
    each side of the thing's forward axis, the radius uniform from minsize to range, cel 0 or (typeflag 0x4)
    any. Where minsize exceeds range the document's words still hold; the engine puts all at minsize. NaN in,
    NaN out.
    """
    drawn = RandomNumbers(seed, Stream.SPAWN).draw(template.spawned, 4)
    pitch = (2.0 * drawn[:, 0] - 1.0) * (template.pitchrange or FULL_CIRCLE[engine])
    yaw = (2.0 * drawn[:, 1] - 1.0) * (template.yawrange or FULL_CIRCLE[engine])
    width = template.range - template.minsize
    if engine is Engine.OPENJKDF2 and width <= 0.0:
        width = 0.0
    radius = template.minsize + drawn[:, 2] * width
    (sin_p, cos_p), (sin_y, cos_y) = sine_cosine(pitch), sine_cosine(yaw)
    positions = np.stack([-sin_y * cos_p, cos_y * cos_p, sin_p], axis=1) * radius[:, None]
    return positions, _first_cels(template, drawn[:, 3])


def _first_cels(template: ParticleTemplate, drawn: Float64) -> Int32:
    if template.cels <= 1 or not template.has(ParticleFlag.RANDOM_CEL):
        return np.zeros(len(drawn), np.int32)
    return np.floor(drawn * template.cels).astype(np.int32)
