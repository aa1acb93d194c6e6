"""Logical lines of a game text file: comments cut, continuations joined, as the engine reads them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from jktools._native_text import COMMENT_IN_WORD, CUT, TAIL, logical_lines  # noqa: TID251 (this package is the door)
from jktools.source import Source, Span

BUFFER_SIZE: Mapping[str, int] = MappingProxyType({"jk": 1024, "mots": 2048})
"""Bytes of the engine's line buffer, by game (stdConffile in the decompiled engine)."""


class LogicalLines:
    """The logical lines of a source; a line is known by its index from 0."""

    def __init__(self, source: Source, game: str) -> None:
        """Cut `source` as the engine of `game` does."""
        self.source = source
        self.buffer_size = BUFFER_SIZE[game]
        octets = np.frombuffer(source.data, np.uint8)
        segments, starts, ends, self._flags = logical_lines(octets, self.buffer_size)
        self._segments: list[int] = segments.tolist()
        self._starts: list[int] = starts.tolist()
        self._ends: list[int] = ends.tolist()

    def __len__(self) -> int:
        return len(self._segments) - 1

    def text(self, line: int) -> str:
        """The line as the engine sees it."""
        first, last = self._segments[line], self._segments[line + 1]
        text = self.source.text
        if last - first == 1:
            return text[self._starts[first] : self._ends[first]]
        return "".join(text[self._starts[k] : self._ends[k]] for k in range(first, last))

    def span(self, line: int) -> Span:
        """The bytes of a line without blanks at its ends; continuation marks between its parts are included."""
        first, last = self._segments[line], self._segments[line + 1]
        whole = self.source.span(self._starts[first], self._ends[last - 1])
        text = whole.text
        return self.source.span(
            whole.start + len(text) - len(text.lstrip()),
            max(whole.start, whole.end - len(text) + len(text.rstrip())),
        )

    def part(self, line: int, start: int, end: int) -> Span:
        """The bytes behind the characters `start` to `end` of `text(line)`."""
        return self.source.span(self._offset(line, start), self._offset(line, max(start, end - 1)) + (end > start))

    def _offset(self, line: int, at: int) -> int:
        for k in range(self._segments[line], self._segments[line + 1]):
            size = self._ends[k] - self._starts[k]
            if at < size:
                return self._starts[k] + at
            at -= size
        return self._ends[self._segments[line + 1] - 1]

    def cut_lines(self) -> list[int]:
        """Lines that are the head of a physical line longer than the engine's buffer."""
        return self._flagged(CUT, without=TAIL)

    def lines_with_comment_in_word(self) -> list[int]:
        """Lines in which a `#` directly follows a word, as in `1.#QNAN`."""
        return self._flagged(COMMENT_IN_WORD)

    def _flagged(self, flag: int, without: int = 0) -> list[int]:
        return np.flatnonzero((self._flags & flag != 0) & (self._flags & without == 0)).tolist()
