"""CMP, the colormaps: a palette, its shades and its mixtures (rdColormap_LoadEntry in the decompiled engine)."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np

from jktools.source import Source
from jktools.syntax.arrays import UInt8
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.binary import ByteReader

MAGIC = b"CMP "
HEADER = struct.Struct("<4sII3f40x")
KNOWN_VERSIONS = (20, 30)
TRANSPARENCY = 0x1
COLORS = 256
SHADES = 64


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Colormap(Asset):
    """A CMP file."""

    flags: int = 0
    tint: tuple[float, float, float] = (0.0, 0.0, 0.0)
    palette: UInt8
    """(256, 3) red, green, blue of 0 to 255; black where it could not be read."""
    has_light: bool = False
    """Whether the table of shades is there; a file of the palette alone has none."""
    has_transparency: bool = False


def read_colormap(source: Source) -> Colormap:
    """Read a CMP. Never raises: what is wrong is told in `Colormap.diagnostics`."""
    data = ByteReader(source, "the colormap")
    palette = np.zeros((COLORS, 3), np.uint8)
    header = data.take(HEADER, "its header")
    if header is None or not data.starts(MAGIC, header[0]):
        return Colormap(source=source, diagnostics=data.finish(), palette=palette)
    _, version, flags, *tint = header
    if version not in KNOWN_VERSIONS:
        data.unknown(f"version {version}, but only {KNOWN_VERSIONS[0]} and {KNOWN_VERSIONS[1]} are known")
    start = data.at
    if data.skip(palette.nbytes, "the palette"):
        palette = np.frombuffer(source.data, np.uint8, palette.nbytes, start).reshape(COLORS, 3)
    has_light = not data.lost and data.left > 0 and data.skip(SHADES * COLORS, "the shades")
    has_transparency = has_light and bool(flags & TRANSPARENCY) and data.skip(COLORS * COLORS, "the mixtures")
    return Colormap(
        source=source,
        diagnostics=data.finish(),
        flags=flags,
        tint=(tint[0], tint[1], tint[2]),
        palette=palette,
        has_light=has_light,
        has_transparency=has_transparency,
    )
