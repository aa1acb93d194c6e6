"""What a colour effect does to colours and images, in the orders of the document and of both renderers.

Every renderer treats each channel by itself, so an effect is a table of 256 levels by three channels: it is
computed once, and a palette, a colour or a whole image is looked up in it.
"""

from __future__ import annotations

import enum

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64, UInt8
from jktools.engine.colour_effect import ColourEffect, filter_on, whole
from jktools.engine.framebuffer import Depth, quantise
from jktools.engine.profile import Engine

MAX_TINT = 2.0
"""Research document, "Tint": the response ends at 0 and at 2."""

FULL_ADD = 283.0
"""The add at which the screen is saturated, in the unit of NewColorEffect.

The research document calls 290 the maximum, from a plot. Its own three samples (220 on black, 145 on white,
145 on quarter white) are met to the last bit by any value in (280.0, 285.7] and by no other: this is the
middle. With 290 all three miss by one step of the 565 screen; 290 is fully saturated either way.
"""

SOFTWARE_FILTER_SHARE = 0.25
"""What a stopped channel keeps in the software palette (`stdPalEffects_UpdatePalette`: `>> 2`)."""


class Renderer(enum.StrEnum):
    """Name the decompiled engine's ways to draw; the research document measured one, not knowing which."""

    HARDWARE = "hardware"
    SOFTWARE = "software"


@np.errstate(under="ignore")  # what is too small for a float is 0
def lookup_table(
    effect: ColourEffect,
    engine: Engine = Engine.RESEARCH,
    renderer: Renderer = Renderer.HARDWARE,
    depth: Depth = Depth.RGB565,
) -> UInt8:
    """Give what each level of each channel becomes: (256, 3) uint8.

    | profile, renderer | order |
    |---|---|
    | research, either | filter, brightness, tint, clamp, then add as an overlay |
    | openjkdf2, hardware | filter, tint, fade and clamp on the light, times the texel, plus add |
    | openjkdf2, software | filter to a quarter, tint, clamp, add, clamp, fade |

    Sources: research document, "Color Effects"; `rdCache_SendFaceListToHardware` and
    `stdPalEffects_UpdatePalette` in the decompiled engine.
    A NaN tint or add counts as 0, a NaN brightness as 1.
    """
    levels = np.arange(256.0)[:, None]
    if engine is Engine.RESEARCH:
        drawn = _as_measured(levels, effect)
    elif renderer is Renderer.HARDWARE:
        drawn = _by_hardware(levels, effect)
    else:
        drawn = _by_software(levels, effect)
    return quantise(np.broadcast_to(drawn, (256, 3)), depth)


def apply(
    colours: npt.ArrayLike,
    effect: ColourEffect,
    engine: Engine = Engine.RESEARCH,
    renderer: Renderer = Renderer.HARDWARE,
    depth: Depth = Depth.RGB565,
) -> UInt8:
    """Draw colours, a palette or an image under an effect.

    `colours` is (..., 3) uint8 and so is the answer. Raises ValueError for another shape or for numbers that
    are not whole and in 0..255.
    """
    return look_up(lookup_table(effect, engine, renderer, depth), levels_of(colours))


def look_up(table: UInt8, colours: UInt8) -> UInt8:
    """Replace each channel of (..., 3) uint8 colours by its entry in a (256, 3) table."""
    drawn = np.empty_like(colours)
    for channel in range(3):
        drawn[..., channel] = np.take(table[:, channel], colours[..., channel])
    return drawn


def levels_of(colours: npt.ArrayLike) -> UInt8:
    """Check that an array holds 8 bit colours: (..., 3) uint8. Raises ValueError otherwise."""
    array = np.asarray(colours)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"colours have three channels last, got shape {array.shape}")
    if array.dtype == np.uint8:
        return array
    if array.dtype.kind not in "iu" or (array.size and (array.min() < 0 or array.max() > 255)):
        raise ValueError("colours are whole numbers from 0 to 255")
    return array.astype(np.uint8)


