"""What a particle template says: the parameters that a thing of type particle reads, and its typeflags."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from types import MappingProxyType


class ParticleFlag(enum.IntFlag):
    """Name the typeflags of a particle (research document, "Particles"; `sithParticle.c`)."""

    EXPAND = 0x01
    UNUSED_2 = 0x02
    """No effect seen, and no code; JKSpecs calls it cel animation."""
    RANDOM_CEL = 0x04
    FADE = 0x08
    FULL_BRIGHT = 0x10
    """No effect seen in the document; light mode 0 instead of 2 in the decompiled engine."""
    CYCLE_CELS = 0x20
    UNUSED_40 = 0x40


FULL_BRIGHT_MODE, LIT_MODE = 0, 2
CASTS_LIGHT = False
"""No particle lights the level, whatever JKSpecs says of 0x10 (research document, "Unknowns")."""

MAX_COUNT = 256
"""Entries of the buffer in which the engine draws a cloud."""

LONGEST_TIMER_MS = 2**31 - 1

MATERIAL_CELS = MappingProxyType(
    {
        "00gsmoke.mat": 4,
        "embers.mat": 7,
        "00teleport.mat": 5,
        "00red.mat": 1,
        "00ramp1.mat": 5,
        "00ramp2.mat": 10,
        "sparky.mat": 4,
        "00ramp4.mat": 5,
        "dusty.mat": 5,
        "dstructparts.mat": 6,
        "00explosion.mat": 6,
    }
)
"""Cels of the game's own particle materials, for lack of its packs (research document, Illustration 35)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParticleTemplate:
    """Hold the parameters of a particle thing under the names a template gives them.

    `timer` in seconds, `range`, `minsize` and `elementsize` in JKU, `pitchrange` and `yawrange` in degrees to
    each side, `rate` in tenths of particles a step of the fade, `maxthrust` in spawn radii a second; `cels`
    is the number of cels of the material. Any number is taken; what is outside its range behaves as in the
    engine.
    """

    count: int = 0
    timer: float = 0.0
    typeflags: int = 0
    range: float = 0.0
    minsize: float = 0.0
    rate: float = 0.0
    maxthrust: float = 0.0
    elementsize: float = 0.0
    pitchrange: float = 0.0
    yawrange: float = 0.0
    cels: int = 1

    def has(self, flag: ParticleFlag) -> bool:
        """Tell whether a typeflag is set."""
        return bool(self.typeflags & flag)

    @property
    def spawned(self) -> int:
        """Particles that are created: the count, from 0 to what the engine can draw."""
        return min(max(self.count, 0), MAX_COUNT)

    @property
    def timer_ms(self) -> int:
        """Life before the end or the fade, in whole milliseconds; 0 (negative and NaN too) is for ever."""
        if not self.timer > 0.0:
            return 0
        return int(min(self.timer * 1000.0 + 1e-6, float(LONGEST_TIMER_MS)))

    @property
    def lost_a_step(self) -> int:
        """Particles that each step of the fade removes: a tenth of the rate, cut, at least 1.

        `sithParticle_DestroyParticle` in the decompiled engine; it explains the document's "lower limit to
        the rate" (0 as 16, 128 faster).
        """
        tenth = self.rate * 0.1
        return max(1, math.floor(min(tenth, float(MAX_COUNT)))) if tenth > 0.0 else 1

    @property
    def light_mode(self) -> int:
        """The mode in which the cloud is lit: 0 fully bright with typeflag 0x10, else 2."""
        return FULL_BRIGHT_MODE if self.has(ParticleFlag.FULL_BRIGHT) else LIT_MODE
