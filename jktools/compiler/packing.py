"""The forms that a column can have in the file: the smallest is written, and each is read back to the same values.

A column is its plain vector, or a `Packed` table of the schema: numbers of fewer bytes, rows of a pool that an index
names, one row for all, or whole numbers that follow each other. Every part is a vector that can be viewed in place.
Rows are compared by their bytes, so that -0.0 and each NaN come back as they were.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import Column

Array = npt.NDArray[Any]

VECTORS: Mapping[str, str] = {
    "i8": "i1", "u8": "u1", "i16": "i2", "u16": "u2", "i32": "i4", "u32": "u4", "f32": "f4", "f64": "f8",
}  # fmt: skip
"""The vectors of a packed column, and the type of each as numpy names it."""
INDICES: Mapping[str, str] = {"index8": "u1", "index16": "u2"}
"""The vectors that name a row of a pool."""

_NARROW = ("u1", "i1", "u2", "i2", "u4", "i4")
_TABLE = 24
"""Bytes that a packed column costs beside its vectors, about: its table, the offset to it and its share of vtables."""
_STEP = 48
"""What a step costs beside: its double, and a vtable that only columns with a step share."""
_VECTOR = 8
"""Bytes that a vector costs beside its numbers: its length, and about as much to the next multiple of 8."""
_WORTH = 0.75
"""A pool is kept when it has at most this share of the bytes: it costs every reader one more step."""
_WORTH_JOINED = 0.85
"""Columns are joined when they then have at most this share of the bytes that they have apart."""
_MOST_POOLED = 1 << 16
_SHORT = 8
"""A run of at most so many numbers is written out."""


@dataclass(slots=True, eq=False)
class Stored:
    """A column as it lies in the file."""

    values: Array | None
    """(rows, width), or (rows,) for a width of 1; None for whole numbers that follow each other."""
    index: Array | None = None
    """Of each row, the row of `values`; None where rows stand for themselves."""
    count: int = 0
    """Not 0: how many rows the one row of `values` stands for, or how many numbers follow each other."""
    first: int = 0
    """Where there are no `values`: the first of the numbers."""
    step: float = 0.0
    """Not 0: the values are (origin + number) * step."""
    origin: tuple[int, ...] = ()
    """One for each number of a row; none for zeros."""
    in_file: bool = True
    """False for what an absent column stands for."""

    def __len__(self) -> int:
        if self.index is not None:
            return len(self.index)
        return self.count or (0 if self.values is None else len(self.values))

    @property
    def vectors(self) -> Iterable[Array]:
        """What of it lies in the file."""
        return [part for part in (self.values, self.index) if part is not None and self.in_file]

    def is_plain(self, column: Column) -> bool:
        """Whether it is the vector of the column's own type."""
        if self.values is None or self.index is not None or self.count or self.step:
            return False
        return bool(self.values.dtype == np.dtype(f"<{column.type}"))

    def array(self, column: Column) -> Array:
        """The column in its declared type: a view of the file where it is stored so, else made."""
        found = self.rows(column)
        if self.index is not None:
            found = found[self.index]
        elif self.count and self.values is not None:
            found = np.broadcast_to(found, (self.count, *found.shape[1:]))
        found.flags.writeable = False
        return found

    def rows(self, column: Column) -> Array:
        """The distinct rows in their declared type, as `index` names them; all rows where there is no index."""
        kind = f"<{column.type}"
        if self.values is None:
            return np.arange(self.first, self.first + self.count).astype(kind)
        if self.step:
            origin = np.array(self.origin or [0] * column.width, np.float64)
            shift = origin if column.width > 1 else origin[0]
            return ((self.values + shift) * self.step).astype(kind)
        return self.values.astype(kind, copy=False)

    def cost(self, column: Column) -> int:
        """Bytes in the file, about."""
        table = 0 if self.is_plain(column) else _TABLE
        if self.step:
            table += _STEP + (_VECTOR + 4 * len(self.origin) if self.origin else 0)
        return table + sum(part.nbytes + _VECTOR for part in self.vectors)


def absent(column: Column, rows: int) -> Stored:
    """What a column that is not in the file stands for: rows of 0, or of -1 where that means none."""
    values = _default(column.type, column.width, column.or_none)
    return Stored(values, count=rows, in_file=False) if rows else Stored(values[:0], in_file=False)


@cache
def _default(kind: str, width: int, or_none: bool) -> Array:
    values = np.full((1, width) if width > 1 else 1, -1 if or_none else 0, f"<{kind}")
    values.flags.writeable = False
    return values


def plain_array(values: Array | Stored, column: Column) -> Array:
    """The rows of a column in its declared type."""
    return values.array(column) if isinstance(values, Stored) else _shaped(values, column)


