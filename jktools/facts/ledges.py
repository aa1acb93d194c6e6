"""Ledges: what a walking body meets beyond each edge of each floor, as intervals along the edge.

Research document, "Descending From Height", measured what rows of pits do to one body; here it is worked out for every
edge of a level and every body that walks there.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.engine.profile import Engine
from jktools.facts.bodies import Walker
from jktools.facts.floors import Floors, Scene
from jktools.facts.intervals import take
from jktools.facts.ledge_doubts import near, set_against, under_balls
from jktools.facts.ledge_kinds import DOWN, WALKED, Judged, Kind, Limits, joined, judge
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker, Gait, Over
from jktools.model import Level

__all__ = ["DOWN", "WALKED", "Kind", "Ledges", "Limits", "counts", "ledges_of"]

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

AI_NO_WALK = 0x8
"""Surface flag: the engine's AI does not walk there."""
AI_MAXSTEP = 0.5
"""JKU: how far down the engine's AI takes a floor to be one, when its class does not say."""
SAMPLES = 8
"""Places an edge that the tier `fast` looks at."""
MOST_RISES = 64
"""Heights at which a jump over a wall is tried; beyond, a jump that high is not followed."""
STRAIGHT = 1e-9
"""JKU: drops that lie this close to one line are one interval."""


@dataclass(frozen=True, slots=True)
class Ledges:
    """The intervals of all edges of floors and things for one body, in the order of edges and along them; (n,) each."""

    walker: Walker
    engine: Engine
    edges: EdgeWalker
    floors: Floors
    edge: Int32
    start: Float64
    end: Float64
    """0 .. 1 along the edge."""
    kind: UInt8
    """A `Kind`, by the profile asked for."""
    other: UInt8
    """By the other profile."""
    below: Int32
    """The surface come onto, or that blocks; -1 for none."""
    face: Int32
    """The face of a thing come onto, or that blocks, of `EdgeWalker.solids`; -1 for none."""
    sector: Int32
    thing: Int32
    """Index of the thing that makes it UNKNOWN, -1 for none."""
    drop_start: Float64
    drop_end: Float64
    """From the edge down, JKU; NaN where there is nothing to come onto."""
    narrow: Bool
    """The place below is narrower than the body."""
    ai_stops: Bool
    """The engine's AI does not walk over it."""

    def __len__(self) -> int:
        return len(self.edge)

    @property
    def of_level(self) -> Bool:
        """Whether the edge is a surface's, not a thing's."""
        return np.asarray(self.surface >= 0)

    @property
    def surface(self) -> Int32:
        """The floor whose edge it is; -1 where it is a thing's."""
        return self.edges.surface[self.edge]

    @property
    def corner(self) -> Int32:
        """Which edge of the floor, or of the thing's face."""
        return self.edges.corner[self.edge]

    @property
    def carrier(self) -> Int32:
        """The platform whose edge it is, -1 for a surface's."""
        return self.edges.solid[self.edge]

    @property
    def carrier_thing(self) -> Int32:
        """Index of the thing whose edge it is, -1 for a surface's."""
        return self.floors.thing_of(self.carrier)

    @property
    def carrier_frame(self) -> Int32:
        """Where that thing is: PLACED, or which of its frames."""
        return self.floors.frame_of(self.carrier)

    @property
    def carrier_face(self) -> Int32:
        """Which face of its model at rest (`RestPose`), -1 for a surface's."""
        return self._of_model(self.edges.face[self.edge])

    @property
    def onto(self) -> Int32:
        """Index of the thing come onto, or that blocks; -1 for none."""
        return self.floors.thing_of(np.append(self.edges.solids.face_solid, np.int32(-1))[self.face])

    @property
    def onto_face(self) -> Int32:
        """Which face of its model at rest, -1 for none."""
        return self._of_model(self.face)

    def _of_model(self, faces: Int32) -> Int32:
        solids = self.edges.solids
        first = np.searchsorted(solids.face_solid, np.arange(solids.total)).astype(np.int32)
        owner = np.append(solids.face_solid, np.int32(-1))[faces]
        return np.where(faces < 0, -1, faces - np.append(first, 0)[owner]).astype(np.int32)

    @property
    def length(self) -> Float64:
        """Of each interval, JKU."""
        here, there = self.edges.ends(self.edge)
        return np.asarray(np.linalg.norm(there - here, axis=1) * (self.end - self.start))

    @property
    def deepest(self) -> Float64:
        """The greater drop of both ends."""
        return np.fmax(self.drop_start, self.drop_end)

    @property
    def least(self) -> Float64:
        """The lesser drop of both ends."""
        return np.fmin(self.drop_start, self.drop_end)

    def spread(self) -> Float64:
        """How far the drops of all intervals of an edge that lead down to one floor or up to it differ, JKU."""
        _, way = np.unique(np.stack([self.edge, self.below, self.face]), axis=1, return_inverse=True)
        way = way.reshape(-1)
        most, least = np.full(len(self), -np.inf), np.full(len(self), np.inf)
        np.fmax.at(most, way, self.deepest)
        np.fmin.at(least, way, self.least)
        return np.asarray((most - least)[way])

    def middle(self, row: int) -> tuple[float, float, float]:
        """A point of the edge, JKU."""
        (here,), (there,) = self.edges.ends([self.edge[row]])
        x, y, z = here + (there - here) * (self.start[row] + self.end[row]) / 2
        return float(x), float(y), float(z)


