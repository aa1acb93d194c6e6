"""A colour effect: what a COG asks for with NewColorEffect, and how up to 32 of them combine."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice

from jktools.engine.profile import Engine

NONE: tuple[float, float, float] = (0.0, 0.0, 0.0)

MAX_EFFECTS = 32
"""Requests that the engine holds at once; it refuses a further one (`stdPalEffects_NewRequest`)."""


@dataclass(frozen=True, slots=True)
class ColourEffect:
    """Hold the ten numbers of NewColorEffect, as the COG gives them.

    Research document, "COG ColorEffect": `filters` are switches, `tint` has the range 0..2, `add` 0..290,
    `brightness` 0..1. Nothing is refused here: what a number outside its range does is the renderer's
    business.
    """

    filters: tuple[float, float, float] = NONE
    tint: tuple[float, float, float] = NONE
    add: tuple[float, float, float] = NONE
    brightness: float = 1.0

    @classmethod
    def from_call(cls, arguments: Iterable[float]) -> ColourEffect:
        """Take the ten arguments of `newColorEffect(...)` in order. Raises ValueError for another number."""
        numbers = [float(argument) for argument in arguments]
        if len(numbers) != 10:
            raise ValueError(f"newColorEffect takes 10 numbers, got {len(numbers)}")
        r, g, b, tint_r, tint_g, tint_b, add_r, add_g, add_b, brightness = numbers
        return cls((r, g, b), (tint_r, tint_g, tint_b), (add_r, add_g, add_b), brightness)


def filter_on(value: float, engine: Engine = Engine.RESEARCH) -> bool:
    """Tell whether a filter channel is on.

    Research document, "Filter": any value below 0 and any value of 1 or more. The decompiled engine pops an
    integer (`sithCogFunction_NewColorEffect`), so there -0.5 is 0 and off. NaN is off.
    """
    if engine is Engine.RESEARCH:
        return value < 0.0 or value >= 1.0
    return abs(value) >= 1.0


def combine(effects: Iterable[ColourEffect], engine: Engine = Engine.RESEARCH) -> ColourEffect:
    """Merge effects into the one that is drawn: filters or, tints and adds sum, the least brightness counts.

    Source: `stdPalEffects_GatherEffects` in the decompiled engine; the research document tried one effect at
    a time. Effects beyond the first 32 do not exist for the engine. A brightness above 1 or NaN never wins.
    """
    held = list(islice(effects, MAX_EFFECTS))
    r, g, b = (float(any(filter_on(effect.filters[c], engine) for effect in held)) for c in range(3))
    tint_r, tint_g, tint_b = (_total(effect.tint[c] for effect in held) for c in range(3))
    add_r, add_g, add_b = (_total(whole(effect.add[c]) for effect in held) for c in range(3))
    brightness = min([1.0, *(effect.brightness for effect in held)])  # NaN is never the less
    return ColourEffect((r, g, b), (tint_r, tint_g, tint_b), (add_r, add_g, add_b), brightness)


def whole(value: float) -> float:
    """Cut a number to the integer that the COG machine pops from it; NaN is 0."""
    if math.isnan(value):
        return 0.0
    return float(math.trunc(value)) if math.isfinite(value) else value


def _total(values: Iterable[float]) -> float:
    return sum((value for value in values if not math.isnan(value)), start=0.0)
