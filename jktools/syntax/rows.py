"""The records of one kind as columns: what the native reader takes to the letter, and the grammar the rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_text import decimals, read_fields  # noqa: TID251 (this package is the door)
from jktools.syntax.arrays import Bool, Float32, Int32, UInt32
from jktools.syntax.lines import LogicalLines
from jktools.syntax.records import Kind, Record

INT32_LEAST, INT32_MOST = -(2**31), 2**31 - 1
UINT32_MOST = 2**32 - 1

_STAND_IN = {Kind.LABEL: "0:", Kind.INT: "0", Kind.HEX: "0", Kind.FLOAT: "nan", Kind.WORD: ""}
_WHOLE = (Kind.LABEL, Kind.INT, Kind.HEX)

Lines = npt.NDArray[np.intp]
ReadOne = Callable[[int, int], Sequence[str] | None]
"""Reads the record of a row (its index, its logical line) with the grammar; None for one that is broken."""


def floats(texts: Sequence[str]) -> Float32:
    """Decimals as float32, each rounded once. Raises ValueError."""
    return decimals(np.frombuffer(" ".join(texts).encode("ascii"), np.uint8))


def ints(texts: Sequence[str], base: int = 10) -> tuple[list[int], list[int]]:
    """Whole numbers held within the engine's 32 bits, and the positions of those that did not fit."""
    least, most = (INT32_LEAST, INT32_MOST) if base == 10 else (0, UINT32_MOST)
    values = [_whole(text, base) for text in texts]
    outside = [i for i, value in enumerate(values) if not least <= value <= most]
    for i in outside:
        values[i] = min(max(values[i], least), most)
    return values, outside


MOST_DIGITS = 40
"""Digits that are read; a number with more is beyond 32 bits whatever they are, and Python refuses thousands."""


def _whole(text: str, base: int) -> int:
    """A whole number; in hex a minus wraps around, as scanf has it."""
    negative = text.startswith("-")
    digits = text.lstrip("+-").lstrip("0") or "0"
    value = (
        int(digits if digits[:1] not in "xX" else "0" + digits, base) if len(digits) <= MOST_DIGITS else 10**MOST_DIGITS
    )
    if negative and base == 16:
        return (UINT32_MOST + 1 - value) % (UINT32_MOST + 1) if value <= UINT32_MOST else UINT32_MOST + 1
    return -value if negative else value


class _Fast(NamedTuple):
    """What the native reader took: whole numbers, decimals and words, a row a record."""

    ints: npt.NDArray[np.int64]
    floats: Float32
    words: npt.NDArray[np.int64]
    tail_start: npt.NDArray[np.int64]
    tail: npt.NDArray[np.int64]


