"""GEORESOURCE: colormaps, vertices, texture vertices, adjoins, surfaces and their normals."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jktools.diagnostics import Subject
from jktools.syntax.jkl import faults, lists, records
from jktools.syntax.jkl.context import Context
from jktools.syntax.jkl.document import (
    Adjoins,
    Heading,
    NameList,
    Normals,
    Surfaces,
    TextureVertices,
    Vertices,
)
from jktools.syntax.jkl.records import Record
from jktools.syntax.jkl.rows import Rows, floats, ints

LIGHTS_PER_CORNER_RGB = 4
"""Mysteries of the Sith writes mono, red, green and blue for each corner."""

_FEWEST_SURFACE_WORDS = len(records.SURFACE.fields)


@dataclass(frozen=True, slots=True)
class GeoResource:
    """The tables of the section."""

    colormaps: NameList
    vertices: Vertices
    texture_vertices: TextureVertices
    adjoins: Adjoins
    surfaces: Surfaces
    normals: Normals


def read_georesource(context: Context) -> GeoResource:
    """Read the section behind its `section:` line; blocks that are missing stay empty."""
    heading, rows = _block(context, "world colormaps", records.ENTRY, "colormap")
    colormaps = lists.name_list(context, lists.COLORMAPS, heading, rows)
    vertices = _vertices(context)
    texture_vertices = _texture_vertices(context)
    adjoins = _adjoins(context)
    surfaces = _surfaces(context)
    normals = _normals(context, len(surfaces))
    return GeoResource(colormaps, vertices, texture_vertices, adjoins, surfaces, normals)


def _block(context: Context, words: str, record: Record, kind: str) -> tuple[Heading | None, Rows]:
    """Read the records behind a heading up to whatever cannot be one."""
    heading = context.heading(words)
    rows = Rows(record)
    while not context.at_boundary():
        rows.add(context.at, context.record(record, Subject(kind, len(rows))))
    return heading, rows


def _vertices(context: Context) -> Vertices:
    heading, rows = _block(context, "world vertices", records.VERTEX, "vertex")
    context.counted(heading, "vertices", len(rows))
    table = Vertices(heading, rows.line_column(), rows.broken(), rows.float_columns("x", 3))
    context.outside(rows, "vertex")
    return table


def _texture_vertices(context: Context) -> TextureVertices:
    heading, rows = _block(context, "world texture vertices", records.TEXTURE_VERTEX, "texture vertex")
    context.counted(heading, "texture vertices", len(rows))
    table = TextureVertices(heading, rows.line_column(), rows.broken(), rows.float_columns("u", 2))
    context.outside(rows, "texture vertex")
    return table


def _adjoins(context: Context) -> Adjoins:
    heading, rows = _block(context, "world adjoins", records.ADJOIN, "adjoin")
    context.counted(heading, "adjoins", len(rows))
    table = Adjoins(
        heading,
        rows.line_column(),
        rows.broken(),
        rows.hex_column("flags"),
        rows.int_column("mirror"),
        rows.float_columns("distance", 1),
    )
    context.outside(rows, "adjoin")
    return table


class _Corners:
    """What a surface repeats: its corners and their light."""

    def __init__(self) -> None:
        self.start = [0]
        self.pairs: list[str] = []
        self.light_start = [0]
        self.light: list[str] = []

    def add(self, pairs: Sequence[str], light: Sequence[str]) -> None:
        self.pairs.extend(pairs)
        self.light.extend(light)
        self.start.append(len(self.pairs) // 2)
        self.light_start.append(len(self.light))


def _surfaces(context: Context) -> Surfaces:
    heading = context.heading("world surfaces")
    rows = Rows(records.SURFACE)
    corners = _Corners()
    while not context.at_boundary() and not _at_normals(context, heading, len(rows)):
        line, subject = context.at, Subject("surface", len(rows))
        fields = context.record(records.SURFACE, subject)
        tail = None if fields is None else _tail(context, line, fields, subject)
        if tail is None:
            rows.add(line, None)
            corners.add((), ())
        else:
            assert fields is not None
            rows.add(line, fields[:_FEWEST_SURFACE_WORDS])
            corners.add(*tail)
    context.counted(heading, "surfaces", len(rows))
    pairs = np.array(ints(corners.pairs)[0], np.int32).reshape(-1, 2)
    table = Surfaces(
        heading,
        rows.line_column(),
        rows.broken(),
        material=rows.int_column("material"),
        flags=rows.hex_column("surface flags"),
        face_flags=rows.hex_column("face flags"),
        geometry_mode=rows.int_column("geometry mode"),
        light_mode=rows.int_column("light mode"),
        texture_mode=rows.int_column("texture mode"),
        adjoin=rows.int_column("adjoin"),
        extra_light=rows.float_columns("extra light", 1),
        corner_start=np.array(corners.start, np.int32),
        corner_vertex=np.ascontiguousarray(pairs[:, 0]),
        corner_texture_vertex=np.ascontiguousarray(pairs[:, 1]),
        light_start=np.array(corners.light_start, np.int32),
        light=floats(corners.light),
    )
    context.outside(rows, "surface")
    return table


def _at_normals(context: Context, heading: Heading | None, seen: int) -> bool:
    """Whether the normals start here: they have no heading of their own, but no more than 5 words.

    Where fewer surfaces than announced have been seen, the line may be a broken surface: the next line decides.
    """
    if _word_count(context.text()) >= _FEWEST_SURFACE_WORDS:
        return False
    if heading is None or seen >= heading.count or context.at + 1 >= len(context.lines):
        return True
    return _word_count(context.lines.text(context.at + 1)) < _FEWEST_SURFACE_WORDS


def _word_count(text: str) -> int:
    return len(text.replace(",", " ").split())


def _tail(
    context: Context, line: int, fields: Sequence[str], subject: Subject
) -> tuple[Sequence[str], Sequence[str]] | None:
    """The index pairs and intensities behind a surface's fields, or None when they do not suffice."""
    count = int(fields[_FEWEST_SURFACE_WORDS - 1])
    rest = _numbers(context, line, count, fields, subject)
    if count < 0 or len(rest) < 2 * count:
        context.fault(
            faults.MALFORMED_RECORD, line,
            f"surface {subject.index} announces {count} vertices, but the line has indices for {len(rest) // 2}",
            "write a vertex and a texture vertex for each; the engine refuses a level with such a record", subject,
        )  # fmt: skip
        return None
    return rest[: 2 * count], _light(context, line, count, rest[2 * count :], subject)


