"""The tints that the game itself puts on the screen: the sector's, and the flashes of damage and pick-ups.

Source: `sithPlayer_Update`, `sithPlayer_AddDynamicTint`, `sithPlayer_AddDyamicAdd`,
`sithPlayer_SetScreenTint` in the decompiled engine. The research document only says that a dynamic tint
"dissipates rapidly": both profiles agree.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from jktools.engine.colour_effect import NONE, ColourEffect, whole

TINT_DECAY = 0.4
"""Tint lost a second."""
ADD_DECAY = 256.0
"""Add lost a second."""
MAX_DYNAMIC_ADD = 255.0
DAMAGE_TINT = 0.04
"""Red tint for each point of damage to the local player (`sithActor_DamageActor`)."""


@dataclass(frozen=True, slots=True)
class Flash:
    """Hold the dynamic tint (0..1 a channel) and add (at most 255) that are on the screen now."""

    tint: tuple[float, float, float] = NONE
    add: tuple[float, float, float] = NONE

    @property
    def effect(self) -> ColourEffect:
        """Give it as the effect that joins the others."""
        return ColourEffect(tint=self.tint, add=self.add)


def sector_effect(tint: tuple[float, float, float]) -> ColourEffect:
    """Give the effect of the sector that the camera is in; each channel of its `tint` is clamped to 0..1."""
    red, green, blue = (_clamp(value, 1.0) for value in tint)
    return ColourEffect(tint=(red, green, blue))


def with_tint(flash: Flash, tint: tuple[float, float, float]) -> Flash:
    """Add a dynamic tint (COG AddDynamicTint), clamped to 0..1 a channel."""
    red, green, blue = (_clamp(old + new, 1.0) for old, new in zip(flash.tint, tint, strict=True))
    return Flash((red, green, blue), flash.add)


def with_damage(flash: Flash, damage: float) -> Flash:
    """Add the red of `damage` points."""
    return with_tint(flash, (damage * DAMAGE_TINT, 0.0, 0.0))


def with_add(flash: Flash, add: tuple[float, float, float]) -> Flash:
    """Add a dynamic add (COG AddDynamicAdd): whole, at most 255; a negative one lasts until the decay."""
    red, green, blue = (min(old + whole(new), MAX_DYNAMIC_ADD) for old, new in zip(flash.add, add, strict=True))
    return Flash(flash.tint, (red, green, blue))


def decayed(flash: Flash, seconds: float) -> Flash:
    """Give what one frame of `seconds` leaves: the tint loses 0.4 a second, the add 256, rounded."""
    lost = whole(seconds * ADD_DECAY + 0.5)
    red, green, blue = (_clamp(value - TINT_DECAY * seconds, 1.0) if value else value for value in flash.tint)
    tint = (red, green, blue)
    red, green, blue = (_clamp(value - lost, MAX_DYNAMIC_ADD) if value else value for value in flash.add)
    return Flash(tint, (red, green, blue))


def _clamp(value: float, top: float) -> float:
    """Clamp to 0..top; NaN is 0."""
    return float(np.clip(value, 0.0, top)) if value == value else 0.0
