"""The kinds of line in a JKL: which rule reads them, what their fields are, what the engine makes of bad ones."""

from __future__ import annotations

import enum
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from types import MappingProxyType

import lark

from jktools.syntax import grammar


class Kind(enum.Enum):
    """What a field is: how people call it, and the longest prefix that the engine would still read."""

    LABEL = "a number and a colon"
    INT = "a whole number"
    HEX = "a hexadecimal number"
    FLOAT = "a number"
    WORD = "a name"


_PREFIX: Mapping[Kind, str] = MappingProxyType(
    {
        Kind.LABEL: r"[-+]?\d+:",
        Kind.INT: r"[-+]?\d+",
        Kind.HEX: r"[-+]?(?:0[xX])?[0-9a-fA-F]+",
        Kind.FLOAT: r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?",
        Kind.WORD: r"\S+",
    }
)


WORD = re.compile(r"[^ \t\r\f\v]+")
"""A word as the grammar parts them; `str.split` and `\\s` take more control bytes for blanks than the engine does."""


def keywords(text: str) -> str:
    """The words of a line in lower case, each followed by one blank."""
    return "".join(word + " " for word in WORD.findall(text.lower()))


_LETTER = {Kind.LABEL: "L", Kind.INT: "i", Kind.HEX: "h", Kind.FLOAT: "f", Kind.WORD: "w"}


@dataclass(frozen=True, slots=True)
class Field:
    """One value of a record, named in the game's words."""

    name: str
    kind: Kind


@dataclass(frozen=True)
class Record:
    """One kind of line.

    `scanned` lines are read by the engine with scanf, the others as fields; see grammars/jkl.lark.
    """

    rule: str
    """Start rule of the grammar."""
    title: str
    """For messages: `vertex`, `adjoin`."""
    fields: tuple[Field, ...]
    scanned: bool = False
    keyword: str = ""
    """The words before the fields, in lower case; they choose among the alternatives of one rule."""
    alias: str = ""
    """Name of that alternative in the grammar; the rule's own name where there is only one."""
    more: str = ""
    """What may follow the fields in a record that the native reader takes: `*` any words, `ff` two numbers."""

    @cached_property
    def form(self) -> str:
        """The fields for the native reader, a letter each (native/text/records.hpp)."""
        return "".join(_LETTER[f.kind] for f in self.fields) + self.more

    @cached_property
    def words_before(self) -> int:
        """How many words stand before the first field."""
        return len(self.keyword.split())

    def ordinal(self, name: str) -> int:
        """Position of a field among the fields. Raises ValueError."""
        return [f.name for f in self.fields].index(name)

    def words(self, text: str) -> str:
        """The text with what separates words turned into blanks, position for position."""
        return text if self.scanned else text.replace(",", " ")

    def parse(self, text: str) -> list[lark.Token]:
        """The fields of a line, and what the rule repeats behind them. Raises lark.UnexpectedInput."""
        return _fields_of(parser().parse(self.words(text), start=self.rule))

    def surplus(self, text: str) -> list[lark.Token]:
        """The words of a well-formed line that nobody reads."""
        last = parser().parse(self.words(text), start=self.rule).children[-1]
        return [t for t in last.children if isinstance(t, lark.Token)] if isinstance(last, lark.Tree) else []

    def salvage(self, text: str) -> list[str] | None:
        """The fields as the engine would read a malformed line, or None where it refuses the level.

        scanf takes each value's longest prefix and fails on none; the field reader takes the prefix of each
        word, 0 where there is none, and fails only when words are missing.
        """
        return self._scan(text) if self.scanned else self._split(text)

    def _scan(self, text: str) -> list[str] | None:
        words = r"\s*".join(map(re.escape, self.keyword.split()))
        values = r"\s*".join(f"({_PREFIX[f.kind]})" for f in self.fields)
        found = re.match(rf"\s*{words}\s*{values}", text, re.IGNORECASE | re.ASCII)
        return list(found.groups()) if found else None

    def _split(self, text: str) -> list[str] | None:
        words = WORD.findall(self.words(text))
        if len(words) < len(self.fields):
            return None
        return [prefix(f.kind, word) for f, word in zip(self.fields, words, strict=False)]


