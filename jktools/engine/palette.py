"""Palettes and the tables of a CMP file, as arrays.

A CMP holds 256 colours, (256, 3) uint8; a light table, (64, 256) uint8, row `level` naming the entry that
stands for each entry at that light; and perhaps a transparency table, (256, 256) uint8, naming the entry for
one seen through another.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import UInt8
from jktools.engine.colour import Renderer, apply
from jktools.engine.colour_effect import ColourEffect
from jktools.engine.framebuffer import Depth
from jktools.engine.profile import Engine

LIGHT_LEVELS = 64


def under_effect(
    palette: npt.ArrayLike,
    effect: ColourEffect,
    engine: Engine = Engine.RESEARCH,
    renderer: Renderer = Renderer.SOFTWARE,
    depth: Depth = Depth.RGB888,
) -> UInt8:
    """Give a palette under an effect: (256, 3) uint8.

    The software renderer draws indices and changes the palette only, so the effect costs 256 colours, not a
    screen (`stdPalEffects_UpdatePalette` in the decompiled engine). Raises ValueError for another shape.
    """
    colours = np.asarray(palette)
    if colours.shape != (256, 3):
        raise ValueError(f"a palette is 256 colours of three channels, got shape {colours.shape}")
    return apply(colours, effect, engine, renderer, depth)


@np.errstate(under="ignore")  # what is too small for a float is 0
def light_level(light: npt.ArrayLike) -> npt.NDArray[np.intp]:
    """Give the row of the light table for light 0..1: (...) in 0..63; clamped outside, NaN is dark."""
    lit = np.clip(np.nan_to_num(np.asarray(light, np.float64), nan=0.0), 0.0, 1.0)
    return np.trunc(lit * (LIGHT_LEVELS - 1)).astype(np.intp)


def shaded(indices: UInt8, light: npt.ArrayLike, light_table: UInt8) -> UInt8:
    """Give the palette entries that pixels show under a light: both (...), `indices` uint8."""
    return np.asarray(_table(light_table, LIGHT_LEVELS, "light")[light_level(light), indices])


def seen_through(behind: UInt8, front: UInt8, transparency: UInt8) -> UInt8:
    """Give the palette entries for a translucent pixel `front` before `behind`; both (...) uint8."""
    return np.asarray(_table(transparency, 256, "transparency")[front, behind])


def _table(table: UInt8, rows: int, name: str) -> UInt8:
    if table.shape != (rows, 256):
        raise ValueError(f"a {name} table is {rows} rows of 256 entries, got shape {table.shape}")
    return table
