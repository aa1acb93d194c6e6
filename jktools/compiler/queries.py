"""The geometry of a compiled level, as queries take it."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from jktools.geometry import Plan
from jktools.model.level import MOST_CORNERS

Array = npt.NDArray[Any]


class Columns(Protocol):
    """Anything that has the columns of a section as attributes."""

    def __getattr__(self, name: str) -> Array: ...


def plan_of(geometry: Columns) -> Plan:
    """The geometry of a compiled level. What the range check let through is sound but for what numbers alone can be."""
    finite: Array = np.logical_and.reduce(np.isfinite(geometry.vertices), axis=1)
    start = geometry.surface_corner_start.astype(np.int32)
    sound_surfaces = (np.diff(start) <= MOST_CORNERS) & ~_any(~finite[geometry.corner_vertex], start[:-1], start[1:])
    first, count = geometry.sector_first_surface, geometry.sector_surface_count
    own = geometry.sector_vertex_start.astype(np.int64)
    return Plan(
        geometry.vertices, start, geometry.corner_vertex, geometry.surface_flags, geometry.surface_adjoin,
        geometry.adjoin_flags, _adjoin_sector(geometry), geometry.sector_flags, first, count, sound_surfaces,
        ~_any(~sound_surfaces, first, first + count) & ~_any(~finite[geometry.sector_vertex], own[:-1], own[1:]),
    )  # fmt: skip


def _adjoin_sector(geometry: Columns) -> Array:
    """The sector whose surface carries each adjoin's mirror; -1 where none does."""
    surface = geometry.adjoin_surface[geometry.adjoin_mirror]
    return np.append(geometry.surface_sector, -1)[surface].astype(np.int32)  # -1 takes the last


def _any(marked: Array, first: Array, end: Array) -> Array:
    """Whether any of [first, end) is marked."""
    before = np.concatenate([[0], np.cumsum(marked)])
    return np.asarray(before[end] > before[first])
