"""A file's bytes with positions in them."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np


class Position(NamedTuple):
    """A place for people: line and column count from 1, a column is one byte (a tab too)."""

    line: int
    column: int


class Source:
    """One file: where it came from and its bytes, never re-encoded.

    The game's files are Latin-1 (or CP-1252, which agrees with it wherever the formats care); decoded
    that way every byte is one character and offsets in `text` are offsets in `data`.
    """

    def __init__(
        self, path: str, data: bytes | memoryview, name: str | None = None, declared: int | None = None
    ) -> None:
        """Take `path` as users wrote it (`pack.gob!jkl/x.jkl`) and the bytes, which may be a mapped view.

        `name` is the file's path inside its pack, or its base name: what stays the same on every machine.
        `declared` is its size by the pack's directory, where the pack may be cut off.
        """
        self.path = path
        self.name = path if name is None else name
        self.data = memoryview(data)
        self.declared = len(self.data) if declared is None else declared

    def __repr__(self) -> str:
        return f"Source({self.path!r}, {len(self.data)} bytes)"

    @cached_property
    def text(self) -> str:
        """The whole file as text, one character a byte."""
        return str(self.data, "latin-1")

    @cached_property
    def _line_starts(self) -> list[int]:
        feeds = np.flatnonzero(np.frombuffer(self.data, np.uint8) == ord("\n"))
        return [0, *(feeds + 1).tolist()]

    def position(self, offset: int) -> Position:
        """Line and column of a byte offset; the end of the file is a valid offset."""
        line = bisect_right(self._line_starts, offset)
        return Position(line, offset - self._line_starts[line - 1] + 1)

    def offset(self, line: int) -> int:
        """Byte offset at which a line (from 1) starts."""
        return self._line_starts[line - 1]

    def line_span(self, line: int) -> Span:
        """A physical line (from 1) without its line end."""
        start, starts = self._line_starts[line - 1], self._line_starts
        end = starts[line] if line < len(starts) else len(self.data)
        while end > start and self.data[end - 1] in b"\r\n":
            end -= 1
        return self.span(start, end)

    def line(self, line: int) -> str:
        """The text of a physical line (from 1) without its line end."""
        return self.line_span(line).text

    def span(self, start: int, end: int) -> Span:
        """The bytes from `start` up to, not including, `end`."""
        return Span(self, start, end)


@dataclass(frozen=True, slots=True)
class Span:
    """A half-open range of bytes in a source. Lines and columns are worked out only on output."""

    source: Source
    start: int
    end: int

    @property
    def text(self) -> str:
        """What stands there."""
        return str(self.source.data[self.start : self.end], "latin-1")

    @property
    def first(self) -> Position:
        """Where it starts."""
        return self.source.position(self.start)

    @property
    def last(self) -> Position:
        """Where it ends, exclusive."""
        return self.source.position(self.end)

    @staticmethod
    def over(spans: list[Span]) -> Span:
        """The least span that covers spans of one source, given in order."""
        assert all(a.source is b.source for a, b in pairwise(spans))
        return Span(spans[0].source, spans[0].start, spans[-1].end)
