"""The kinds of line in a JKL."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from types import MappingProxyType

import lark

from jktools.syntax import grammar
from jktools.syntax.records import WORD as WORD
from jktools.syntax.records import Field as Field
from jktools.syntax.records import Kind as Kind
from jktools.syntax.records import Record as Record
from jktools.syntax.records import fields, fields_of
from jktools.syntax.records import keywords as keywords
from jktools.syntax.records import prefix as prefix
from jktools.syntax.template.records import TEMPLATE as TEMPLATE
from jktools.syntax.template.records import THING as THING

START_RULES = (
    "section", "count", "header_line", "sound", "entry", "material", "vertex", "texture_vertex", "adjoin", "surface",
    "normal", "sector_line", "sector_vertex", "cog", "arch_line",
    "light_jed", "light_sed", "light_rgb", "layer_members",
)  # fmt: skip


@cache
def parser() -> lark.Lark:
    """The JKL grammar, loaded once."""
    return grammar.load("jkl", START_RULES)


def parse_any(rule: str, text: str) -> tuple[str, list[lark.Token]]:
    """Parse a line of a rule that has alternatives: the alternative's name and its fields.

    Raises lark.UnexpectedInput.
    """
    tree = parser().parse(text, start=rule)
    return str(tree.data), fields_of(tree)


_LABEL = (Field("label", Kind.LABEL),)


def _named(alias: str, rule: str, title: str, keyword: str, values: tuple[Field, ...]) -> Record:
    return Record(rule, title, values, scanned=True, keyword=keyword, alias=alias, grammar=parser)


def _record(rule: str, title: str, values: tuple[Field, ...], *, scanned: bool = False, more: str = "") -> Record:
    return Record(rule, title, values, scanned=scanned, more=more, grammar=parser)


COUNT_FIELDS = fields(Kind.INT, "count")
SOUND = _record("sound", "sound", fields(Kind.WORD, "name"), more="*")
MATERIAL = _record("material", "material", _LABEL + fields(Kind.WORD, "name"), more="ff")
ENTRY = _record("entry", "entry", _LABEL + fields(Kind.WORD, "name"))
VERTEX = _record("vertex", "vertex", _LABEL + fields(Kind.FLOAT, "x, y, z"), scanned=True)
TEXTURE_VERTEX = _record("texture_vertex", "texture vertex", _LABEL + fields(Kind.FLOAT, "u, v"), scanned=True)
ADJOIN = _record(
    "adjoin", "adjoin",
    (*_LABEL, Field("flags", Kind.HEX), Field("mirror", Kind.INT), Field("distance", Kind.FLOAT)),
)  # fmt: skip
SURFACE = _record(
    "surface", "surface",
    (
        *_LABEL,
        Field("material", Kind.INT),
        *fields(Kind.HEX, "surface flags, face flags"),
        *fields(Kind.INT, "geometry mode, light mode, texture mode, adjoin"),
        Field("extra light", Kind.FLOAT),
        Field("vertex count", Kind.INT),
    ),
)  # fmt: skip
NORMAL = _record("normal", "normal", _LABEL + fields(Kind.FLOAT, "x, y, z"), scanned=True)
SECTOR_VERTEX = _record("sector_vertex", "sector vertex", _LABEL + fields(Kind.INT, "vertex"), scanned=True)
COG = _record("cog", "cog", _LABEL + fields(Kind.WORD, "script"), more="*")
_PLACE = fields(Kind.FLOAT, "x, y, z")
_FLAGS_AND_LAYER = (Field("flags", Kind.HEX), Field("layer", Kind.INT))
LIGHT_JED = _record(
    "light_jed", "light", (*_LABEL, Field("type", Kind.HEX), *_PLACE, *fields(Kind.FLOAT, "intensity, range"))
)
LIGHT_SED = _record(
    "light_sed", "light", (*_LABEL, *_FLAGS_AND_LAYER, *_PLACE, *fields(Kind.FLOAT, "range, intensity"))
)
LIGHT_RGB = _record(
    "light_rgb", "light",
    (*_LABEL, *_FLAGS_AND_LAYER, *_PLACE, *fields(Kind.FLOAT, "range, intensity, red, green, blue")),
)  # fmt: skip


def _by_alias(rule: str, title: str, lines: Sequence[tuple[str, str, tuple[Field, ...]]]) -> Mapping[str, Record]:
    return MappingProxyType({alias: _named(alias, rule, title, keyword, values) for alias, keyword, values in lines})


_BOX = fields(Kind.FLOAT, "x0, y0, z0, x1, y1, z1")
_XYZ = fields(Kind.FLOAT, "x, y, z")
_VALUE = fields(Kind.FLOAT, "value")
_FOUR = fields(Kind.FLOAT, "first, second, third, fourth")

HEADER_LINES = _by_alias("header_line", "header", [
    ("version", "version", fields(Kind.INT, "version")),
    ("gravity", "world gravity", _VALUE),
    ("ceiling_sky_z", "ceiling sky z", _VALUE),
    ("horizon_distance", "horizon distance", _VALUE),
    ("horizon_pixels_per_rev", "horizon pixels per rev", _VALUE),
    ("horizon_sky_offset", "horizon sky offset", fields(Kind.FLOAT, "u, v")),
    ("ceiling_sky_offset", "ceiling sky offset", fields(Kind.FLOAT, "u, v")),
    ("mipmap_distances", "mipmap distances", _FOUR),
    ("lod_distances", "lod distances", _FOUR),
    ("perspective_distance", "perspective distance", _VALUE),
    ("gouraud_distance", "gouraud distance", _VALUE),
])  # fmt: skip
"""The lines of HEADER in the order that the engine demands (sithHeader_Load)."""

SECTOR_LINES = _by_alias("sector_line", "sector", [
    ("sector", "sector", fields(Kind.INT, "number")),
    ("flags", "flags", fields(Kind.HEX, "flags")),
    ("ambient_light", "ambient light", _VALUE),
    ("extra_light", "extra light", _VALUE),
    ("colormap", "colormap", fields(Kind.INT, "colormap")),
    ("tint", "tint", fields(Kind.FLOAT, "red, green, blue")),
    ("bound_box", "boundbox", _BOX),
    ("collide_box", "collidebox", _BOX),
    ("sector_sound", "sound", (Field("name", Kind.WORD), Field("volume", Kind.FLOAT))),
    ("center", "center", _XYZ),
    ("radius", "radius", _VALUE),
    ("vertex_count", "vertices", fields(Kind.INT, "count")),
    ("surface_range", "surfaces", fields(Kind.INT, "first, count")),
])  # fmt: skip
"""The lines of one sector in the order that the engine demands (sithSector_Load)."""

OPTIONAL_SECTOR_LINES = frozenset({"tint", "collide_box", "sector_sound"})

ARCH_LINES = _by_alias("arch_line", "arch lighting", [
    ("arch_object", "archobject", fields(Kind.INT, "number")),
    ("arch_meshes", "nummeshes:", fields(Kind.INT, "count")),
    ("arch_mesh", "mesh", fields(Kind.INT, "number")),
    ("arch_vertices", "numvertices:", fields(Kind.INT, "count")),
    ("arch_vertex", "", _LABEL + fields(Kind.FLOAT, "mono, red, green, blue")),
])  # fmt: skip
