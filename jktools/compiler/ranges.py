"""The range check: that every index of a compiled level counts something that is there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import SECTIONS, STRINGS, Column

Arrays = Mapping[str, Mapping[str, npt.NDArray[Any]]]


def first_fault(arrays: Arrays, strings: int) -> str | None:
    """What is wrong with the columns of a file, in one sentence, or None.

    The FlatBuffers verifier accepts an index of 2 billion; after this check no index of the file can lead
    outside its arrays, and every `*_start` column cuts its array in order.
    """
    for section, columns in arrays.items():
        for name, values in columns.items():
            column = SECTIONS[section][name]
            fault = _shape(columns, column, values) or _indices(arrays, section, column, values, strings)
            if fault:
                return f"{section}.{name} {fault}"
    return _surface_ranges(arrays)


def _shape(columns: Mapping[str, npt.NDArray[Any]], column: Column, values: npt.NDArray[Any]) -> str | None:
    wanted = len(columns[column.rows_of]) if column.rows_of else len(values)
    if column.cuts is not None:
        wanted += 1
        steps = np.diff(values.astype(np.int64))
        end = len(columns[column.cuts])
        if len(values) == 0 or values[0] != 0 or values[-1] != end or (steps < 0).any():
            return f"should run from 0 to {end} without a step back, but does not"
    return None if len(values) == wanted else f"has {len(values)} rows, but should have {wanted}"


def _indices(arrays: Arrays, section: str, column: Column, values: npt.NDArray[Any], strings: int) -> str | None:
    if column.index_of is None:
        return None
    count = strings if column.index_of == STRINGS else _count(arrays, section, column.index_of)
    least = -1 if column.or_none else 0
    wrong = np.flatnonzero((values.astype(np.int64) < least) | (values >= count))
    if not len(wrong):
        return None
    return f"{wrong[0]} is {values[wrong[0]]}, but there are {count} {column.index_of}"


def _count(arrays: Arrays, section: str, target: str) -> int:
    owner, _, name = target.rpartition(".")
    return len(arrays.get(owner or section, {}).get(name, ()))


def _surface_ranges(arrays: Arrays) -> str | None:
    geometry = arrays.get("geometry")
    if geometry is None:
        return None
    first = geometry["sector_first_surface"].astype(np.int64)
    count = geometry["sector_surface_count"].astype(np.int64)
    there = len(geometry["surface_flags"])
    wrong = np.flatnonzero((first < 0) | (count < 0) | (first + count > there))
    if not len(wrong):
        return None
    i = wrong[0]
    return f"geometry.sector_first_surface {i} claims {count[i]} surfaces from {first[i]}, but there are {there}"