def tint_factors(tint: tuple[float, float, float]) -> Float64:
    """Give what each channel is multiplied by: 1 + own tint - half of the two others, (3,) float64.

    The research document has no formula; all its samples fit this one, which is `stdPalEffects_ApplyTint` and
    `rdCache_SendFaceListToHardware` in the decompiled engine. An equal tint on all channels gives 1.
    """
    own = np.nan_to_num(np.array(tint, np.float64), nan=0.0)
    return np.asarray(1.0 + own - (own[[1, 2, 0]] + own[[2, 0, 1]]) * 0.5)


def filter_shares(effect: ColourEffect, engine: Engine, stopped: float) -> Float64:
    """Give each channel's share under the filter: 1, or `stopped` where only other channels are on."""
    on = [filter_on(value, engine) for value in effect.filters]
    return np.array([1.0 if passes or not any(on) else stopped for passes in on])


@np.errstate(under="ignore")  # what is too small for a float is 0
def vertex_colour(
    light: npt.ArrayLike, effect: ColourEffect, colormap_tint: tuple[float, float, float] = (1.0, 1.0, 1.0)
) -> Float64:
    """Give the colour that lights a vertex in the hardware renderer: (..., 3) whole numbers 0..255.

    `light` is (...) in 0..1; `colormap_tint` is the tint of the sector's CMP. Texels are multiplied by this
    over 255, so a tint brightens only what is not fully lit. Each step cuts to whole numbers as
    `rdCache_SendFaceListToHardware` in the decompiled engine does. The one clamp comes last: a brightness
    below 0 shows what a tint took below 0. NaN light is 0.
    """
    lit = np.clip(np.nan_to_num(np.asarray(light, np.float64), nan=0.0), 0.0, 1.0)
    colour = np.trunc(np.trunc(lit * 255.0)[..., None] * np.array(colormap_tint))
    colour = colour * filter_shares(effect, Engine.OPENJKDF2, stopped=0.0)
    if any(tint > 0.0 for tint in effect.tint):
        colour = colour + np.trunc(colour * (tint_factors(effect.tint) - 1.0))
    if effect.brightness < 1.0:
        colour = np.trunc(colour * effect.brightness)
    return np.asarray(np.clip(colour, 0.0, 255.0))


def add_shares(add: tuple[float, float, float]) -> Float64:
    """Give how far the add saturates each channel, 0..1, (3,) float64.

    Research document, "Add": linear up to the maximum; beyond it and for every negative number the screen is
    white.
    """
    wanted = np.array([whole(value) for value in add])
    return np.where(wanted < 0.0, 1.0, np.clip(wanted / FULL_ADD, 0.0, 1.0))


def _as_measured(levels: Float64, effect: ColourEffect) -> Float64:
    tint = np.clip(np.nan_to_num(np.array(effect.tint), nan=0.0), 0.0, MAX_TINT)
    brightness = float(np.clip(np.nan_to_num(effect.brightness, nan=1.0), 0.0, 1.0))
    lit = levels * filter_shares(effect, Engine.RESEARCH, stopped=0.0) * brightness
    lit = np.floor(np.clip(lit * tint_factors((tint[0], tint[1], tint[2])), 0.0, 255.0))
    shares = add_shares(effect.add)
    # One opacity for the whole overlay: white under a yellow add loses blue (255, 255, 123).
    return np.asarray(lit * (1.0 - shares.max()) + 255.0 * shares)


def _by_hardware(levels: Float64, effect: ColourEffect) -> Float64:
    lit = levels * vertex_colour(1.0, effect) / 255.0
    return np.asarray(np.clip(lit + np.maximum([whole(value) for value in effect.add], 0.0), 0.0, 255.0))


def _by_software(levels: Float64, effect: ColourEffect) -> Float64:
    colour = np.floor(levels * filter_shares(effect, Engine.OPENJKDF2, SOFTWARE_FILTER_SHARE))
    factors = tint_factors(effect.tint) - 1.0
    colour = np.clip(colour + np.trunc(colour * factors + 0.5), 0.0, 255.0)
    colour = np.clip(colour + np.array([whole(value) for value in effect.add]), 0.0, 255.0)
    if effect.brightness < 1.0:
        colour = np.trunc(np.maximum(colour * effect.brightness, 0.0) + 0.5)
    return np.asarray(colour)
