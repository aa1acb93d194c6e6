"""Ledges against a brute-force twin, over every level of the corpus: `python -m benchmarks.ledge_disagreement`.

The twin goes over each edge at evenly spread places, with the exact tiers of sight and drop, which share no code with
the ledges. It must meet what the interval there says, unless an end of the interval is nearer than the step between
places. The exit status is 1 if it does not anywhere.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from benchmarks.sight_queries import levels
from jktools.geometry import Ending, SectorMesh
from jktools.geometry.drop import ground_of
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker, Gait, Over
from jktools.geometry.mesh import BLOCKS, mesh_arrays
from jktools.model import Level

ON_EDGE = 1e-4
GAIT = Gait(0.120114, 0.065, 0.065, 5)
"""The player's on foot."""
SAME_DROP = 1e-6
"""JKU between the drops onto two surfaces that are one floor."""
SLOPING = 1.1 * BEYOND
"""JKU between the drop at the edge and the twin's, `BEYOND` past it, onto the same surface: what a slope of 45 degrees
rises on the way; steeper ones are measured where the twin does."""

ENDING = {
    Ending.FLOOR: Over.FLOOR, Ending.SOLID: Over.SOLID, Ending.WATER: Over.WATER, Ending.NOTHING: Over.VOID,
}  # fmt: skip

Float64 = npt.NDArray[np.float64]


class Seen(NamedTuple):
    """What the twin meets at one place."""

    over: Over
    met: int
    rise: int
    drop: float


class Twin:
    """A level as bodies pass through it, for exact sight and drop."""

    def __init__(self, level: Level) -> None:
        """Take its sectors; ways are those of movement."""
        positions, start, vertex, _, first, count = mesh_arrays(level)
        ground = ground_of(level)
        sound = np.append(level.sound_sectors, False)
        passes = np.where((ground.passes_to >= 0) & ~sound[ground.passes_to], -2, ground.passes_to)
        leads = np.where(passes >= 0, passes, BLOCKS)
        self.mesh = SectorMesh.from_arrays(
            positions.reshape(-1, 3), start, vertex, leads, first, count, passes, ground.under_water
        )
        self.level = level

    def go(self, sector: int, origin: Float64, target: Float64) -> int:
        """The sector at the end of a straight way, -1 where it is blocked."""
        way = self.mesh.explain(sector, origin, target)
        return way.steps[-1].sector if way.visible else -1

    def look(self, sector: int, here: Float64, out: Float64, slope: float, gait: Gait) -> Seen:
        """Go over the edge at `here` towards `out`, from a floor that rises by `slope` JKU a JKU that way."""
        inner = here - BEYOND * out + (0, 0, ON_EDGE - BEYOND * slope)
        for rise in range(gait.rises + 1):
            up = np.array((0, 0, gait.hover + rise * gait.rise))
            before, beyond = here - BEYOND * out + up, here + BEYOND * out + up
            lifted = self.go(sector, inner, before)
            if lifted < 0:
                break
            over = self.go(lifted, before, beyond)
            if over < 0:
                continue
            found = self.mesh.drop([beyond], [over], accuracy="exact")
            ending = ENDING[Ending(int(found.ending[0]))]
            return Seen(ending, int(found.met[0]), rise, float(found.distance[0]) - float(up[2]))
        return Seen(Over.BLOCKED, -1, 0, np.nan)


def slopes(level: Level, edges: EdgeWalker) -> tuple[Float64, Float64]:
    """The way out over each edge, (n, 3), and how its floor rises that way, JKU a JKU."""
    here, there = edges.ends(np.arange(len(edges.surface)))
    along = there - here
    out = np.stack([along[:, 1], -along[:, 0], np.zeros(len(along))], axis=1)
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)
    normals = np.zeros((len(edges.surface), 3))
    for i, surface in enumerate(edges.surface.tolist()):
        corners = level.surfaces[surface].positions.astype(np.float64)
        local = corners - corners[0]
        normals[i] = np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)
    return out, -(normals[:, :2] * out[:, :2]).sum(axis=1) / np.maximum(normals[:, 2], 1e-12)


class Disagreement(NamedTuple):
    """A place where both differ."""

    surface: int
    corner: int
    t: float
    said: str
    met: str


def compare(
    level: Level, edges: EdgeWalker, found: Beyond, gait: Gait, step: float, most: int
) -> tuple[int, list[Disagreement]]:
    """Look at places `step` JKU apart on up to `most` places in all, evenly chosen; count them, list what differs."""
    twin, (out, slope) = Twin(level), slopes(level, edges)
    here, there = edges.ends(np.arange(len(edges.surface)))
    length = np.linalg.norm((there - here)[:, :2], axis=1)
    places = [
        (edge, (k + 0.5) / parts)
        for edge, parts in enumerate(np.ceil(length / step).astype(int).tolist())
        for k in range(parts)
    ]
    asked = places[:: max(1, len(places) // most)]
    first = np.searchsorted(found.edge, np.arange(len(edges.surface) + 1))
    wrong = []
    for edge, t in asked:
        rows = slice(int(first[edge]), int(first[edge + 1]))
        if rows.start == rows.stop:
            continue
        row = rows.start + int(np.searchsorted(found.end[rows], t))
        ends = np.array([found.start[row], found.end[row]])
        inside = ends[(ends > 0) & (ends < 1)]
        if (np.abs(inside - t) * length[edge] <= step).any():
            continue
        point = here[edge] + t * (there[edge] - here[edge])
        seen = twin.look(int(level.surface_sector[edges.surface[edge]]), point, out[edge], float(slope[edge]), gait)
        if not _agree(found, row, t, seen):
            said = f"{Over(found.over[row]).name} {found.met[row]} rise {found.rise[row]} {_drop(found, row, t):.6g}"
            met = f"{seen.over.name} {seen.met} rise {seen.rise} {seen.drop:.6g}"
            wrong.append(Disagreement(int(edges.surface[edge]), int(edges.corner[edge]), t, said, met))
    return len(asked), wrong


def _drop(found: Beyond, row: int, t: float) -> float:
    start, end = float(found.start[row]), float(found.end[row])
    part = (t - start) / (end - start)
    return float(found.drop_start[row]) * (1 - part) + float(found.drop_end[row]) * part


def _agree(found: Beyond, row: int, t: float, seen: Seen) -> bool:
    over = Over(found.over[row])
    if over is not seen.over:
        return False
    if over in (Over.BLOCKED, Over.VOID):
        return True
    if int(found.rise[row]) != seen.rise:
        return False
    # A floor may go on in another surface at the same height.
    apart = abs(_drop(found, row, t) - seen.drop)
    if int(found.met[row]) == seen.met:
        return over is Over.WATER or apart <= SLOPING
    return apart <= SAME_DROP


def main() -> int:
    """Compare and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--step", type=float, default=0.02, help="JKU between places")
    parser.add_argument("--places", type=int, default=2000, help="places a level, evenly chosen among all")
    arguments = parser.parse_args()
    failed = 0
    for name, level in levels():
        edges = EdgeWalker(level)
        began = time.perf_counter()
        found = edges.beyond(GAIT)
        seconds = time.perf_counter() - began
        count, wrong = compare(level, edges, found, GAIT, arguments.step, arguments.places)
        failed += len(wrong)
        print(f"{name:40} {len(edges.surface):6} edges {seconds:6.2f} s {count:7} places {len(wrong):4} differ")
        for each in wrong[:5]:
            print("   ", each)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
