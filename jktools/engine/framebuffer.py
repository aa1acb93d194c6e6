"""The screen's colour depth: RGB565 and 8 bits a channel.

A 5 or 6 bit level is shown by repeating its top bits below it, so 24 of 31 reads as 198 and 49 of 63 as 199:
the 198, 199, 198 that the research document measured for one value on three channels ("Add").
"""

from __future__ import annotations

import enum

import numpy as np

from jktools.engine.arrays import Float64, UInt8, UInt16

BITS_565 = (5, 6, 5)
"""Bits of red, green and blue."""


class Depth(enum.StrEnum):
    """Name what one pixel of the screen holds."""

    RGB565 = "rgb565"
    RGB888 = "rgb888"


@np.errstate(under="ignore")  # what is too small for a float is 0
def quantise(colours: Float64, depth: Depth = Depth.RGB565) -> UInt8:
    """Round colours to the nearest that the screen can show.

    `colours` is (..., 3) in 0..255; values outside are clamped, NaN counts as 0. Gives (..., 3) uint8 as a
    screenshot reads them. Nearest, because truncation cannot meet both `0.25 white + 145 add` -> 165, 162, 33
    and `add 220` -> 198, 199, 198 (research document, "Add and Brightness").
    """
    bounded = np.clip(np.nan_to_num(np.asarray(colours, np.float64), nan=0.0), 0.0, 255.0)
    if depth is Depth.RGB888:
        return np.floor(bounded + 0.5).astype(np.uint8)
    steps = np.array([(1 << bits) - 1 for bits in BITS_565], np.float64)
    return _repeat_bits(np.floor(bounded * steps / 255.0 + 0.5).astype(np.uint16))


def pack_565(colours: UInt8) -> UInt16:
    """Drop the low bits of (..., 3) uint8 colours, as a 16 bit MAT stores them: (...) uint16, red on top."""
    red, green, blue = (colours[..., c].astype(np.uint16) >> (8 - BITS_565[c]) for c in range(3))
    return np.asarray(red << 11 | green << 5 | blue, np.uint16)


def unpack_565(packed: UInt16) -> UInt8:
    """Read (...) uint16 pixels as (..., 3) uint8 colours."""
    levels = np.stack([packed >> 11 & 31, packed >> 5 & 63, packed & 31], axis=-1)
    return _repeat_bits(levels.astype(np.uint16))


def _repeat_bits(levels: UInt16) -> UInt8:
    shown = np.empty(levels.shape, np.uint8)
    for c, bits in enumerate(BITS_565):
        channel = levels[..., c]
        shown[..., c] = channel << (8 - bits) | channel >> (2 * bits - 8)
    return shown
