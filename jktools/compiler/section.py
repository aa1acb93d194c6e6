"""A section of a compiled level: its columns as they lie in the file, and as arrays."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import SECTIONS, STRINGS, TEXT, Column, camel_case
from jktools.compiler.inheritance import inherited
from jktools.compiler.packing import INDICES, VECTORS, Stored, absent

NO_SECTION, PLAIN, FIRST_VECTOR = -2, 0, 2
"""Forms of a column as `level_parts` tells them."""
_DTYPES: dict[str, np.dtype[Any]] = {kind: np.dtype(f"<{kind}") for kind in ("u1", "i4", "u4", "f4", "f8")}
_OF_VECTORS: list[np.dtype[Any]] = [np.dtype(f"<{kind}") for kind in VECTORS.values()]
_INDICES: dict[int, np.dtype[Any]] = {1: np.dtype("u1"), 2: np.dtype("<u2")}

TEXTS = "strings"
"""Stands for the columns of the strings among sections."""

Parts = tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]
"""What `level_parts` tells, with a row for each column."""


class Layout(NamedTuple):
    """The columns of a section that files of one minor version have."""

    rows: slice
    """Of the section, among those of `level_parts`."""
    columns: tuple[tuple[int, str, Column], ...]
    """Each with its row among them."""
    declared: Mapping[str, Column]


@cache
def layouts(minor: int) -> dict[str, Layout]:
    """By section, the strings first, in the order in which `level_parts` is asked."""
    found, first = {}, 0
    for name, columns in ((TEXTS, TEXT), *SECTIONS.items()):
        held = tuple(
            (row, key, column)
            for row, (key, column) in enumerate(columns.items())
            if column.since <= minor and (column.until is None or minor <= column.until)
        )
        found[name] = Layout(slice(first, first + len(columns)), held, columns)
        first += len(columns)
    return found


class Section:
    """The columns of one section by name: `(n,)` or `(n, width)`, read-only, of the schema's type.

    A column that the file holds in that type is a view of it; one in a smaller form is made when first asked for and
    kept. `stored` gives the parts as they lie in the file, all of them views.
    """

    def __init__(self, data: memoryview, parts: Parts, layout: Layout) -> None:
        """Hold the columns of a layout, of which `parts` tells where they lie."""
        self._data = data
        self._parts = parts
        self._layout = layout
        self._made: dict[str, npt.NDArray[Any]] = {}

    @cached_property
    def stored(self) -> Mapping[str, Stored]:
        """The columns as they lie in the file; of one that does not, what that stands for."""
        rows, steps = (each[self._layout.rows].tolist() for each in self._parts)
        found = {name: _part(self._data, rows[row], steps[row], column) for row, name, column in self._layout.columns}
        declared = self._layout.declared
        for name in [name for name, stored in found.items() if stored is None]:
            leader = found.get(declared[name].rows_of or "")
            found[name] = absent(declared[name], 0 if leader is None else len(leader))
        return found  # type: ignore[return-value]  # none is absent now

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._made:
            if name in self.stored:
                self._made[name] = self.stored[name].array(self._layout.declared[name])
            elif name in INHERITED and "own_key" in self.stored:
                self._made |= inherited(self)
            elif name in LISTED and "list_number" in self.stored:
                self._made |= _listed(self)
            else:
                raise AttributeError(name)
        return self._made[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.stored]

    @property
    def texts(self) -> frozenset[str]:
        """The columns that count strings."""
        return frozenset(name for name in self.stored if self._layout.declared[name].index_of == STRINGS)

    @property
    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """Every column."""
        return {name: getattr(self, name) for name in self.stored}

    @property
    def nbytes(self) -> int:
        """What its vectors take in the file; one that several columns share counts once."""
        parts = {part.__array_interface__["data"]: part.nbytes for s in self.stored.values() for part in s.vectors}
        return sum(parts.values())


INHERITED = ("value_start", "value_key", "value_text", "value_source", "value_list")
"""All values of each template: what 1.1 and 1.2 have in the file, and later files by what templates rest on."""
LISTED = ("number_start", "number")
"""The numbers of each value of a template one after the other: what 1.1 has in the file, and later files as lists."""


def _listed(templates: Section) -> dict[str, npt.NDArray[Any]]:
    first = templates.list_start[templates.value_list].astype(np.int64)
    counts = templates.list_start[templates.value_list + 1].astype(np.int64) - first
    start = np.concatenate([[0], np.cumsum(counts)])
    places = np.arange(start[-1]) + np.repeat(first - start[:-1], counts)
    made = {"number_start": start.astype("<u4"), "number": templates.list_number[places]}
    for values in made.values():
        values.flags.writeable = False
    return made


def _part(data: memoryview, row: list[int], step: float, column: Column) -> Stored | None:
    """A column as it lies in the file, by a row of `level_parts`; None where it is absent."""
    form, place, length, index_size, index_place, index_length, count, first, origin_place, origin_length = row
    if form < PLAIN:
        return None
    width = column.width
    shape = length if width == 1 else (length // width, width)
    if form == PLAIN:
        return Stored(np.ndarray(shape, _DTYPES[column.type], data, place))
    values = None if form < FIRST_VECTOR else np.ndarray(shape, _OF_VECTORS[form - FIRST_VECTOR], data, place)
    index = np.ndarray(index_length, _INDICES[index_size], data, index_place) if index_size else None
    origin = tuple(np.ndarray(origin_length, _DTYPES["i4"], data, origin_place).tolist()) if origin_length else ()
    return Stored(values, index, count, first, step, origin)


def of_table(table: Any, name: str, column: Column) -> npt.NDArray[Any]:
    """A column of a table that is no section."""
    field = camel_case(name)
    if not getattr(table, f"{field}IsNone")():
        return Stored(getattr(table, f"{field}AsNumpy")()).array(column)
    packed = getattr(table, f"{field}Packed")()
    if packed is None:
        return absent(column, 0).array(column)
    values, index = (
        next(
            (getattr(packed, f"{v}AsNumpy")() for v in map(camel_case, names) if not getattr(packed, f"{v}IsNone")()),
            None,
        )
        for names in (VECTORS, INDICES)
    )
    return Stored(values, index, packed.Count(), packed.First()).array(column)