class Rows:
    """The records of one table as they were read, broken ones included."""

    def __init__(self, record: Record, lines: LogicalLines, at: Lines, read_one: ReadOne, *, strict: bool) -> None:
        """Read the records on the logical lines `at`; with `strict` the grammar reads them all."""
        self.record = record
        self.lines = at
        self._source = lines.source
        recognised, self._fast = _read_fast(record, lines, at)
        self.slow = (np.arange(len(at)) if strict else np.flatnonzero(recognised == 0)).tolist()
        self.fields: dict[int, Sequence[str]] = {}
        """What the grammar read, by row."""
        self._broken: list[int] = []
        self.outside: dict[int, str] = {}
        """Records with a number beyond the engine's, and the name of that field."""
        stand_in = tuple(_STAND_IN[f.kind] for f in record.fields)
        for row in self.slow:
            fields = read_one(row, int(at[row]))
            if fields is None:
                self._broken.append(row)
            self.fields[row] = stand_in if fields is None else fields

    def __len__(self) -> int:
        return len(self.lines)

    def line_column(self) -> Int32:
        """Logical line of each record."""
        return self.lines.astype(np.int32)

    def broken(self) -> Bool:
        """Which records are broken."""
        mask = np.zeros(len(self.lines), np.bool_)
        mask[self._broken] = True
        return mask

    def int_column(self, name: str) -> Int32:
        """A column of whole numbers, or of the labels before the colon."""
        return self._whole(name, 10).astype(np.int32)

    def hex_column(self, name: str) -> UInt32:
        """A column of flags."""
        return self._whole(name, 16).astype(np.uint32)

    def _whole(self, name: str, base: int) -> npt.NDArray[np.int64]:
        at = self.record.ordinal(name)
        column = self._fast.ints[:, self._place(at, _WHOLE)].copy()
        values, outside = ints([self.fields[row][at].rstrip(":") for row in self.slow], base)
        column[self.slow] = values
        for i in outside:
            self.outside.setdefault(self.slow[i], name)
        return column

    def float_columns(self, first: str, count: int) -> Float32:
        """`count` neighbouring columns from the one named, as (n, count); (n,) where count is 1."""
        at = self.record.ordinal(first)
        place = self._place(at, (Kind.FLOAT,))
        columns = np.ascontiguousarray(self._fast.floats[:, place : place + count])
        values = floats([text for row in self.slow for text in self.fields[row][at : at + count]])
        columns[self.slow] = values.reshape(-1, count)
        for i in np.flatnonzero(np.isinf(values)).tolist():
            self.outside.setdefault(self.slow[i // count], self.record.fields[at + i % count].name)
        return columns[:, 0] if count == 1 else columns

    def word_column(self, name: str) -> tuple[str, ...]:
        """A column of names."""
        at = self.record.ordinal(name)
        place = self._place(at, (Kind.WORD,))
        words = _texts(self._source.text, self._fast.words[:, 2 * place : 2 * place + 2])
        for row in self.slow:
            words[row] = str(self.fields[row][at])
        return tuple(words)

    def tails(self) -> tuple[Int32, list[str]]:
        """What a record repeats behind its fields: `start` cuts the words."""
        fast = _texts(self._source.text, self._fast.tail.reshape(-1, 2))
        if not self.slow:
            return self._fast.tail_start.astype(np.int32), fast
        own = len(self.record.fields)
        slow: dict[int, Sequence[Any]] = {row: [str(word) for word in self.fields[row][own:]] for row in self.slow}
        start, words = merge(self._fast.tail_start, np.array(fast, object), slow)
        return start, words.tolist()

    def _place(self, at: int, kinds: tuple[Kind, ...]) -> int:
        """Among fields of these kinds, the place of the field at `at`."""
        return sum(f.kind in kinds for f in self.record.fields[:at])


def well_formed(record: Record, lines: LogicalLines, line: int) -> bool:
    """Whether the native reader takes a line, that is, whether the grammar does to the letter; much cheaper."""
    return bool(_read_fast(record, lines, np.array([line], np.intp))[0][0])


def _texts(text: str, ranges: npt.NDArray[np.int64]) -> list[str]:
    return [text[begin:end] for begin, end in ranges.tolist()]


def _read_fast(record: Record, lines: LogicalLines, at: Lines) -> tuple[npt.NDArray[np.uint8], _Fast]:
    form = record.form
    recognised, whole, decimal, words, tail_start, tail = read_fields(
        lines.octets, lines.start[at], lines.end[at], form, not record.scanned
    )
    rows = len(at)
    return recognised, _Fast(
        whole.reshape(rows, sum(map(form.count, "Lih"))),
        decimal.reshape(rows, form.count("f")),
        words.reshape(rows, 2 * form.count("w")),
        tail_start,
        tail,
    )


def merge(
    start: npt.NDArray[Any], values: npt.NDArray[Any], slow: dict[int, Sequence[Any]]
) -> tuple[Int32, npt.NDArray[Any]]:
    """Put rows that the grammar read into values cut by `start`, where those rows are replaced."""
    if not slow:
        return start.astype(np.int32), values
    counts = np.diff(start)
    mask = np.zeros(len(counts), np.bool_)
    mask[list(slow)] = True
    kept = values[~np.repeat(mask, counts)]
    for row, items in slow.items():
        counts[row] = len(items)
    merged = np.empty((int(counts.sum()), *values.shape[1:]), values.dtype)
    replaced = np.repeat(mask, counts)
    merged[~replaced] = kept
    inserted = [item for row in sorted(slow) for item in slow[row]]
    if inserted:
        merged[replaced] = inserted
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int32), merged