def ledges_of(
    level: Level,
    edges: EdgeWalker,
    walker: Walker,
    floors: Floors,
    engine: Engine = Engine.RESEARCH,
    accuracy: str = "balanced",
    threads: int = 0,
) -> Ledges:
    """Work out the ledges of a level for one body whose hover height is known; `edges` must have the floors' solids.

    Each thing that moves is looked at where it is placed and at each of its frames, while the others are as they are
    placed: an edge that is not of one kind then is UNKNOWN there, and so is one with a way down through the ball of a
    thing whose model is not at hand. The edges of a thing at a frame are judged with the thing there.
    """
    radius = walker.body.movesize
    shallow = min(min(walker.hover(each), walker.reattach(each)) for each in Engine)
    rises = math.ceil(min(walker.apex() / radius, MOST_RISES)) if walker.comes_down else 0
    gait = Gait(walker.hover(engine), radius, radius, rises, shallow)

    def judged(scene: Scene, rows: Int32) -> Judged:
        samples = SAMPLES if accuracy == "fast" else 0
        found = edges.beyond(gait, samples, threads, edges=rows, present=scene.present, exact=accuracy == "exact")
        return judge(found, walker, engine)

    placed, *moved = floors.scenes()
    whole = judged(placed, edges.edges_of(placed.present))
    further = []
    for scene in moved:
        around = near(edges, floors, scene, 2 * radius + BEYOND)
        own = np.flatnonzero(np.append(scene.moved & scene.present & ~placed.present, False)[edges.solid])
        then = judged(scene, np.sort(np.concatenate([around, own.astype(np.int32)])))
        its_own = np.isin(then.found.edge, own)
        further.append(then.part(its_own))
        whole = set_against(whole, then.part(~its_own), scene.thing)
    parts = [under_balls(whole, edges, floors), *further]
    return _ledges(level, walker, engine, edges, floors, joined(parts))


def _ledges(level: Level, walker: Walker, engine: Engine, edges: EdgeWalker, floors: Floors, judged: Judged) -> Ledges:
    kinds = [
        np.where(thing >= 0, np.uint8(Kind.UNKNOWN), kind)
        for thing, kind in ((judged.thing, judged.kind), (judged.other_thing, judged.other))
    ]
    thing = np.where(judged.thing >= 0, judged.thing, judged.other_thing)
    stops = _ai_stops(level, judged.found, walker)
    found, rows = _merged(judged.found, [*kinds, judged.narrow, thing, stops])
    return Ledges(
        walker, engine, edges, floors, found.edge, found.start, found.end, kinds[0][rows], kinds[1][rows], found.met,
        found.face, found.sector, thing[rows], found.drop_start, found.drop_end, judged.narrow[rows], stops[rows],
    )  # fmt: skip


def _merged(found: Beyond, others: list[npt.NDArray[Any]]) -> tuple[Beyond, npt.NDArray[np.intp]]:
    """Join neighbours that differ in nothing, their drops on one line; also the first row of each."""
    if not len(found.edge):
        return found, np.zeros(0, np.intp)
    same = found.end[:-1] == found.start[1:]
    columns: list[npt.NDArray[Any]] = [
        found.edge, found.over, found.met, found.face, found.sector, found.rise, *others
    ]  # fmt: skip
    for column in columns:
        same &= column[:-1] == column[1:]
    width = found.end - found.start
    change = found.drop_end - found.drop_start
    part = width[:-1] / (width[:-1] + width[1:])
    straight = np.abs(change[:-1] - part * (change[:-1] + change[1:])) <= STRAIGHT
    touching = np.abs(found.drop_end[:-1] - found.drop_start[1:]) <= STRAIGHT
    empty = np.isnan(change)
    same &= (straight & touching) | (empty[:-1] & empty[1:])
    first = np.flatnonzero(np.append(True, ~same))
    last = np.append(first[1:], len(width)) - 1
    return take(found, first)._replace(end=found.end[last], drop_end=found.drop_end[last]), first


def _ai_stops(level: Level, found: Beyond, walker: Walker) -> Bool:
    """Where the AI refuses: no floor within hover + maxstep of its centre, or a floor flagged against it."""
    if walker.body.player:
        return np.zeros(len(found.edge), np.bool_)
    flags = np.append(level.document.surfaces.flags, 0)[found.met]
    deepest = np.fmax(found.drop_start, found.drop_end)
    no_floor = (found.over != Over.FLOOR) | (found.rise > 0) | ~(deepest <= AI_MAXSTEP)
    return np.asarray(no_floor | ((flags & AI_NO_WALK) != 0))


def counts(ledges: Ledges) -> Mapping[Kind, int]:
    """How many intervals of each kind."""
    found = np.bincount(ledges.kind, minlength=len(Kind))
    return {kind: int(found[kind]) for kind in Kind}
