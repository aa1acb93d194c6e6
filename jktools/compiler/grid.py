"""The grids of `accuracy="fast"`: whole steps of a power of two in place of float32, and how far that moves a value.

One grid holds all vertices of a level, so that what shared a corner still does and seams stay closed. Everything that
the file tells is computed on the moved vertices. A step and an origin are chosen so that every value is exactly a
float32: a reader that multiplies gets the numbers that the passes used.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import GEOMETRY
from jktools.compiler.packing import Stored, pack, smallest
from jktools.facts import LevelFacts
from jktools.model import Level

Float64 = npt.NDArray[np.float64]

FINEST = -14
"""Exponent of the finest step of a vertex, 1/16384 JKU: a player is 0.13 wide."""
COARSEST_SHORT = -9
"""Exponent of the coarsest step for which vertices count in 16 bits; a wider level counts in 32."""
NORMAL = -14
"""Exponent of the step of a normal's components, so that 0 and 1 are on the grid."""
TEXEL = (-8, -4)
"""Exponents of the finest and the coarsest step of a texture vertex, texels; a wider level keeps float32."""
LIGHT = (-12, -8)
"""Exponents of the finest and the coarsest step of a corner's light; the engine shades in 64."""
MANTISSA = 24
"""Whole numbers up to 2 ** 24 are exact in float32."""
FITTING = np.cos(np.radians(1.0))
"""A written normal that leans at most 1 degree off its polygon belongs to it, and turns with it by at most 1 degree."""
UNIT = 1e-3
"""How far from 1 the length of such a normal may be."""


@dataclass(frozen=True, slots=True)
class Grid:
    """Values (origin + n) * step for whole n of `kind`."""

    step: float
    origin: tuple[int, ...]
    kind: str

    def steps(self, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """The nearest n of each row of values; halves go to the even one, so that order is kept."""
        whole: npt.NDArray[Any] = np.rint(values.astype(np.float64) / self.step).astype(np.int64)
        return np.asarray(whole - np.array(self.origin))

    def snapped(self, values: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """The values on the grid, NaN where they were."""
        return (np.rint(values.astype(np.float64) / self.step) * self.step).astype(np.float32)

    def stored(self, values: npt.NDArray[Any], name: str) -> Stored:
        """A column of geometry on the grid."""
        column = GEOMETRY[name]
        steps = self.steps(values.reshape(-1, column.width)).astype(self.kind)
        rows = steps if column.width > 1 else steps.reshape(-1)
        return smallest(Stored(rows, step=self.step, origin=self.origin if any(self.origin) else ()), column)


def vertex_grid(vertices: npt.NDArray[np.float32]) -> Grid | None:
    """The grid of a level's vertices; None for one without any, or whose coordinates are not all finite."""
    if not vertices.size or not np.isfinite(vertices).all():
        return None
    return _grid(vertices, FINEST, COARSEST_SHORT, "<i2") or _grid(vertices, FINEST, 127, "<i4")


def value_grid(values: npt.NDArray[np.float32], exponents: tuple[int, int]) -> Grid | None:
    """The finest grid within bounds on which values count in 16 bits; None where there is none."""
    if not values.size or not np.isfinite(values).all():
        return None
    return _grid(values, *exponents, "<i2")


def _grid(values: npt.NDArray[np.float32], finest: int, coarsest: int, kind: str) -> Grid | None:
    wide = values.astype(np.float64)
    least, most = wide.min(axis=0), wide.max(axis=0)
    for exponent in range(finest, coarsest + 1):
        step = 2.0**exponent
        low, high = np.rint(least / step), np.rint(most / step)
        if max(abs(low).max(), abs(high).max()) > 2**MANTISSA:
            continue
        middle = np.zeros_like(low) if kind == "<i4" else np.floor((low + high + 1) / 2)
        if (high - middle).max() <= np.iinfo(kind).max and (low - middle).min() >= np.iinfo(kind).min:
            return Grid(step, tuple(int(each) for each in middle), kind)
    return None


def on_grid(level: Level) -> Level:
    """The level with its vertices, boxes and normals moved onto the grid of its vertices, which is kept with it.

    The level itself where no grid holds it.
    """
    grid = vertex_grid(level.vertices)
    if grid is None:
        return level
    document = level.document
    sectors = document.sectors
    # Rounding keeps order: a box holds the moved vertices that it held before.
    moved = replace(
        document,
        vertices=replace(document.vertices, position=grid.snapped(level.vertices)),
        sectors=replace(
            sectors,
            bound_box=grid.snapped(sectors.bound_box),
            collide_box=grid.snapped(sectors.collide_box),
        ),
    )
    turned = replace(document.normals, direction=_normals(level, Level(moved, level.resources)))
    found = Level(replace(moved, normals=turned), level.resources)
    found.kept[Grid] = grid
    return found


def grid_of(level: Level) -> Grid | None:
    """The grid that `on_grid` moved a level onto."""
    kept = level.kept.get(Grid)
    return kept if isinstance(kept, Grid) else None


def _normals(level: Level, moved: Level) -> npt.NDArray[np.float32]:
    """The written normals, turned with their polygons where they belonged to them, on the grid of normals.

    A sliver may turn far when its corners move; it keeps its own normal, whose plane its corners are then at most
    sqrt(3) steps off.
    """
    written = level.document.normals.direction.astype(np.float64)
    rows = slice(0, min(len(written), len(level.surfaces)))
    before, after = LevelFacts(level).corners.normal[rows], LevelFacts(moved).corners.normal[rows]
    fits = ((written[rows] * before).sum(axis=1) >= FITTING) & ((written[rows] * after).sum(axis=1) >= FITTING)
    unit = abs(np.linalg.norm(written[rows], axis=1) - 1) <= UNIT
    turned = written.copy()
    turned[rows] = np.where((fits & unit)[:, None], after, written[rows])
    step = 2.0**NORMAL
    return (np.rint(turned / step) * step).astype(np.float32)


def counted(columns: Mapping[str, npt.NDArray[Any]], grid: Grid | None) -> dict[str, Stored]:
    """The columns of geometry that grids hold as whole steps, of a level on a grid, where that takes fewer bytes."""
    grids = {
        "vertices": grid,
        "surface_normal": value_grid(columns["surface_normal"], (NORMAL, NORMAL)) if grid else None,
        "texture_vertices": value_grid(columns["texture_vertices"], TEXEL),
        "corner_light": value_grid(columns["corner_light"].reshape(-1, 1), LIGHT),
    }
    found = {name: each.stored(columns[name], name) for name, each in grids.items() if each is not None}
    return {name: each for name, each in found.items() if _pays(each, columns[name], name)}


def _pays(counted: Stored, values: npt.NDArray[Any], name: str) -> bool:
    """Whether steps take fewer bytes than the numbers as they are; few numbers that repeat do not need a grid."""
    column = GEOMETRY[name]
    written = pack(values, column)
    return written is not None and counted.cost(column) < written.cost(column)
