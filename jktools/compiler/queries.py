"""What a compiled level answers from its own columns: its mesh, the ledges of an edge, the basins of a body."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from jktools.geometry import Plan
from jktools.model.level import MOST_CORNERS

Array = npt.NDArray[Any]


class Columns(Protocol):
    """Anything that has the columns of a section as attributes."""

    def __getattr__(self, name: str) -> Array: ...


class Ledge(NamedTuple):
    """A part of a floor's edge, and what a body comes onto beyond it; grammars/level.fbs tells more of each."""

    start: float
    end: float
    """0 .. 1 along the edge."""
    kind: int
    """A `jktools.facts.ledges.Kind`, by the engine profile of the file."""
    other_kind: int
    """By the other profile."""
    below: int
    """The surface come onto, or that blocks; -1 for none."""
    thing: int
    """Source index of the thing that makes it unknown, or -1."""
    drop_start: float
    drop_end: float
    """From the edge down at both ends, JKU; NaN for none."""
    traits: int
    """0x1 the place below is narrower than the body, 0x2 the engine's AI stops."""
    onto: int = -1
    """Source index of the thing come onto, or that blocks; -1 for none, and in files up to format 1.1."""
    onto_face: int = -1
    """The face of its model at rest, or -1."""


class Basin(NamedTuple):
    """Floors that a body can come down to and whose every way out goes up."""

    surfaces: tuple[int, ...]
    shallowest: float
    deepest: float
    """Least and greatest height of the edges that lead in, JKU."""
    entered: int
    """0x1 walk, 0x2 fall, 0x4 jump, 0x8 a player starts there."""
    left: int
    """0x1 walk, 0x2 jump, 0x4 mover, 0x8 water, 0x10 deadly, 0x20 unknown; 0: inescapable where no player starts."""


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


def ledges_at(ledges: Columns, body: int, surface: int, corner: int) -> Iterator[Ledge]:
    """The ledges of one edge in their order. Raises IndexError for a body that the file does not have."""
    bodies = len(ledges.body_movesize)
    if not 0 <= body < bodies:
        raise IndexError(f"body {body} does not exist: there are {bodies}")
    first, end = (int(ledges.body_ledge_start[body + i]) for i in (0, 1))
    low = first + int(np.searchsorted(ledges.surface[first:end], surface, "left"))
    high = first + int(np.searchsorted(ledges.surface[first:end], surface, "right"))
    for row in range(low, high):
        if ledges.corner[row] == corner:
            yield Ledge(*(getattr(ledges, name)[row].item() for name in Ledge._fields if hasattr(ledges, name)))


def basins_of(basins: Columns, body: int) -> Iterator[Basin]:
    """The basins of a body."""
    for row in np.flatnonzero(basins.body == body).tolist():
        surfaces = basins.surface[basins.surface_start[row] : basins.surface_start[row + 1]]
        figures = (getattr(basins, name)[row].item() for name in Basin._fields[1:])
        yield Basin(tuple(surfaces.tolist()), *figures)