def prefix(kind: Kind, word: str) -> str:
    """What the engine's field reader makes of a word: its longest prefix that fits, or 0."""
    if kind is Kind.WORD:
        return word
    found = re.match(_PREFIX[Kind.INT if kind is Kind.LABEL else kind], word, re.ASCII)
    return found.group() if found else "0"


def _fields_of(tree: lark.Tree[lark.Token]) -> list[lark.Token]:
    return [child for child in tree.children if isinstance(child, lark.Token)]


def parse_any(rule: str, text: str) -> tuple[str, list[lark.Token]]:
    """Parse a line of a rule that has alternatives: the alternative's name and its fields.

    Raises lark.UnexpectedInput.
    """
    tree = parser().parse(text, start=rule)
    return str(tree.data), _fields_of(tree)


START_RULES = (
    "section", "count", "header_line", "sound", "entry", "material", "vertex", "texture_vertex", "adjoin", "surface",
    "normal", "sector_line", "sector_vertex", "cog", "template", "thing", "arch_line",
    "light_jed", "light_sed", "light_rgb", "layer_members",
)  # fmt: skip


@cache
def parser() -> lark.Lark:
    """The JKL grammar, loaded once."""
    return grammar.load("jkl", START_RULES)


def _fields(kind: Kind, names: str) -> tuple[Field, ...]:
    return tuple(Field(name.strip(), kind) for name in names.split(","))


_LABEL = (Field("label", Kind.LABEL),)


def _named(alias: str, rule: str, title: str, keyword: str, fields: tuple[Field, ...]) -> Record:
    return Record(rule, title, fields, scanned=True, keyword=keyword, alias=alias)


COUNT_FIELDS = _fields(Kind.INT, "count")
SOUND = Record("sound", "sound", _fields(Kind.WORD, "name"), more="*")
MATERIAL = Record("material", "material", _LABEL + _fields(Kind.WORD, "name"), more="ff")
ENTRY = Record("entry", "entry", _LABEL + _fields(Kind.WORD, "name"))
VERTEX = Record("vertex", "vertex", _LABEL + _fields(Kind.FLOAT, "x, y, z"), scanned=True)
TEXTURE_VERTEX = Record("texture_vertex", "texture vertex", _LABEL + _fields(Kind.FLOAT, "u, v"), scanned=True)
ADJOIN = Record(
    "adjoin", "adjoin",
    (*_LABEL, Field("flags", Kind.HEX), Field("mirror", Kind.INT), Field("distance", Kind.FLOAT)),
)  # fmt: skip
SURFACE = Record(
    "surface", "surface",
    (
        *_LABEL,
        Field("material", Kind.INT),
        *_fields(Kind.HEX, "surface flags, face flags"),
        *_fields(Kind.INT, "geometry mode, light mode, texture mode, adjoin"),
        Field("extra light", Kind.FLOAT),
        Field("vertex count", Kind.INT),
    ),
)  # fmt: skip
NORMAL = Record("normal", "normal", _LABEL + _fields(Kind.FLOAT, "x, y, z"), scanned=True)
SECTOR_VERTEX = Record("sector_vertex", "sector vertex", _LABEL + _fields(Kind.INT, "vertex"), scanned=True)
COG = Record("cog", "cog", _LABEL + _fields(Kind.WORD, "script"), more="*")
TEMPLATE = Record("template", "template", _fields(Kind.WORD, "name, parent"), more="*")
THING = Record(
    "thing", "thing",
    (
        *_LABEL,
        *_fields(Kind.WORD, "template, name"),
        *_fields(Kind.FLOAT, "x, y, z, pitch, yaw, roll"),
        Field("sector", Kind.INT),
    ),
    more="*",
)  # fmt: skip

