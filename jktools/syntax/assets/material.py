"""MAT, the materials: cels, and the textures that they show (rdMaterial_LoadEntry in the decompiled engine)."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from jktools.diagnostics.wording import numbered
from jktools.source import Source
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.binary import ByteReader

MAGIC = b"MAT "
VERSION = 0x32
HEADER = struct.Struct("<4s4I14I")
CEL = struct.Struct("<6I")
TEXTURED_CEL = struct.Struct("<4I")
TEXTURE = struct.Struct("<6I")

COLOR, TEXTURED = 0, 2
"""Types of material."""
SOLID_CEL, TEXTURE_CEL = 0, 8
"""Types of cel."""
TRANSPARENT = 0x1
MOST_CELS = 16
"""Cels that the engine keeps (RDMATERIAL_MAX_TEXINFOS); what follows is not read."""
MOST_MIPS = 32
"""A side of 32 bits halves no more often."""


@dataclass(frozen=True, slots=True)
class Cel:
    """One picture of a material: an index into the colormap, or a texture."""

    type: int
    color: int
    texture: int | None
    """Index into `Material.textures`; None for a solid colour."""


@dataclass(frozen=True, slots=True)
class Texture:
    """The pixels of a cel, as far as a level tool asks."""

    width: int
    height: int
    """Texels of the largest level."""
    transparent: bool
    """Whether texels of `transparent_color` are not drawn."""
    transparent_color: int
    mips: int


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Material(Asset):
    """A MAT file."""

    type: int = -1
    """0 colours, 2 textures; -1 where it could not be read."""
    bits: int = 0
    """Per texel: 8 is an index into the colormap, 16 a colour."""
    cels: tuple[Cel, ...] = ()
    textures: tuple[Texture, ...] = ()

    @property
    def is_color(self) -> bool:
        """Whether it has colours and no texture, so that a face that shows it must not be textured."""
        return self.type == COLOR

    @property
    def size(self) -> tuple[int, int] | None:
        """Width and height of cel 0 in texels, by which texel coordinates are divided; None for a colour."""
        first = self.cels[0].texture if self.cels else None
        if first is None or first >= len(self.textures):
            return None
        return self.textures[first].width, self.textures[first].height


def read_material(source: Source) -> Material:
    """Read a MAT. Never raises: what is wrong is told in `Material.diagnostics`."""
    data = ByteReader(source, "the material")
    header = data.take(HEADER, "its header")
    if header is None or not data.starts(MAGIC, header[0]):
        return Material(source=source, diagnostics=data.finish())
    _, version, kind, cel_count, texture_count, _, bits, *_ = header
    if version != VERSION:
        data.unknown(f"version {version:#x}, but only {VERSION:#x} is known")
    if kind not in (COLOR, TEXTURED):
        data.unknown(f"type {kind}, but only {COLOR} (colours) and {TEXTURED} (textures) are known")
    if bits not in (8, 16) and kind == TEXTURED:
        data.unknown(f"{bits} bits a texel, but only 8 and 16 are known")
    cels = _cels(data, cel_count)
    textures = _textures(data, texture_count, max(1, bits // 8))
    for index, cel in enumerate(cels):
        if cel.texture is not None and cel.texture >= texture_count:
            data.faults.tell(
                faults.ASSET_INDEX_OUT_OF_RANGE, source,
                f"cel {index} shows texture {cel.texture}, but the material has {numbered(texture_count, 'texture')}",
                "export the material again; the engine reads beyond its textures",
            )  # fmt: skip
    if cel_count > MOST_CELS:
        data.faults.tell(
            faults.TOO_MANY_CELS, source, f"the material has {cel_count} cels, but the engine keeps {MOST_CELS}",
            "leave cels out, or animate with two materials",
        )  # fmt: skip
    return Material(
        source=source, diagnostics=data.finish(), type=kind, bits=bits, cels=tuple(cels), textures=tuple(textures)
    )


def _cels(data: ByteReader, count: int) -> list[Cel]:
    cels: list[Cel] = []
    while len(cels) < count:
        record = data.take(CEL, f"cel {len(cels)}")
        if record is None:
            break
        kind, color, *_ = record
        texture = None
        if kind == TEXTURE_CEL:
            more = data.take(TEXTURED_CEL, f"cel {len(cels)}")
            if more is None:
                break
            texture = more[3]
        elif kind != SOLID_CEL:
            data.unknown(f"cel {len(cels)} of type {kind}, but only {SOLID_CEL} and {TEXTURE_CEL} are known")
            break
        cels.append(Cel(kind, color, texture))
    return cels


def _textures(data: ByteReader, count: int, texel: int) -> list[Texture]:
    textures: list[Texture] = []
    while len(textures) < count and not data.lost:
        title = f"texture {len(textures)}"
        record = data.take(TEXTURE, title)
        if record is None:
            break
        width, height, flags, _, color, mips = record
        if not (width and height and 0 < mips <= MOST_MIPS):
            data.unknown(f"{title} of {width} x {height} texels at {mips} sizes, which is no picture")
            break
        pixels = sum(max(1, width >> k) * max(1, height >> k) for k in range(mips)) * texel
        if not data.skip(pixels, f"the pixels of {title}"):
            break
        textures.append(Texture(width, height, bool(flags & TRANSPARENT), color, mips))
    return textures