def pack(values: Array, column: Column) -> Stored | None:
    """The smallest form of a column; None for one that need not be written (see `absent`)."""
    values = _shaped(values, column)
    if not len(values):
        return None
    if column.rows_of is not None and column.cuts is None and _is_one_row(values, absent(column, 1).array(column)):
        return None
    return smallest(Stored(values), column)


def pack_group(values: Mapping[str, Array], columns: Mapping[str, Column]) -> dict[str, Stored | None]:
    """Columns of one group: some over one pool of their rows with one index, where that is smaller than each alone.

    Which go together is found by joining the two parts that spare the most, again and again.
    """
    alone = {name: pack(values[name], columns[name]) for name in columns}
    shaped = {name: _shaped(values[name], columns[name]) for name, stored in alone.items() if stored is not None}
    parts = [
        _Part((name,), {name: stored}, stored.cost(columns[name]))
        for name, stored in alone.items()
        if stored is not None and not stored.count
    ]
    pairs: dict[tuple[str, ...], _Part | None] = {}
    while len(parts) > 1:
        found = []
        for two in combinations(parts, 2):
            names = two[0].names + two[1].names
            if names not in pairs:
                pairs[names] = _joined(names, shaped, columns)
            joined, before = pairs[names], two[0].cost + two[1].cost
            if joined is not None and joined.cost <= _WORTH_JOINED * before:
                found.append((before - joined.cost, joined, two))
        if not found:
            break
        _, joined, two = max(found, key=lambda each: each[0])
        parts = [part for part in parts if part not in two] + [joined]
    return alone | {name: stored for part in parts for name, stored in part.stored.items()}


@dataclass(slots=True, eq=False)
class _Part:
    """Columns that share an index, or one."""

    names: tuple[str, ...]
    stored: Mapping[str, Stored]
    cost: int


def _joined(names: tuple[str, ...], shaped: Mapping[str, Array], columns: Mapping[str, Column]) -> _Part | None:
    """Columns over one pool; None where it is too large for an index."""
    found = _pool(np.concatenate([_octets(shaped[name]) for name in names], axis=1))
    if found is None:
        return None
    first, index = found
    together = {name: Stored(_narrowed(shaped[name][first]), index) for name in names}
    # The index is written once, since equal vectors are.
    cost = sum(stored.cost(columns[name]) for name, stored in together.items())
    return _Part(names, together, cost - (len(names) - 1) * (index.nbytes + _VECTOR))


def _shaped(values: Array, column: Column) -> Array:
    flat = np.ascontiguousarray(values, f"<{column.type}").reshape(-1)
    return flat if column.width == 1 else flat.reshape(-1, column.width)


def smallest(plain: Stored, column: Column) -> Stored:
    """The smallest form of rows that stand for themselves; a grid that they count on stays."""
    values = plain.values
    assert values is not None
    narrow = replace(plain, values=_narrowed(values))
    if _is_one_row(values, values[:1]):
        forms = [plain, narrow, replace(narrow, values=_narrowed(values[:1]), count=len(values))]
        return min(forms, key=lambda form: form.cost(column))
    if _is_run(values, column):
        return Stored(None, count=len(values), first=int(values[0]))
    best = min((plain, narrow), key=lambda form: form.cost(column))
    found = _pool(_octets(values))
    if found is None:
        return best
    first, index = found
    pooled = replace(plain, values=_narrowed(values[first]), index=index)
    return pooled if pooled.cost(column) <= _WORTH * best.cost(column) else best


def _narrowed(values: Array) -> Array:
    """Whole numbers in the fewest bytes that hold them; others as they are."""
    if values.dtype.kind not in "iu" or not values.size:
        return values
    least, most = int(values.min()), int(values.max())
    kind = next(k for k in _NARROW if np.iinfo(k).min <= least and most <= np.iinfo(k).max)
    return values.astype(f"<{kind}") if np.dtype(kind).itemsize < values.itemsize else values


def _is_one_row(values: Array, row: Array) -> bool:
    return bool((_octets(values) == _octets(row)).all())


def _is_run(values: Array, column: Column) -> bool:
    return (
        len(values) > _SHORT
        and column.type in _NARROW
        and column.width == 1
        and bool((np.diff(values.astype(np.int64)) == 1).all())
    )


def _octets(rows: Array) -> Array:
    """(rows, bytes of a row)."""
    return np.ascontiguousarray(rows).reshape(len(rows), -1).view(np.uint8).reshape(len(rows), -1)


def _pool(rows: Array) -> tuple[Array, Array] | None:
    """Where each distinct row first stands, in that order, and the index of each row among them."""
    keys = np.ascontiguousarray(rows).view(f"V{rows.shape[1]}").reshape(-1)
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) > _MOST_POOLED:
        return None
    order = np.argsort(first)
    rank = np.empty(len(first), np.intp)
    rank[order] = np.arange(len(first))
    kind = "u1" if len(first) <= 1 << 8 else "<u2"
    return first[order], rank[inverse.reshape(-1)].astype(kind)