def _numbers(context: Context, line: int, count: int, fields: Sequence[str], subject: Subject) -> list[str]:
    """What stands behind a surface's fields; of words that are no numbers the prefix that the engine reads."""
    rest = list(fields[_FEWEST_SURFACE_WORDS:])
    words = list(re.finditer(r"[^\s,]+", context.lines.text(line)))[_FEWEST_SURFACE_WORDS:]
    if len(rest) == len(words) and all(map(_is_whole, rest[: 2 * count])):
        return rest
    taken = []
    for i, word in enumerate(words):
        kind = records.Kind.INT if i < 2 * count else records.Kind.FLOAT
        read = records.prefix(kind, word.group())
        if read != word.group():
            context.fault(
                faults.LOOSELY_READ_RECORD, context.lines.part(line, word.start(), word.end()),
                f'surface {subject.index}: expected {kind.value}, but found "{word.group()}"; the engine reads {read}',
                "write the value that you mean", subject,
            )  # fmt: skip
        taken.append(read)
    return taken


def _is_whole(text: str) -> bool:
    return text.lstrip("+-").isdigit()


def _light(context: Context, line: int, count: int, light: Sequence[str], subject: Subject) -> Sequence[str]:
    """The intensities of a surface: four a corner where there are so many, else one."""
    wanted = LIGHTS_PER_CORNER_RGB * count if len(light) >= LIGHTS_PER_CORNER_RGB * count else count
    if len(light) != wanted:
        less = len(light) < wanted
        context.fault(
            faults.LOOSELY_READ_RECORD, line,
            f"surface {subject.index} has {count} vertices, but {len(light)} intensities",
            ("write one for each vertex; the engine takes left-over values for the rest" if less
             else "remove what the engine does not read"), subject,
        )  # fmt: skip
    return [*light[:wanted], *["0"] * (wanted - len(light))]


def _normals(context: Context, surfaces: int) -> Normals:
    rows = Rows(records.NORMAL)
    while not context.at_boundary():
        rows.add(context.at, context.record(records.NORMAL, Subject("normal", len(rows))))
    if len(rows) != surfaces:
        place = rows.lines[-1] if len(rows) else max(0, context.at - 1)
        context.fault(
            faults.COUNT_MISMATCH, place, f"there are {surfaces} surfaces, but {len(rows)} normals",
            "write one normal a surface; the engine refuses the level",
        )  # fmt: skip
    table = Normals(None, rows.line_column(), rows.broken(), rows.float_columns("x", 3))
    context.outside(rows, "normal")
    return table
