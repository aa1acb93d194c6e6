"""Ledges against a brute-force twin, over every level of the corpus: `python -m benchmarks.ledge_disagreement`.

The twin goes over each edge at evenly spread places, with the exact tiers of sight and drop, which share no code with
the ledges, and among the faces of things, each set against the way in rational numbers. It must meet what the interval
there says, unless an end of the interval is nearer than the step between places: with all things as they are placed,
and with each moving thing at each of its frames. The exit status is 1 if it does not anywhere.
"""

from __future__ import annotations

import argparse
import sys
import time
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from benchmarks.sight_queries import levels
from jktools.engine import orientation
from jktools.facts.floors import GONE, PLACED, Floors, Scene
from jktools.facts.ledge_doubts import near
from jktools.geometry import Ending, SectorMesh
from jktools.geometry.drop import ground_of
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker, Gait, Over
from jktools.geometry.mesh import BLOCKS, mesh_arrays
from jktools.geometry.rest_pose import rest_pose
from jktools.model import Level, Thing

ON_FACE = 1e-4
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


Exact = tuple[Fraction, Fraction, Fraction]


class Seen(NamedTuple):
    """What the twin meets at one place."""

    over: Over
    met: int
    on_thing: bool
    rise: int
    drop: float


class Faces:
    """The triangles of all things that bodies stand on, as the level places them, but one at a frame."""

    def __init__(self, level: Level, thing: int, frame: int) -> None:
        """Take them from the models; `frame` is where thing number `thing` is, GONE for nowhere."""
        fans: list[Float64] = []
        carries: list[bool] = []
        for each in level.things:
            if not _stands(each) or (each.index == thing and frame == GONE):
                continue
            model = level.resources.model(each.resolved.name_in("model3d") or "none")
            if model is None:
                continue
            pose = rest_pose(model)
            place = [*each.position.tolist(), *each.angles.tolist()]
            if each.index == thing and frame != PLACED:
                place = list(each.resolved.values["frame"].value[frame])  # type: ignore[index]
            turn = orientation.matrix(np.array(place[3:], np.float64))
            upright = (pose.normal.astype(np.float64) @ turn.T)[:, 2] >= 0.6
            if not upright.any():
                continue
            vertices = pose.vertices.astype(np.float64) @ turn.T + np.array(place[:3], np.float64)
            for face, (start, end) in enumerate(pairwise(pose.corner_start.tolist())):
                ring = vertices[pose.corner_vertex[start:end]]
                for b, c in pairwise(ring[1:]):
                    fans.append(np.array([ring[0], b, c]))
                    carries.append(bool(upright[face]))
        self.fans = np.array(fans, np.float64).reshape(-1, 3, 3)
        self.carries = np.array(carries, np.bool_)
        self.low, self.high = self.fans.min(axis=1), self.fans.max(axis=1)

    def stop(self, origin: Float64, target: Float64) -> bool:
        """Whether a straight way passes through one of them, from either side."""
        low, high = np.minimum(origin, target), np.maximum(origin, target)
        near = ((self.low <= high) & (self.high >= low)).all(axis=1)
        return any(_pierces(_exact(origin), _exact(target), *map(_exact, self.fans[i])) for i in np.flatnonzero(near))

    def depth(self, point: Float64) -> Fraction | None:
        """How far below a point the first of them that carries lies."""
        x, y, z = _exact(point)
        inside = (self.low[:, :2] <= point[:2]) & (self.high[:, :2] >= point[:2])
        near = inside.all(axis=1) & (self.low[:, 2] <= point[2]) & self.carries
        found = (_height(x, y, *map(_exact, self.fans[i])) for i in np.flatnonzero(near))
        return min((z - height for height in found if height is not None and height <= z), default=None)


def _stands(thing: Thing) -> bool:
    held = thing.resolved
    return (
        thing.dropped is None and held.type == "cog" and held.number("collide") == 3
        and held.flags("thingflags") & 0x80042 == 0x40 and bool(np.isfinite([*thing.position, *thing.angles]).all())
    )  # fmt: skip


def _exact(p: Float64) -> Exact:
    x, y, z = (Fraction(v) for v in p.tolist())
    return x, y, z


