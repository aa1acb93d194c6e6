"""The kinds of line in a 3DO."""

from __future__ import annotations

from functools import cache

import lark

from jktools.syntax import grammar
from jktools.syntax.records import Field, Kind, Record, fields


@cache
def parser() -> lark.Lark:
    """The 3DO grammar, loaded once."""
    return grammar.load(
        "threedo", ("section", "version", "line", "material", "vertex", "texture_vertex", "normal", "face", "node")
    )


def _line(keyword: str, *values: Field, rule: str = "line") -> Record:
    return Record(rule, keyword, values, scanned=True, keyword=keyword, alias=keyword, grammar=parser)


_COUNT = fields(Kind.INT, "count")
_LABEL = (Field("label", Kind.LABEL),)
_XYZ = fields(Kind.FLOAT, "x, y, z")

SECTION = _line("section:", *fields(Kind.WORD, "name"), rule="section")
VERSION = _line("3do", *fields(Kind.FLOAT, "version"), rule="version")
MATERIALS = _line("materials", *_COUNT)
RADIUS = _line("radius", *fields(Kind.FLOAT, "radius"))
INSERT_OFFSET = _line("insert offset", *_XYZ)
GEOSETS = _line("geosets", *_COUNT)
GEOSET = _line("geoset", *fields(Kind.INT, "number"))
MESHES = _line("meshes", *_COUNT)
MESH = _line("mesh", *fields(Kind.INT, "number"))
NAME = _line("name", *fields(Kind.WORD, "name"))
GEOMETRY_MODE = _line("geometrymode", *fields(Kind.INT, "geometry mode"))
LIGHT_MODE = _line("lightingmode", *fields(Kind.INT, "light mode"))
TEXTURE_MODE = _line("texturemode", *fields(Kind.INT, "texture mode"))
VERTICES = _line("vertices", *_COUNT)
TEXTURE_VERTICES = _line("texture vertices", *_COUNT)
VERTEX_NORMALS = _line("vertex normals")
FACES = _line("faces", *_COUNT)
FACE_NORMALS = _line("face normals")
HIERARCHY_NODES = _line("hierarchy nodes", *_COUNT)

MATERIAL = Record("material", "material", _LABEL + fields(Kind.WORD, "name"), scanned=True, grammar=parser)
VERTEX = Record(
    "vertex", "vertex", _LABEL + _XYZ + fields(Kind.FLOAT, "intensity"), scanned=True, grammar=parser
)  # fmt: skip
TEXTURE_VERTEX = Record(
    "texture_vertex", "texture vertex", _LABEL + fields(Kind.FLOAT, "u, v"), scanned=True, grammar=parser
)
NORMAL = Record("normal", "normal", _LABEL + _XYZ, scanned=True, grammar=parser)
FACE = Record(
    "face", "face",
    (
        *_LABEL,
        Field("material", Kind.INT),
        Field("face flags", Kind.HEX),
        *fields(Kind.INT, "geometry mode, light mode, texture mode"),
        Field("extra light", Kind.FLOAT),
        Field("vertex count", Kind.INT),
    ),
    more="*", grammar=parser,
)  # fmt: skip
NODE = Record(
    "node", "hierarchy node",
    (
        *_LABEL,
        *fields(Kind.HEX, "flags, type"),
        *fields(Kind.INT, "mesh, parent, child, sibling, number of children"),
        *fields(Kind.FLOAT, "x, y, z, pitch, yaw, roll, pivot x, pivot y, pivot z"),
        *fields(Kind.WORD, "name"),
    ),
    scanned=True, grammar=parser,
)  # fmt: skip
