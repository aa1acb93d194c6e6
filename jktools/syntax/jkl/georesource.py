"""GEORESOURCE: colormaps, vertices, texture vertices, adjoins, surfaces and their normals."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_text import read_surfaces  # noqa: TID251 (this package is the door)
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
from jktools.syntax.lines import END, SECTION, WORLD
from jktools.syntax.rows import Rows, floats, ints, merge

LIGHTS_PER_CORNER_RGB = 4
"""Mysteries of the Sith writes mono, red, green and blue for each corner."""

_FEWEST_SURFACE_WORDS = len(records.SURFACE.fields)
_SURFACE_INTS = 9
_EXTRA_LIGHT = records.SURFACE.ordinal("extra light")


class SurfaceRecords(NamedTuple):
    """What the native reader took (native/text/records.hpp)."""

    recognised: npt.NDArray[np.uint8]
    ints: npt.NDArray[np.int64]
    extra_light: npt.NDArray[np.float32]
    corner_start: npt.NDArray[np.int32]
    pairs: npt.NDArray[np.int32]
    light_start: npt.NDArray[np.int32]
    light: npt.NDArray[np.float32]


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


_HEADING_TAIL = re.compile(r"(colormaps|vertices|adjoins|surfaces)[ \t]+[0-9]+[ \t\r]*$", re.IGNORECASE)

_BOUNDARY = SECTION | WORLD | END
"""What ends a block: whatever cannot be a record of it."""


def _block(context: Context, words: str, record: Record, kind: str) -> tuple[Heading | None, Rows]:
    """Read the records behind a heading."""
    heading = context.heading(words)
    first = context.at
    lines = context.block(_BOUNDARY, blank=record.scanned)
    misspelt = _misspelt_heading(context, lines)
    if misspelt is not None:
        lines, context.at = lines[lines < misspelt], max(first, misspelt)
    return heading, context.rows(record, kind, lines)


def _misspelt_heading(context: Context, lines: npt.NDArray[np.intp]) -> int | None:
    """The first of some lines that is a heading but for its spelling: without this it would hide all that follows.

    Records start with a digit, so that few lines are looked at.
    """
    starts = context.lines.start[lines]
    letters = np.flatnonzero(context.lines.octets[np.minimum(starts, len(context.lines.octets) - 1)] >= ord("A"))
    for i in letters.tolist():
        if _HEADING_TAIL.search(context.lines.text(int(lines[i]))):
            return int(lines[i])
    return None


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


def _surfaces(context: Context) -> Surfaces:
    heading = context.heading("world surfaces")
    lines = _surface_lines(context, heading)
    fast = SurfaceRecords(*read_surfaces(context.lines.octets, context.lines.start[lines], context.lines.end[lines]))
    recognised = fast.recognised if not context.strict else np.zeros_like(fast.recognised)
    slow = _read_slow(context, lines, np.flatnonzero(recognised == 0).tolist())
    context.counted(heading, "surfaces", len(lines))
    fields = {row: each.fields for row, each in slow.items()}

    def whole(place: int, ordinal: int, base: int = 10) -> npt.NDArray[np.int64]:
        column = fast.ints.reshape(-1, _SURFACE_INTS)[:, place].copy()
        values, outside = ints([fields[row][ordinal] for row in slow], base)
        column[list(slow)] = values
        for i in outside:
            row = list(slow)[i]
            name = records.SURFACE.fields[ordinal].name
            context.beyond(int(lines[row]), "surface", row, name, str(fields[row][ordinal]))
        return column

    corner_start, pairs = merge(
        fast.corner_start, fast.pairs.reshape(-1, 2), {row: each.corners for row, each in slow.items()}
    )
    light_start, light = merge(fast.light_start, fast.light, {row: each.light for row, each in slow.items()})
    extra_light = fast.extra_light
    extra_light[list(slow)] = floats([fields[row][_EXTRA_LIGHT] for row in slow])
    broken = np.zeros(len(lines), np.bool_)
    broken[[row for row, each in slow.items() if each.broken]] = True
    return Surfaces(
        heading,
        lines.astype(np.int32),
        broken,
        material=whole(1, 1).astype(np.int32),
        flags=whole(2, 2, 16).astype(np.uint32),
        face_flags=whole(3, 3, 16).astype(np.uint32),
        geometry_mode=whole(4, 4).astype(np.int32),
        light_mode=whole(5, 5).astype(np.int32),
        texture_mode=whole(6, 6).astype(np.int32),
        adjoin=whole(7, 7).astype(np.int32),
        extra_light=extra_light,
        corner_start=corner_start,
        corner_vertex=np.ascontiguousarray(pairs[:, 0]),
        corner_texture_vertex=np.ascontiguousarray(pairs[:, 1]),
        light_start=light_start,
        light=light,
    )


def _surface_lines(context: Context, heading: Heading | None) -> npt.NDArray[np.intp]:
    """The lines of the surfaces. The normals behind them have no heading of their own, but fewer words.

    Where fewer surfaces than announced have been seen, a short line may be a broken surface: the next line decides.
    """
    first = context.at
    lines = context.block(_BOUNDARY, blank=False)
    short = context.lines.word_counts(lines) < _FEWEST_SURFACE_WORDS
    announced = len(lines) if heading is None else heading.count
    ends = short & ((np.arange(len(lines)) >= announced) | np.append(short[1:], True))
    if ends.any():
        lines = lines[: int(ends.argmax())]
    context.at = int(lines[-1]) + 1 if len(lines) else first
    return lines


class _Slow(NamedTuple):
    """A surface as the grammar read it."""

    fields: Sequence[str]
    corners: list[tuple[int, int]]
    light: list[float]
    broken: bool


_BROKEN = _Slow(("0:", "0", "0", "0", "0", "0", "0", "0", "nan", "0"), [], [], True)


def _read_slow(context: Context, lines: npt.NDArray[np.intp], rows: list[int]) -> dict[int, _Slow]:
    slow = {}
    for row in rows:
        line, subject = int(lines[row]), Subject("surface", row)
        fields = context.record(records.SURFACE, line, subject)
        tail = None if fields is None else _tail(context, line, fields, subject)
        if fields is None or tail is None:
            slow[row] = _BROKEN
        else:
            indices = ints(tail[0])[0]
            corners = list(zip(indices[::2], indices[1::2], strict=True))
            slow[row] = _Slow(fields[:_FEWEST_SURFACE_WORDS], corners, floats(tail[1]).tolist(), False)
    return slow


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
    words = list(re.finditer(r"[^ \t\r\f\v,]+", context.lines.text(line)))[_FEWEST_SURFACE_WORDS:]
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
    rows = context.rows(records.NORMAL, "normal", context.block(_BOUNDARY))
    if len(rows) != surfaces:
        place = int(rows.lines[-1]) if len(rows) else max(0, context.at - 1)
        context.fault(
            faults.COUNT_MISMATCH, place, f"there are {surfaces} surfaces, but {len(rows)} normals",
            "write one normal a surface; the engine refuses the level",
        )  # fmt: skip
    table = Normals(None, rows.line_column(), rows.broken(), rows.float_columns("x", 3))
    context.outside(rows, "normal")
    return table
