"""The kinds of line in the small text assets."""

from __future__ import annotations

from functools import cache

import lark

from jktools.syntax import grammar
from jktools.syntax.records import Field, Kind, Record, fields

_RULES = (
    "sprite", "sound_mode", "puppet_line", "ai_line", "section", "version", "line", "marker", "key_entry", "key_speed",
    "cloud_vertex", "item", "episode_type", "episode_count", "episode_line",
)  # fmt: skip


@cache
def parser() -> lark.Lark:
    """The grammar, loaded once."""
    return grammar.load("assets", _RULES)


def _line(keyword: str, *values: Field, rule: str = "line") -> Record:
    return Record(rule, keyword, values, scanned=True, keyword=keyword, alias=keyword, grammar=parser)


_COUNT = fields(Kind.INT, "count")
_LABEL = (Field("label", Kind.LABEL),)
_XYZ = fields(Kind.FLOAT, "x, y, z")
_PYR = fields(Kind.FLOAT, "pitch, yaw, roll")

SPRITE = Record(
    "sprite", "sprite",
    (
        *fields(Kind.WORD, "material"), *fields(Kind.INT, "type"), *fields(Kind.FLOAT, "width, height"),
        *fields(Kind.INT, "geometry mode, light mode, texture mode"), *fields(Kind.FLOAT, "extra light, x, y, z"),
    ),
    grammar=parser,
)  # fmt: skip
SOUND_MODE = Record("sound_mode", "sound", fields(Kind.WORD, "mode, sound"), more="*", grammar=parser)
PUPPET_LINE = Record("puppet_line", "line", fields(Kind.WORD, "name"), more="*", grammar=parser)
AI_LINE = Record("ai_line", "line", fields(Kind.WORD, "name"), more="*", grammar=parser)
ITEM = Record(
    "item", "item",
    (
        *fields(Kind.WORD, "name"), *fields(Kind.INT, "bin"), *fields(Kind.FLOAT, "least, most"),
        *fields(Kind.HEX, "flags"),
    ),
    more="*", grammar=parser,
)  # fmt: skip
EPISODE_TYPE = _line("type", *fields(Kind.INT, "type"), rule="episode_type")
EPISODE_COUNT = _line("seq", *_COUNT, rule="episode_count")
EPISODE_LINE = Record(
    "episode_line", "line",
    (
        *_LABEL, *fields(Kind.INT, "disc, level"), *fields(Kind.WORD, "type, file"),
        *fields(Kind.INT, "light power, dark power, next, next of the dark side"),
    ),
    scanned=True, grammar=parser,
)  # fmt: skip

SECTION = Record(
    "section", "section:", fields(Kind.WORD, "name"), scanned=True, keyword="section:", more="*", grammar=parser
)
"""Its name may be several words: `SECTION: KEYFRAME NODES`."""
VERSION = _line("par", *fields(Kind.FLOAT, "version"), rule="version")
FLAGS = _line("flags", *fields(Kind.HEX, "flags"))
TYPE = _line("type", *fields(Kind.HEX, "type"))
FRAMES = _line("frames", *fields(Kind.INT, "frames"))
FPS = _line("fps", *fields(Kind.FLOAT, "frames a second"))
JOINTS = _line("joints", *_COUNT)
MARKERS = _line("markers", *_COUNT)
NODES = _line("nodes", *_COUNT)
NODE = _line("node", *fields(Kind.INT, "number"))
MESH_NAME = _line("mesh name", *fields(Kind.WORD, "name"))
ENTRIES = _line("entries", *_COUNT)
SIZE = _line("size", *fields(Kind.FLOAT, "size"))
MATERIAL = _line("material", *fields(Kind.WORD, "name"))
LIGHT_MODE = _line("lightingmode", *fields(Kind.INT, "light mode"))
RADIUS = _line("radius", *fields(Kind.FLOAT, "radius"))
INSERT_OFFSET = _line("insert offset", *_XYZ)
VERTICES = _line("vertices", *_COUNT)

MARKER = Record(
    "marker", "marker", fields(Kind.FLOAT, "frame") + fields(Kind.INT, "type"), scanned=True, grammar=parser
)
KEY_ENTRY = Record(
    "key_entry", "entry", (*_LABEL, *fields(Kind.FLOAT, "frame"), *fields(Kind.HEX, "flags"), *_XYZ, *_PYR),
    scanned=True, grammar=parser,
)  # fmt: skip
KEY_SPEED = Record("key_speed", "speeds of an entry", (*_XYZ, *_PYR), scanned=True, grammar=parser)
CLOUD_VERTEX = Record(
    "cloud_vertex", "vertex", (*_LABEL, *_XYZ, *fields(Kind.INT, "cel")), scanned=True, grammar=parser
)
