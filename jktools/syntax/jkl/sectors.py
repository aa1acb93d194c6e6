"""SECTORS: blocks of lines in a fixed order."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_text import read_sectors as native_read_sectors  # noqa: TID251 (this package is the door)
from jktools.diagnostics import Subject
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context, quote
from jktools.syntax.jkl.document import Heading, Int32, Sectors
from jktools.syntax.jkl.records import OPTIONAL_SECTOR_LINES, SECTOR_LINES
from jktools.syntax.lines import END, SECTION
from jktools.syntax.rows import floats, ints, merge

_ORDER = tuple(SECTOR_LINES)

_INTS = MappingProxyType({"flags": (0, 16), "colormap": (1, 10), "surface_range": (2, 10)})
"""Place of each line's first whole number in the native reader's rows, and its base."""

_FLOATS = MappingProxyType({
    "ambient_light": 0, "extra_light": 1, "tint": 2, "bound_box": 5, "collide_box": 11, "sector_sound": 17,
    "center": 18, "radius": 21,
})  # fmt: skip
"""Place of each line's first decimal in the native reader's rows (native/text/records.hpp)."""

_INT_COUNT, _FLOAT_COUNT = 4, 22
_MISSING_FLOATS = np.full(_FLOAT_COUNT, np.nan, np.float32)
_MISSING_FLOATS[[2, 3, 4, 17]] = 0  # tint and sound volume


class _Native(NamedTuple):
    """What the native reader took."""

    first_line: npt.NDArray[np.int64]
    recognised: npt.NDArray[np.uint8]
    ints: npt.NDArray[np.int64]
    floats: npt.NDArray[np.float32]
    sound: npt.NDArray[np.int64]
    line_of: npt.NDArray[np.int32]
    vertex_start: npt.NDArray[np.int32]
    vertex: npt.NDArray[np.int32]
    vertex_line: npt.NDArray[np.int32]


class _Sector:
    """The lines of one sector as the grammar reads them."""

    def __init__(self, line: int, index: int) -> None:
        self.line = line
        self.subject = Subject("sector", index)
        self.fields: dict[str, Sequence[str]] = {}
        self.lines: dict[str, int] = {"sector": line}
        self.latest = 0
        self.vertices: list[tuple[int, int]] = []
        """Vertex and logical line."""
        self.broken = False


def read_sectors(context: Context) -> Sectors:
    """Read the section behind its `section:` line."""
    heading = context.heading("world sectors")
    first, last = context.at, context.lines.next_of(SECTION | END, context.at)
    start = min(context.lines.next_sector(first), last)
    _Slow(context, first, start, 0).read()
    fast = _Native(*native_read_sectors(
        context.lines.octets, context.lines.start[start:last], context.lines.end[start:last]
    ))  # fmt: skip
    slow = _read_slow(context, fast, start, last)
    if slow is None:  # a line joined over several physical ones: the native reader cannot tell the sectors apart
        table = _table(context, heading, _nothing(), 0, dict(enumerate(_Slow(context, start, last, 0).read())))
    else:
        table = _table(context, heading, fast, start, slow)
    context.at = last
    if context.at_end_word():
        context.at += 1
    context.counted(heading, "sectors", len(table))
    return table


def _nothing() -> _Native:
    octets, offsets = np.zeros(0, np.uint8), np.zeros(0, np.int64)
    return _Native(*native_read_sectors(octets, offsets, offsets))


def _read_slow(context: Context, fast: _Native, start: int, last: int) -> dict[int, _Sector] | None:
    """The sectors that the native reader did not take, by index; None when lines are joined."""
    if (context.lines.end[start:last] < 0).any():
        return None
    wanted = range(len(fast.recognised)) if context.strict else np.flatnonzero(fast.recognised == 0).tolist()
    slow = {}
    for index in wanted:
        begin, end = start + int(fast.first_line[index]), start + int(fast.first_line[index + 1])
        (slow[index],) = _Slow(context, begin, end, index).read()
    return slow


class _Slow:
    """Reads lines as sectors with the grammar, and tells what is wrong with them."""

    def __init__(self, context: Context, first: int, last: int, index: int) -> None:
        """Read the logical lines from `first` up to `last`; the first sector has this index."""
        self.context = context
        self.at, self.last = first, last
        self.index = index
        self.sectors: list[_Sector] = []

    def read(self) -> list[_Sector]:
        """Every sector that starts on these lines."""
        while self.at < self.last:
            self._line()
        for sector in self.sectors:
            self._close(sector)
        return self.sectors

    def _line(self) -> None:
        line, text = self.at, self.context.lines.text(self.at)
        self.at += 1
        alias = _alias(text)
        if alias == "sector":
            self.sectors.append(_Sector(line, self.index + len(self.sectors)))
            self.context.record(SECTOR_LINES[alias], line, self.sectors[-1].subject)
        elif alias is None or not self.sectors:
            self._unexpected(line, text)
        else:
            self._keyed(self.sectors[-1], alias, line, text)

    def _unexpected(self, line: int, text: str) -> None:
        sector = self.sectors[-1] if self.sectors else None
        wanted = '"sector"'
        if sector is not None:
            wanted = f'"{SECTOR_LINES[_ORDER[min(sector.latest + 1, len(_ORDER) - 1)]].keyword}"'
        self.context.fault(
            faults.MALFORMED_RECORD, line, f"expected the line {wanted}, but found {quote(text)}",
            "remove the line or mend it; the engine refuses a level with such a line",
            sector.subject if sector else None,
        )  # fmt: skip

    def _keyed(self, sector: _Sector, alias: str, line: int, text: str) -> None:
        fields = self.context.record(SECTOR_LINES[alias], line, sector.subject)
        self._check_order(sector, alias, line)
        if alias == "sector_sound" and text[:1].isspace():
            self.context.fault(
                faults.MALFORMED_RECORD, line,
                f'the line "sound" of sector {sector.subject.index} starts with a blank, but the engine takes none',
                "remove the blank; the engine refuses the level", sector.subject,
            )  # fmt: skip
        sector.lines[alias] = line
        if fields is None:
            sector.broken = True
            return
        sector.fields[alias] = fields
        if alias == "vertex_count":
            self._vertices(sector, int(fields[0]))

    def _check_order(self, sector: _Sector, alias: str, line: int) -> None:
        place = _ORDER.index(alias)
        if place <= sector.latest:
            after = SECTOR_LINES[_ORDER[sector.latest]].keyword
            self.context.fault(
                faults.MALFORMED_RECORD, line,
                f'sector {sector.subject.index} has "{SECTOR_LINES[alias].keyword}" after "{after}", '
                "but the engine reads a sector's lines in a fixed order",
                "move the line to its place; the engine refuses the level", sector.subject,
            )  # fmt: skip
        sector.latest = max(sector.latest, place)

    def _vertices(self, sector: _Sector, announced: int) -> None:
        while self.at < self.last and _alias(self.context.lines.text(self.at)) is None:
            fields = self.context.record(records.SECTOR_VERTEX, self.at, sector.subject)
            sector.vertices.append((ints([fields[1]])[0][0] if fields else 0, self.at))
            sector.broken |= fields is None
            self.at += 1
        self.context.counted(Heading(sector.lines["vertex_count"], announced), "vertices", len(sector.vertices))

    def _close(self, sector: _Sector) -> None:
        missing = [a for a in _ORDER if a not in sector.lines and a not in OPTIONAL_SECTOR_LINES]
        if missing:
            sector.broken = True
            wanted = ", ".join(f'"{SECTOR_LINES[a].keyword}"' for a in missing)
            self.context.fault(
                faults.MALFORMED_RECORD, sector.line, f"sector {sector.subject.index} lacks {wanted}",
                "write the missing lines; the engine refuses the level", sector.subject,
            )  # fmt: skip


def _alias(text: str) -> str | None:
    """Which sector line this is, by its keyword."""
    words = records.keywords(text)
    return next((alias for alias in _ORDER if words.startswith(SECTOR_LINES[alias].keyword + " ")), None)


def _table(context: Context, heading: Heading | None, fast: _Native, start: int, slow: dict[int, _Sector]) -> Sectors:
    """The columns: the native reader's rows, overlaid with what the grammar read."""
    count = max(len(fast.recognised), len(slow))
    whole = np.resize(fast.ints, count * _INT_COUNT).reshape(count, _INT_COUNT)
    decimal = np.resize(fast.floats, count * _FLOAT_COUNT).reshape(count, _FLOAT_COUNT)
    line_of = np.resize(fast.line_of, count * len(_ORDER)).reshape(count, len(_ORDER))
    line_of[line_of >= 0] += start
    text = context.source.text
    sound = [text[a:b] if a >= 0 else None for a, b in fast.sound.reshape(-1, 2).tolist()]
    sound += [None] * (count - len(sound))
    for index, sector in slow.items():
        whole[index], decimal[index] = _values(context, sector)
        line_of[index] = [sector.lines.get(alias, -1) for alias in _ORDER]
        sound[index] = str(sector.fields["sector_sound"][0]) if "sector_sound" in sector.fields else None
    vertex_start, vertex, vertex_lines = _vertex_lists(fast, start, slow, count)
    broken = np.zeros(count, np.bool_)
    broken[[index for index, sector in slow.items() if sector.broken]] = True
    columns = {alias: np.ascontiguousarray(line_of[:, i]) for i, alias in enumerate(_ORDER)}
    return Sectors(
        heading,
        columns["sector"],
        broken,
        flags=whole[:, 0].astype(np.uint32),
        ambient_light=np.ascontiguousarray(decimal[:, 0]),
        extra_light=np.ascontiguousarray(decimal[:, 1]),
        colormap=whole[:, 1].astype(np.int32),
        tint=np.ascontiguousarray(decimal[:, 2:5]),
        bound_box=np.ascontiguousarray(decimal[:, 5:11]),
        collide_box=np.ascontiguousarray(decimal[:, 11:17]),
        sound=tuple(sound),
        sound_volume=np.ascontiguousarray(decimal[:, 17]),
        center=np.ascontiguousarray(decimal[:, 18:21]),
        radius=np.ascontiguousarray(decimal[:, 21]),
        vertex_start=vertex_start,
        vertex=vertex,
        vertex_lines=vertex_lines,
        first_surface=whole[:, 2].astype(np.int32),
        surface_count=whole[:, 3].astype(np.int32),
        line_of=MappingProxyType(columns),
    )


