"""Whether visibility misses a pair of sectors that a segment sees: `python -m benchmarks.visibility_missed`.

Segments between random points of every pair of sectors are asked of sight at `balanced`, which is exact. One that
starts in A and ends, by the rules of sight, in a sector that is not in A's set is missed: the exit status is 1. A
segment may also slip through a gap between surfaces, and then reaches points of sectors that it never entered: these
are counted apart (sight follows the surfaces as they are written, and so does visibility).
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from benchmarks.sight_queries import levels, through_edges
from jktools.geometry.mesh import SectorMesh
from jktools.model import Level

POOL = 1024
"""Points of each sector that segments are drawn from."""

EDGES = 20_000
"""Segments through edges and vertices, a level."""

Float64 = npt.NDArray[np.float64]
Bool = npt.NDArray[np.bool_]


class Sampled(NamedTuple):
    """What segments between the sectors of a level found."""

    seen: Bool
    """(n, n): a segment from a point of the row's sector sees a point of the column's."""
    segments: int
    missed: int
    """Segments that end in a sector that visibility denies."""
    slipped: int
    """Segments that see a point of a denied sector by a gap, without entering that sector."""


def pools(level: Level, mesh: SectorMesh, rng: np.random.Generator) -> list[Float64]:
    """Points inside each sector and no other; none for a sector where none is found."""
    table = level.document.sectors
    out = []
    for s in range(len(level.sectors)):
        own = level.vertices[table.vertex[table.vertex_start[s] : table.vertex_start[s + 1]]].astype(np.float64)
        if not len(own) or not level.sound_sectors[s]:
            out.append(np.zeros((0, 3)))
            continue
        points = rng.dirichlet(np.full(len(own), 0.4), POOL) @ own
        where = mesh.location(points)
        out.append(points[(where.sector == s) & (where.inside == 1)])
    return out


def sample(level: Level, visible: Bool, each: int, rng: np.random.Generator, every_pair: bool = True) -> Sampled:
    """Ask `each` segments a pair: of every pair, or of the denied ones alone."""
    mesh = SectorMesh.from_level(level)
    points = pools(level, mesh, rng)
    sizes, flat = np.array([len(p) for p in points]), np.concatenate(points)
    start, full = np.cumsum(sizes) - sizes, sizes > 0
    seen = np.zeros_like(visible)
    segments = missed = slipped = 0
    for a in np.flatnonzero(full).tolist():
        targets = np.flatnonzero(full if every_pair else full & ~visible[a])
        if not len(targets):
            continue
        column = np.repeat(targets, each)
        ends = flat[start[column] + (rng.random(len(column)) * sizes[column]).astype(np.intp)]
        origins = points[a][(rng.random(len(column)) * len(points[a])).astype(np.intp)]
        found = mesh.sight(origins, np.full(len(column), a, np.int32), ends).visible
        segments += len(column)
        seen[a, column[found]] = True
        for i in np.flatnonzero(found & ~visible[a, column]).tolist():
            last = mesh.explain(a, origins[i], ends[i]).steps[-1].sector
            if visible[a, last]:
                slipped += 1
            else:
                missed += 1
    return Sampled(seen, segments, missed, slipped)


def missed_through_edges(level: Level, visible: Bool, count: int, rng: np.random.Generator) -> int:
    """Count segments through (or close by) edges and vertices that enter a sector which visibility denies.

    Of those that see a point of a denied sector alone; the sectors of their whole way are looked at.
    """
    mesh = SectorMesh.from_level(level)
    queries = through_edges(level, count, rng)
    found = mesh.sight(*queries).visible
    there = mesh.locate(queries.targets)
    missed = 0
    for i in np.flatnonzero(found & (there >= 0) & ~visible[queries.sectors, there]).tolist():
        steps = mesh.explain(int(queries.sectors[i]), queries.origins[i], queries.targets[i]).steps
        missed += not all(visible[queries.sectors[i], step.sector] for step in steps)
    return missed


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--each", type=int, default=20, help="segments a pair of sectors")
    arguments.add_argument("--level", default="", help="levels whose name holds this")
    arguments.add_argument("--accuracy", default="balanced")
    arguments.add_argument("--denied", action="store_true", help="only pairs that visibility denies")
    arguments.add_argument("--seed", type=int, default=1997)
    options = arguments.parse_args()
    rng = np.random.default_rng(options.seed)
    missed = 0
    for name, level in levels():
        if options.level not in name:
            continue
        start = time.perf_counter()
        visible = SectorMesh.from_level(level).visibility(options.accuracy)
        found = sample(level, visible, options.each, rng, every_pair=not options.denied)
        edges = missed_through_edges(level, visible, EDGES, rng)
        missed += found.missed + edges
        pairs = "" if options.denied else f", {found.seen.sum() / visible.sum():.1%} of the visible pairs seen"
        print(
            f"{name}: {found.segments:,} segments, {found.missed} missed, {found.slipped} slipped through a gap{pairs},"
            f" {edges} of {EDGES:,} missed through edges"
            f" ({time.perf_counter() - start:.1f} s)",
            flush=True,
        )
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
