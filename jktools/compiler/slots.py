"""Where the fields of the schema stand in the vtables of its tables, as the generated code writes them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler import level_generated as fb
from jktools.compiler.columns import SECTIONS, TEXT, Column, camel_case

FIRST = 4
"""Bytes of a vtable before the offset of its first field; each takes 2."""


class _Probe:
    """Stands in for a builder, and remembers which slot the generated code fills."""

    slot = -1

    def PrependUOffsetTRelativeSlot(self, slot: int, *_: Any) -> None:  # noqa: N802 (the builder's name)
        self.slot = slot


def offset(table: str, field: str) -> int:
    """The vtable offset of a field that is a vector or a table; 0 for one that the schema does not have."""
    add = getattr(fb, f"{table}Add{camel_case(field)}", None)
    if add is None:
        return 0
    probe = _Probe()
    add(probe, 0)
    return FIRST + 2 * probe.slot


@cache
def wanted() -> npt.NDArray[np.uint16]:
    """What `level_parts` takes to find the columns of the strings, then those of every section."""
    rows = _rows("Level", 0, TEXT)
    for section, columns in SECTIONS.items():
        rows += _rows(camel_case(section), offset("Level", section), columns)
    return np.array(rows, np.uint16).reshape(-1)


def _rows(table: str, section: int, columns: Mapping[str, Column]) -> list[tuple[int, int, int]]:
    return [(section, offset(table, name), offset(table, f"{name}_packed")) for name in columns]