_PLACE = _fields(Kind.FLOAT, "x, y, z")
_FLAGS_AND_LAYER = (Field("flags", Kind.HEX), Field("layer", Kind.INT))
LIGHT_JED = Record(
    "light_jed", "light", (*_LABEL, Field("type", Kind.HEX), *_PLACE, *_fields(Kind.FLOAT, "intensity, range"))
)
LIGHT_SED = Record(
    "light_sed", "light", (*_LABEL, *_FLAGS_AND_LAYER, *_PLACE, *_fields(Kind.FLOAT, "range, intensity"))
)
LIGHT_RGB = Record(
    "light_rgb", "light",
    (*_LABEL, *_FLAGS_AND_LAYER, *_PLACE, *_fields(Kind.FLOAT, "range, intensity, red, green, blue")),
)  # fmt: skip


def _by_alias(rule: str, title: str, lines: Sequence[tuple[str, str, tuple[Field, ...]]]) -> Mapping[str, Record]:
    return MappingProxyType({alias: _named(alias, rule, title, keyword, fields) for alias, keyword, fields in lines})


_BOX = _fields(Kind.FLOAT, "x0, y0, z0, x1, y1, z1")
_XYZ = _fields(Kind.FLOAT, "x, y, z")
_VALUE = _fields(Kind.FLOAT, "value")
_FOUR = _fields(Kind.FLOAT, "first, second, third, fourth")

HEADER_LINES = _by_alias("header_line", "header", [
    ("version", "version", _fields(Kind.INT, "version")),
    ("gravity", "world gravity", _VALUE),
    ("ceiling_sky_z", "ceiling sky z", _VALUE),
    ("horizon_distance", "horizon distance", _VALUE),
    ("horizon_pixels_per_rev", "horizon pixels per rev", _VALUE),
    ("horizon_sky_offset", "horizon sky offset", _fields(Kind.FLOAT, "u, v")),
    ("ceiling_sky_offset", "ceiling sky offset", _fields(Kind.FLOAT, "u, v")),
    ("mipmap_distances", "mipmap distances", _FOUR),
    ("lod_distances", "lod distances", _FOUR),
    ("perspective_distance", "perspective distance", _VALUE),
    ("gouraud_distance", "gouraud distance", _VALUE),
])  # fmt: skip
"""The lines of HEADER in the order that the engine demands (sithHeader_Load)."""

SECTOR_LINES = _by_alias("sector_line", "sector", [
    ("sector", "sector", _fields(Kind.INT, "number")),
    ("flags", "flags", _fields(Kind.HEX, "flags")),
    ("ambient_light", "ambient light", _VALUE),
    ("extra_light", "extra light", _VALUE),
    ("colormap", "colormap", _fields(Kind.INT, "colormap")),
    ("tint", "tint", _fields(Kind.FLOAT, "red, green, blue")),
    ("bound_box", "boundbox", _BOX),
    ("collide_box", "collidebox", _BOX),
    ("sector_sound", "sound", (Field("name", Kind.WORD), Field("volume", Kind.FLOAT))),
    ("center", "center", _XYZ),
    ("radius", "radius", _VALUE),
    ("vertex_count", "vertices", _fields(Kind.INT, "count")),
    ("surface_range", "surfaces", _fields(Kind.INT, "first, count")),
])  # fmt: skip
"""The lines of one sector in the order that the engine demands (sithSector_Load)."""

OPTIONAL_SECTOR_LINES = frozenset({"tint", "collide_box", "sector_sound"})

ARCH_LINES = _by_alias("arch_line", "arch lighting", [
    ("arch_object", "archobject", _fields(Kind.INT, "number")),
    ("arch_meshes", "nummeshes:", _fields(Kind.INT, "count")),
    ("arch_mesh", "mesh", _fields(Kind.INT, "number")),
    ("arch_vertices", "numvertices:", _fields(Kind.INT, "count")),
    ("arch_vertex", "", _LABEL + _fields(Kind.FLOAT, "mono, red, green, blue")),
])  # fmt: skip
