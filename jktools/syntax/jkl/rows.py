"""Collects the fields of records of one kind and turns them into columns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from jktools._native_text import decimals  # noqa: TID251 (this package is the door)
from jktools.syntax.jkl.document import Bool, Float32, Int32, UInt32
from jktools.syntax.jkl.records import Kind, Record

INT32_LEAST, INT32_MOST = -(2**31), 2**31 - 1
UINT32_MOST = 2**32 - 1

_STAND_IN = {Kind.LABEL: "0:", Kind.INT: "0", Kind.HEX: "0", Kind.FLOAT: "nan", Kind.WORD: ""}


def floats(texts: Sequence[str]) -> Float32:
    """Decimals as float32, each rounded once. Raises ValueError."""
    return decimals(np.frombuffer(" ".join(texts).encode("ascii"), np.uint8))


def ints(texts: Sequence[str], base: int = 10) -> tuple[list[int], list[int]]:
    """Whole numbers held within the engine's 32 bits, and the positions of those that did not fit."""
    least, most = (INT32_LEAST, INT32_MOST) if base == 10 else (0, UINT32_MOST)
    values = [int(text, base) for text in texts]
    outside = [i for i, value in enumerate(values) if not least <= value <= most]
    for i in outside:
        values[i] = min(max(values[i], least), most)
    return values, outside


class Rows:
    """The records of one table as they are read, broken ones included."""

    def __init__(self, record: Record) -> None:
        """Collect records of this kind."""
        self.record = record
        self.fields: list[Sequence[str]] = []
        self.lines: list[int] = []
        self.broken_at: list[int] = []
        self.outside: dict[int, str] = {}
        """Records with a number beyond the engine's, and the name of that field."""
        self._stand_in = tuple(_STAND_IN[f.kind] for f in record.fields)

    def __len__(self) -> int:
        return len(self.lines)

    def add(self, line: int, fields: Sequence[str] | None) -> None:
        """Take a record; None for a broken one."""
        if fields is None:
            self.broken_at.append(len(self.lines))
            fields = self._stand_in
        self.fields.append(fields)
        self.lines.append(line)

    def line_column(self) -> Int32:
        """Logical line of each record."""
        return np.array(self.lines, np.int32)

    def broken(self) -> Bool:
        """Which records are broken."""
        mask = np.zeros(len(self.lines), np.bool_)
        mask[self.broken_at] = True
        return mask

    def int_column(self, name: str) -> Int32:
        """A column of whole numbers."""
        return np.array(self._ints(name, 10), np.int32)

    def hex_column(self, name: str) -> UInt32:
        """A column of flags."""
        return np.array(self._ints(name, 16), np.uint32)

    def _ints(self, name: str, base: int) -> list[int]:
        at = self.record.ordinal(name)
        values, outside = ints([row[at] for row in self.fields], base)
        for i in outside:
            self.outside.setdefault(i, name)
        return values

    def label_column(self) -> Int32:
        """The numbers before the colon."""
        values, outside = ints([row[0].rstrip(":") for row in self.fields])
        for i in outside:
            self.outside.setdefault(i, "label")
        return np.array(values, np.int32)

    def float_columns(self, first: str, count: int) -> Float32:
        """`count` neighbouring columns from the one named, as (n, count); (n,) where count is 1."""
        at = self.record.ordinal(first)
        values = floats([text for row in self.fields for text in row[at : at + count]])
        for i in np.flatnonzero(np.isinf(values)).tolist():
            self.outside.setdefault(i // count, self.record.fields[at + i % count].name)
        return values if count == 1 else values.reshape(-1, count)

    def word_column(self, name: str) -> tuple[str, ...]:
        """A column of names."""
        at = self.record.ordinal(name)
        return tuple(str(row[at]) for row in self.fields)
