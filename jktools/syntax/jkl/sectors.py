"""SECTORS: blocks of lines in a fixed order."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from jktools.diagnostics import Subject
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context, quote
from jktools.syntax.jkl.document import Float32, Heading, Int32, Sectors
from jktools.syntax.jkl.records import OPTIONAL_SECTOR_LINES, SECTOR_LINES
from jktools.syntax.jkl.rows import Rows, floats, ints

_ORDER = tuple(SECTOR_LINES)


class _Sector:
    """The lines of one sector as they come in."""

    def __init__(self, line: int, index: int) -> None:
        self.line = line
        self.subject = Subject("sector", index)
        self.fields: dict[str, Sequence[str]] = {}
        self.lines: dict[str, int] = {"sector": line}
        self.latest = 0
        self.vertices: Rows = Rows(records.SECTOR_VERTEX)
        self.broken = False


def read_sectors(context: Context) -> Sectors:
    """Read the section behind its `section:` line."""
    heading = context.heading("world sectors")
    sectors: list[_Sector] = []
    while not context.at_section() and not context.at_end_word():
        _line(context, sectors)
    if sectors:
        _close(context, sectors[-1])
    if context.at_end_word():
        context.at += 1
    context.counted(heading, "sectors", len(sectors))
    return _table(context, heading, sectors)


def _line(context: Context, sectors: list[_Sector]) -> None:
    line, text = context.at, context.text()
    alias = _alias(text)
    if alias == "sector":
        if sectors:
            _close(context, sectors[-1])
        sectors.append(_Sector(line, len(sectors)))
        context.record(SECTOR_LINES[alias], sectors[-1].subject)
        return
    if alias is None or not sectors:
        context.at += 1
        wanted = 'the line "sector 0"' if not sectors else f'"{SECTOR_LINES[_next(sectors[-1])].keyword}"'
        subject = sectors[-1].subject if sectors else None
        context.fault(
            faults.MALFORMED_RECORD, line, f"expected {wanted}, but found {quote(text)}",
            "remove the line or mend it; the engine refuses a level with such a line", subject,
        )  # fmt: skip
        return
    sector = sectors[-1]
    fields = context.record(SECTOR_LINES[alias], sector.subject)
    _check_order(context, sector, alias, line)
    sector.lines[alias] = line
    if fields is None:
        sector.broken = True
        return
    sector.fields[alias] = fields
    if alias == "vertex_count":
        _vertices(context, sector, int(fields[0]))


def _alias(text: str) -> str | None:
    """Which sector line this is, by its keyword."""
    words = " ".join(text.lower().split()) + " "
    return next((alias for alias in _ORDER if words.startswith(SECTOR_LINES[alias].keyword + " ")), None)


def _next(sector: _Sector) -> str:
    return _ORDER[min(sector.latest + 1, len(_ORDER) - 1)]


def _check_order(context: Context, sector: _Sector, alias: str, line: int) -> None:
    place = _ORDER.index(alias)
    if place <= sector.latest:
        after = SECTOR_LINES[_ORDER[sector.latest]].keyword
        context.fault(
            faults.MALFORMED_RECORD, line,
            f'sector {sector.subject.index} has "{SECTOR_LINES[alias].keyword}" after "{after}", '
            "but the engine reads a sector's lines in a fixed order",
            "move the line to its place; the engine refuses the level", sector.subject,
        )  # fmt: skip
    sector.latest = max(sector.latest, place)


def _vertices(context: Context, sector: _Sector, announced: int) -> None:
    rows = sector.vertices
    while not context.at_boundary() and _alias(context.text()) is None:
        rows.add(context.at, context.record(records.SECTOR_VERTEX, sector.subject))
    context.counted(Heading(sector.lines["vertex_count"], announced), "vertices", len(rows))


def _close(context: Context, sector: _Sector) -> None:
    missing = [a for a in _ORDER if a not in sector.lines and a not in OPTIONAL_SECTOR_LINES]
    if missing:
        sector.broken = True
        wanted = ", ".join(f'"{SECTOR_LINES[a].keyword}"' for a in missing)
        context.fault(
            faults.MALFORMED_RECORD, sector.line, f"sector {sector.subject.index} lacks {wanted}",
            "write the missing lines; the engine refuses the level", sector.subject,
        )  # fmt: skip


def _table(context: Context, heading: Heading | None, sectors: list[_Sector]) -> Sectors:
    def texts(alias: str, missing: str) -> list[str]:
        stand_in = [missing] * len(SECTOR_LINES[alias].fields)
        return [text for s in sectors for text in s.fields.get(alias, stand_in)]

    def decimal(alias: str, missing: str = "nan") -> Float32:
        values = floats(texts(alias, missing))
        width = len(SECTOR_LINES[alias].fields)
        return values if width == 1 else values.reshape(-1, width)

    def whole(alias: str, missing: str = "0", base: int = 10) -> list[int]:
        values, outside = ints(texts(alias, missing), base)
        width = len(SECTOR_LINES[alias].fields)
        for i in outside:
            sector = sectors[i // width]
            context.fault(
                faults.LOOSELY_READ_RECORD, sector.lines[alias],
                f"sector {i // width} has a number that the engine's 32 bits cannot hold",
                "write a number that fits", sector.subject,
            )  # fmt: skip
        return values

    def lines(alias: str) -> Int32:
        return np.array([s.lines.get(alias, -1) for s in sectors], np.int32)

    range_ = np.array(whole("surface_range"), np.int32).reshape(-1, 2)
    broken = np.array([s.broken for s in sectors], np.bool_)
    vertices, _ = ints([row[1] for s in sectors for row in s.vertices.fields])
    return Sectors(
        heading,
        lines("sector"),
        broken,
        flags=np.array(whole("flags", base=16), np.uint32),
        ambient_light=decimal("ambient_light"),
        extra_light=decimal("extra_light"),
        colormap=np.array(whole("colormap"), np.int32),
        tint=decimal("tint", "0"),
        bound_box=decimal("bound_box"),
        collide_box=decimal("collide_box"),
        sound=tuple(str(s.fields["sector_sound"][0]) if "sector_sound" in s.fields else None for s in sectors),
        sound_volume=floats([str(s.fields["sector_sound"][1]) if "sector_sound" in s.fields else "0" for s in sectors]),
        center=decimal("center"),
        radius=decimal("radius"),
        vertex_start=np.array(np.cumsum([0, *(len(s.vertices) for s in sectors)]), np.int32),
        vertex=np.array(vertices, np.int32),
        vertex_lines=np.array([line for s in sectors for line in s.vertices.lines], np.int32),
        first_surface=np.ascontiguousarray(range_[:, 0]),
        surface_count=np.ascontiguousarray(range_[:, 1]),
        line_of=MappingProxyType({alias: lines(alias) for alias in _ORDER}),
    )
