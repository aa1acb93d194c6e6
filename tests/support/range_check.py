"""The range check of compiled levels in numpy, apart from the native one that the reader uses: the two must agree."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import SECTIONS, STRINGS, TEXT, Column
from jktools.compiler.packing import Stored

Stores = Mapping[str, Mapping[str, Stored]]
"""By section and column."""


def first_fault(stored: Stores, strings: int, size: int) -> str | None:
    """What is wrong with the columns of a file of `size` bytes, in one sentence, or None.

    The FlatBuffers verifier accepts an index of 2 billion; after this check no index of the file can lead
    outside its arrays, and every `*_start` column cuts its array in order.
    """
    return columns_fault(SECTIONS, stored, strings, size) or _surface_ranges(stored) or _bases(stored)


def columns_fault(declared: Mapping[str, Mapping[str, Column]], stored: Stores, strings: int, size: int) -> str | None:
    """The same of some sections alone."""
    for section, columns in stored.items():
        for name, each in columns.items():
            column = declared[section][name]
            fault = (
                _form(column, each, size)
                or _shape(columns, column, each)
                or _indices(stored, section, column, each, strings)
            )
            if fault:
                return f"{section}.{name} {fault}"
    return None


def text_fault(stored: Mapping[str, Stored], size: int) -> str | None:
    """What is wrong with the columns of the strings; else each can be read."""
    fault = columns_fault({"level": TEXT}, {"level": stored}, 0, size)
    if fault:
        return fault
    start = stored["text_start"].array(TEXT["text_start"]).astype(np.int64)
    text = stored["text"].array(TEXT["text"])
    symbols = stored["symbols"].array(TEXT["symbols"]).tobytes() if "symbols" in stored else b""
    if symbols:
        return _coded_fault([text[a:b].tobytes() for a, b in pairwise(start.tolist())], symbols)
    if (np.diff(start) < 1).any() or text[start[1:] - 1].any():
        return "level.text should have a zero byte behind each string, but has not"
    return None


def _coded_fault(texts: Sequence[bytes], symbols: bytes) -> str | None:
    known = symbols.split(b"\0")
    if known.pop() or not all(1 <= len(each) <= 255 for each in known) or len(known) > 127:
        return "level.symbols should be up to 127 of up to 255 bytes, each with a zero byte behind it"
    for i, text in enumerate(texts):
        # What stands behind a 255 says nothing of itself.
        plain = re.sub(rb"\xff.", b"", text, flags=re.DOTALL)
        wrong = next((code for code in plain if code >= 128 + len(known)), None)
        if wrong is not None:
            missing = "nothing behind it" if wrong == 255 else f"there are {len(known)} symbols"
            return f"level.text {i} has the code {wrong}, but {missing}"
    return None


def _form(column: Column, stored: Stored, size: int) -> str | None:
    """Whether the parts of a packed column fit each other, and it claims no more rows than a file of this size can."""
    values, index = stored.values, stored.index
    if stored.count > size:
        return f"claims {stored.count} rows, more than the file has bytes"
    if values is None:
        whole = column.type[0] in "iu" and column.width == 1
        return None if whole and index is None and stored.count else "has no values"
    if stored.count and (index is not None or len(values) != 1):
        return f"has {len(values)} rows for one that stands for all"
    if index is not None and len(index) and int(index.max()) >= len(values):
        return f"takes row {index.max()} of a pool of {len(values)}"
    if stored.step:
        fits = values.dtype.kind in "iu" and column.type[0] == "f" and np.isfinite(stored.step) and stored.step > 0
        return None if fits and len(stored.origin) in (0, column.width) else "is no grid"
    if stored.origin or (values.dtype.kind == "f") != (column.type[0] == "f"):
        return f"holds {values.dtype} for {column.type}"
    return None


def _shape(columns: Mapping[str, Stored], column: Column, stored: Stored) -> str | None:
    leader = columns.get(column.rows_of) if column.rows_of else stored
    wanted = 0 if leader is None else len(leader)
    if column.cuts is not None:
        wanted += column.rows_of is not None
        values = stored.array(column).astype(np.int64)
        end = len(columns[column.cuts])
        if len(values) == 0 or values[0] != 0 or values[-1] != end or (np.diff(values) < 0).any():
            return f"should run from 0 to {end} without a step back, but does not"
    return None if len(stored) == wanted else f"has {len(stored)} rows, but should have {wanted}"


def _indices(stored: Stores, section: str, column: Column, each: Stored, strings: int) -> str | None:
    if column.index_of is None:
        return None
    count = strings if column.index_of == STRINGS else _count(stored, section, column.index_of)
    least = -1 if column.or_none else 0
    if _within(each, least, count):
        return None
    values = each.array(column)
    wrong = np.flatnonzero((values.astype(np.int64) < least) | (values >= count))
    return f"{wrong[0]} is {values[wrong[0]]}, but there are {count} {column.index_of}" if len(wrong) else None


def _within(stored: Stored, least: int, count: int) -> bool:
    """Whether all rows are in a range; asks the rows of a pool but once, though all of them."""
    if stored.values is None:
        return least <= stored.first and stored.first + stored.count <= count
    return not stored.values.size or (int(stored.values.min()) >= least and int(stored.values.max()) < count)


def _count(stored: Stores, section: str, target: str) -> int:
    owner, _, name = target.rpartition(".")
    found: Stored | None = stored.get(owner or section, {}).get(name)
    if found is None:
        return 0
    return len(found) - 1 if name.endswith("_start") else len(found)


def _surface_ranges(stored: Stores) -> str | None:
    geometry = stored.get("geometry")
    if geometry is None:
        return None

    def whole(name: str) -> npt.NDArray[Any]:
        return geometry[name].array(SECTIONS["geometry"][name]).astype(np.int64)

    first, count, there = whole("sector_first_surface"), whole("sector_surface_count"), len(geometry["surface_flags"])
    wrong = np.flatnonzero((first < 0) | (count < 0) | (first + count > there))
    if not len(wrong):
        return None
    i = wrong[0]
    return f"geometry.sector_first_surface {i} claims {count[i]} surfaces from {first[i]}, but there are {there}"


def _bases(stored: Stores) -> str | None:
    base = stored.get("templates", {}).get("base")
    if base is None:
        return None
    values = base.array(SECTIONS["templates"]["base"])
    wrong = np.flatnonzero(values >= np.arange(len(values)))
    return f"templates.base {wrong[0]} is {values[wrong[0]]}, which does not come before it" if len(wrong) else None
