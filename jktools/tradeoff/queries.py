"""Queries about a level, drawn by a seed: between things, between random points, near pairs, and through edges."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.model import Level

NEAR = 2.0
"""JKU: how far apart a near pair is at most, along each axis."""

Float64 = npt.NDArray[np.float64]


class Queries(NamedTuple):
    """Origins (n, 3), their sectors (n,), and targets (n, 3)."""

    origins: Float64
    sectors: npt.NDArray[np.int32]
    targets: Float64

    @property
    def first(self) -> Queries:
        """The first of them alone."""
        return Queries(self.origins[:1], self.sectors[:1], self.targets[:1])


def can_be_asked(level: Level) -> bool:
    """Whether the level has a sector that points can be drawn in."""
    return bool(len(_usable(level)))


def things(level: Level, count: int, rng: np.random.Generator) -> Queries:
    """Pairs of placed things; random points where a level places fewer than two."""
    table = level.document.things
    sound = (table.sector >= 0) & (table.sector < len(level.sectors)) & np.isfinite(table.position).all(axis=1)
    sound[sound] &= level.sound_sectors[table.sector[sound]]
    position, sector = table.position[sound].astype(np.float64), table.sector[sound].astype(np.int32)
    if len(sector) < 2:
        return points(level, count, rng)
    i, j = rng.integers(len(sector), size=(2, count))
    return Queries(position[i], sector[i], position[j])


def _inside(level: Level, sectors: npt.NDArray[np.int32], rng: np.random.Generator) -> Float64:
    """A random mean of each sector's vertices."""
    table = level.document.sectors
    out = np.empty((len(sectors), 3))
    for i, s in enumerate(sectors.tolist()):
        own = level.vertices[table.vertex[table.vertex_start[s] : table.vertex_start[s + 1]]]
        out[i] = rng.dirichlet(np.ones(len(own))) @ own
    return out


def _usable(level: Level) -> npt.NDArray[np.intp]:
    table = level.document.sectors
    return np.flatnonzero(level.sound_sectors & (np.diff(table.vertex_start) > 0) & (table.surface_count > 0))


def _sectors(level: Level, count: int, rng: np.random.Generator) -> npt.NDArray[np.int32]:
    return rng.choice(_usable(level), count).astype(np.int32)


def points(level: Level, count: int, rng: np.random.Generator) -> Queries:
    """Random points of random sectors."""
    sectors = _sectors(level, count, rng)
    return Queries(_inside(level, sectors, rng), sectors, _inside(level, _sectors(level, count, rng), rng))


def near(level: Level, count: int, rng: np.random.Generator) -> Queries:
    """Random points and targets at most NEAR away along each axis."""
    sectors = _sectors(level, count, rng)
    origins = _inside(level, sectors, rng)
    return Queries(origins, sectors, origins + rng.uniform(-NEAR, NEAR, origins.shape))


def through_edges(level: Level, count: int, rng: np.random.Generator) -> Queries:
    """Segments from points, vertices and edges of a sector through (or close by, or onto) its vertices and edges."""
    sectors = _sectors(level, count, rng)
    table = level.document.surfaces
    first = level.document.sectors.first_surface[sectors]
    surface = first + rng.integers(level.document.sectors.surface_count[sectors])

    def note() -> Float64:
        size = np.diff(table.corner_start)[surface]
        i = rng.integers(size)
        here = level.vertices[table.corner_vertex[table.corner_start[surface] + i]].astype(np.float64)
        there = level.vertices[table.corner_vertex[table.corner_start[surface] + (i + 1) % size]].astype(np.float64)
        return np.asarray(here + rng.choice([0.0, 0.5, 0.25, 1 / 3], size=(count, 1)) * (there - here))

    goal = note()
    origins = _inside(level, sectors, rng)
    surface = first + rng.integers(level.document.sectors.surface_count[sectors])
    noted = rng.random(count) < 0.4
    origins[noted] = note()[noted]
    reach = rng.choice([1.0, 2.0, 3.0], size=(count, 1))
    return Queries(origins, sectors, origins + reach * (goal - origins))


SETS = {"things": things, "random": points, "near": near}
"""What games and mods ask."""
