"""Logical lines of a game text file: comments cut, continuations joined, as the engine reads them."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from jktools._native_text import (  # noqa: TID251 (this package is the door)
    BLANK,
    COMMENT_IN_WORD,
    CUT,
    END,
    SECTION,
    SECTOR,
    TAIL,
    WORLD,
    line_kinds,
    logical_lines,
    word_counts,
)
from jktools.source import Source, Span

BUFFER_SIZE: Mapping[str, int] = MappingProxyType({"jk": 1024, "mots": 2048})
"""Bytes of the engine's line buffer, by game (stdConffile in the decompiled engine)."""

_SEPARATOR = r"[ \t\r\f\v,]"
_WORD = r"[^ \t\r\f\v,]"
_JOINED_KINDS = (
    (rf"{_SEPARATOR}*$", BLANK),
    (rf"{_SEPARATOR}*section:", SECTION),
    (rf"{_SEPARATOR}*world{_SEPARATOR}+{_WORD}", WORLD),
    (rf"{_SEPARATOR}*end(?!{_WORD})", END),
    (rf"{_SEPARATOR}*sector(?!{_WORD})", SECTOR),
)
"""What the native reader says of a line, for the few that are joined from several physical ones."""

Int64 = npt.NDArray[np.int64]
UInt8 = npt.NDArray[np.uint8]


class LogicalLines:
    """The logical lines of a source; a line is known by its index from 0."""

    def __init__(self, source: Source, game: str) -> None:
        """Cut `source` as the engine of `game` does."""
        self.source = source
        self.buffer_size = BUFFER_SIZE[game]
        self.octets: UInt8 = np.frombuffer(source.data, np.uint8)
        self._segments, self._segment_start, self._segment_end, self._flags = logical_lines(
            self.octets, self.buffer_size
        )
        first = self._segments[:-1]
        self.start: Int64 = self._segment_start[first]
        self.end: Int64 = np.where(np.diff(self._segments) == 1, self._segment_end[first], -1)
        """Byte range of each line; a line joined from several physical ones has the end -1."""
        self.kinds: UInt8 = self._kinds()
        self._marks: list[int] = np.flatnonzero(self.kinds & (SECTION | WORLD | END)).tolist()
        self._sectors: list[int] = np.flatnonzero(self.kinds & SECTOR).tolist()

    def _kinds(self) -> UInt8:
        kinds = line_kinds(self.octets, self.start, self.end)
        for line in np.flatnonzero(self.end < 0).tolist():
            text = self.text(line)
            kinds[line] = next((k for p, k in _JOINED_KINDS if re.match(p, text, re.IGNORECASE)), 0)
        return kinds

    def __len__(self) -> int:
        return len(self.start)

    def next_sector(self, line: int) -> int:
        """The first line from `line` on that starts a sector, or the number of lines."""
        at = bisect_left(self._sectors, line)
        return self._sectors[at] if at < len(self._sectors) else len(self)

    def next_of(self, kinds: int, line: int) -> int:
        """The first line from `line` on that is of one of the kinds SECTION, WORLD, END, or the number of lines."""
        for at in range(bisect_left(self._marks, line), len(self._marks)):
            if self.kinds[self._marks[at]] & kinds:
                return self._marks[at]
        return len(self)

    def word_counts(self, lines: npt.NDArray[np.intp]) -> npt.NDArray[np.int32]:
        """How many fields each of some lines has; commas part them."""
        counts = word_counts(self.octets, self.start[lines], self.end[lines])
        for i in np.flatnonzero(self.end[lines] < 0).tolist():
            counts[i] = len(re.findall(f"{_WORD}+", self.text(int(lines[i]))))
        return counts

    def text(self, line: int) -> str:
        """The line as the engine sees it."""
        start, end = int(self.start[line]), int(self.end[line])
        text = self.source.text
        if end >= 0:
            return text[start:end]
        return "".join(text[self._segment_start[k] : self._segment_end[k]] for k in self._parts(line))

    def _parts(self, line: int) -> range:
        return range(int(self._segments[line]), int(self._segments[line + 1]))

    def span(self, line: int) -> Span:
        """The bytes of a line without blanks at its ends; continuation marks between its parts are included."""
        whole = self.source.span(int(self.start[line]), int(self._segment_end[self._parts(line)[-1]]))
        text = whole.text
        start = whole.start + len(text) - len(text.lstrip())
        return self.source.span(start, max(start, whole.start + len(text.rstrip())))

    def behind(self, line: int) -> int:
        """Where the engine's file pointer stands after a line: behind its line feed, or in a line that is too long."""
        last = self._parts(line)[-1]
        start, end = int(self._segment_start[last]), int(self._segment_end[last])
        most = min(start + self.buffer_size - 1, len(self.source.data))
        feed = self.source.text.find("\n", end, most)
        return most if feed < 0 else feed + 1

    def part(self, line: int, start: int, end: int) -> Span:
        """The bytes behind the characters `start` to `end` of `text(line)`."""
        return self.source.span(self._offset(line, start), self._offset(line, max(start, end - 1)) + (end > start))

    def _offset(self, line: int, at: int) -> int:
        for k in self._parts(line):
            size = int(self._segment_end[k] - self._segment_start[k])
            if at < size:
                return int(self._segment_start[k]) + at
            at -= size
        return int(self._segment_end[self._parts(line)[-1]])

    def cut_lines(self) -> list[int]:
        """Lines that are the head of a physical line longer than the engine's buffer."""
        return self._flagged(CUT, without=TAIL)

    def lines_with_comment_in_word(self) -> list[int]:
        """Lines in which a `#` directly follows a word, as in `1.#QNAN`."""
        return self._flagged(COMMENT_IN_WORD)

    def _flagged(self, flag: int, without: int = 0) -> list[int]:
        return np.flatnonzero((self._flags & flag != 0) & (self._flags & without == 0)).tolist()


__all__ = ["BLANK", "BUFFER_SIZE", "END", "SECTION", "SECTOR", "WORLD", "LogicalLines"]