def _values(context: Context, sector: _Sector) -> tuple[list[int], npt.NDArray[np.float32]]:
    """A sector's whole numbers and decimals in the native reader's order."""
    whole, decimal = [0] * _INT_COUNT, _MISSING_FLOATS.copy()
    for alias, (place, base) in _INTS.items():
        if alias in sector.fields:
            values, outside = ints(list(map(str, sector.fields[alias])), base)
            whole[place : place + len(values)] = values
            for i in outside:
                name = SECTOR_LINES[alias].fields[i].name
                context.beyond(sector.lines[alias], "sector", sector.subject.index, name, str(sector.fields[alias][i]))
    for alias, place in _FLOATS.items():
        if alias in sector.fields:
            texts = [str(t) for t in sector.fields[alias]][alias == "sector_sound" :]
            decimal[place : place + len(texts)] = floats(texts)
    return whole, decimal


def _vertex_lists(fast: _Native, start: int, slow: dict[int, _Sector], count: int) -> tuple[Int32, Int32, Int32]:
    """`vertex_start`, the vertices and their logical lines."""
    begin = np.resize(fast.vertex_start, count + 1)
    begin[len(fast.vertex_start) :] = fast.vertex_start[-1]
    rows, vertex = merge(begin, fast.vertex, {i: [v for v, _ in s.vertices] for i, s in slow.items()})
    _, lines = merge(begin, fast.vertex_line + start, {i: [line for _, line in s.vertices] for i, s in slow.items()})
    return rows, vertex, lines.astype(np.int32)