def _height(x: Fraction, y: Fraction, a: Exact, b: Exact, c: Exact) -> Fraction | None:
    """The height of a triangle that faces up over a place that it holds, by barycentric coordinates."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    if area <= 0:
        return None
    v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
    w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
    if v < 0 or w < 0 or v + w > 1:
        return None
    return a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])


def _pierces(p: Exact, q: Exact, a: Exact, b: Exact, c: Exact) -> bool:
    """Whether a segment passes through a triangle, by Cramer's rule for p + t (q - p) = a + v (b - a) + w (c - a)."""
    way, first, second, away = (
        tuple(j - i for i, j in zip(*ends, strict=True)) for ends in ((p, q), (a, b), (a, c), (a, p))
    )
    base = _triple(way, first, second)
    if base == 0:
        return False
    t = -_triple(away, first, second) / base
    v, w = _triple(way, away, second) / base, _triple(way, first, away) / base
    return 0 < t < 1 and v >= 0 and w >= 0 and v + w <= 1


def _triple(a: tuple[Fraction, ...], b: tuple[Fraction, ...], c: tuple[Fraction, ...]) -> Fraction:
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])


class Twin:
    """A level as bodies pass through it, for exact sight and drop."""

    def __init__(self, level: Level, thing: int = -1, frame: int = PLACED) -> None:
        """Take its sectors, whose ways are those of movement, and its things, one of them at a frame."""
        positions, start, vertex, _, first, count = mesh_arrays(level)
        ground = ground_of(level)
        sound = np.append(level.sound_sectors, False)
        passes = np.where((ground.passes_to >= 0) & ~sound[ground.passes_to], -2, ground.passes_to)
        leads = np.where(passes >= 0, passes, BLOCKS)
        self.mesh = SectorMesh.from_arrays(
            positions.reshape(-1, 3), start, vertex, leads, first, count, passes, ground.under_water
        )
        self.faces = Faces(level, thing, frame)
        self.level = level

    def go(self, sector: int, origin: Float64, target: Float64) -> int:
        """The sector at the end of a straight way, -1 where it is blocked."""
        way = self.mesh.explain(sector, origin, target)
        return way.steps[-1].sector if way.visible and not self.faces.stop(origin, target) else -1

    def look(self, sector: int, here: Float64, out: Float64, slope: float, gait: Gait) -> Seen:
        """Go over the edge at `here` towards `out`, from a floor that rises by `slope` JKU a JKU that way.

        The sector is the floor's; -1 for the edge of a thing, whose own is looked for.
        """
        inner = here - BEYOND * out + (0, 0, (ON_FACE if sector < 0 else 0.0) - BEYOND * slope)
        home = int(self.mesh.locate([inner])[0]) if sector < 0 else sector
        if home < 0:
            return Seen(Over.BLOCKED, -1, False, 0, np.nan)
        for rise in range(gait.rises + 1):
            up = np.array((0, 0, gait.hover + rise * gait.rise))
            before, beyond = here - BEYOND * out + up, here + BEYOND * out + up
            lifted = self.go(home, inner, before)
            if lifted < 0:
                break
            over = self.go(lifted, before, beyond)
            if over < 0:
                continue
            found = self.mesh.drop([beyond], [over], accuracy="exact")
            on = self.faces.depth(beyond)
            if on is not None and on < float(found.distance[0]):
                return Seen(Over.FLOOR, -1, True, rise, float(on) - float(up[2]))
            ending = ENDING[Ending(int(found.ending[0]))]
            return Seen(ending, int(found.met[0]), False, rise, float(found.distance[0]) - float(up[2]))
        return Seen(Over.BLOCKED, -1, False, 0, np.nan)


def slopes(level: Level, edges: EdgeWalker) -> tuple[Float64, Float64]:
    """The way out over each edge, (n, 3), and how its floor rises that way, JKU a JKU."""
    along = edges.there - edges.here
    out = np.stack([along[:, 1], -along[:, 0], np.zeros(len(along))], axis=1)
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)
    normals = np.zeros((len(edges.surface), 3))
    solids = edges.solids
    for i, (surface, face) in enumerate(zip(edges.surface.tolist(), edges.face.tolist(), strict=True)):
        if surface >= 0:
            corners = level.surfaces[surface].positions.astype(np.float64)
        else:
            corners = solids.positions[solids.face_vertex[solids.face_start[face] : solids.face_start[face + 1]]]
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
    level: Level, edges: EdgeWalker, found: Beyond, gait: Gait, step: float, most: int, twin: Twin | None = None
) -> tuple[int, list[Disagreement]]:
    """Look at places `step` JKU apart on up to `most` places in all, evenly chosen; count them, list what differs."""
    twin, (out, slope) = twin or Twin(level), slopes(level, edges)
    here, there = edges.here, edges.there
    length = np.linalg.norm((there - here)[:, :2], axis=1)
    asked_about = np.unique(found.edge).tolist()
    parts = np.ceil(length / step).astype(int)
    places = [(edge, (k + 0.5) / parts[edge]) for edge in asked_about for k in range(int(parts[edge]))]
    asked = places[:: max(1, len(places) // most)]
    first = np.searchsorted(found.edge, np.arange(len(edges.surface) + 1))
    wrong = []
    for edge, t in asked:
        rows = slice(int(first[edge]), int(first[edge + 1]))
        row = rows.start + int(np.searchsorted(found.end[rows], t))
        ends = np.array([found.start[row], found.end[row]])
        inside = ends[(ends > 0) & (ends < 1)]
        if (np.abs(inside - t) * length[edge] <= step).any():
            continue
        point = here[edge] + t * (there[edge] - here[edge])
        surface = int(edges.surface[edge])
        sector = int(level.surface_sector[surface]) if surface >= 0 else -1
        seen = twin.look(sector, point, out[edge], float(slope[edge]), gait)
        if not _agree(found, row, t, seen):
            said = f"{Over(found.over[row]).name} {found.met[row]} {found.face[row]} rise {found.rise[row]} "
            met = f"{seen.over.name} {seen.met} {seen.on_thing} rise {seen.rise} {seen.drop:.6g}"
            said += f"{_drop(found, row, t):.6g}"
            owner = surface if surface >= 0 else -2 - int(edges.face[edge])
            wrong.append(Disagreement(owner, int(edges.corner[edge]), t, said, met))
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
    if int(found.met[row]) == seen.met and (found.face[row] >= 0) == seen.on_thing:
        return over is Over.WATER or apart <= SLOPING
    return apart <= SAME_DROP


def scenes(edges: EdgeWalker, floors: Floors) -> list[tuple[Scene, npt.NDArray[np.int32]]]:
    """The ways in which the things can be, with the edges that are asked about then."""
    placed, *moved = floors.scenes()
    found = [(placed, edges.edges_of(placed.present))]
    for scene in moved:
        own = np.flatnonzero(np.append(scene.moved & scene.present, False)[edges.solid])
        rows = np.unique(np.concatenate([near(edges, floors, scene, 2 * GAIT.radius), own]))
        found.append((scene, rows.astype(np.int32)))
    return found


def main() -> int:
    """Compare and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--step", type=float, default=0.02, help="JKU between places")
    parser.add_argument("--places", type=int, default=2000, help="places a level, evenly chosen among all")
    arguments = parser.parse_args()
    failed = 0
    for name, level in levels():
        floors = Floors.of(level)
        edges = EdgeWalker(level, floors.solids())
        ways = scenes(edges, floors)
        seconds, count, wrong = 0.0, 0, []
        for scene, rows in ways:
            began = time.perf_counter()
            found = edges.beyond(GAIT, edges=rows, present=scene.present)
            seconds += time.perf_counter() - began
            most = max(10, arguments.places // (1 if scene.thing < 0 else len(ways)))
            asked, differ = compare(
                level, edges, found, GAIT, arguments.step, most, Twin(level, scene.thing, scene.frame)
            )
            count += asked
            wrong += differ
        failed += len(wrong)
        print(
            f"{name:40} {len(edges.surface):6} edges {seconds:6.2f} s {len(ways):3} scenes {count:7} places "
            f"{len(wrong):4} differ",
            flush=True,
        )
        for each in wrong[:5]:
            print("   ", each)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
