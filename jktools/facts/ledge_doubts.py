"""Where things leave open what an edge is: those that move, and those whose models are not at hand."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.facts.floors import Ball, Floors, Scene
from jktools.facts.intervals import cut_at, rows_at
from jktools.facts.ledge_kinds import Judged, Kind
from jktools.geometry.ledges import BEYOND, EdgeWalker

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]

_BALLS_UNDER = (Kind.SEAMLESS, Kind.FALL, Kind.WATER, Kind.NONE)
"""Kinds with a way down, on which a thing without a model may carry."""


def near(edges: EdgeWalker, floors: Floors, scene: Scene, reach: float) -> Int32:
    """The rows of edges within `reach` JKU, seen from above, of what a scene changes; those of what moves left out."""
    low, high = np.minimum(edges.here, edges.there)[:, :2], np.maximum(edges.here, edges.there)[:, :2]
    close = np.zeros(len(low), np.bool_)
    for number in np.flatnonzero(scene.moved).tolist():
        platform = floors.platforms[number]
        close |= ((low <= platform.high[:2] + reach) & (high >= platform.low[:2] - reach)).all(axis=1)
    still = np.append(scene.present & ~scene.moved, True)[edges.solid]
    return np.flatnonzero(close & still).astype(np.int32)


def set_against(whole: Judged, moved: Judged, thing: int) -> Judged:
    """Leave open what is of another kind when a thing has moved; `moved` are the edges near it, judged then."""
    if not len(moved.kind):
        return whole
    pieces, rows = cut_at(whole.found, moved.found.edge, moved.found.end)
    whole = whole.of_pieces(pieces, rows)
    then = rows_at(moved.found, pieces.edge, (pieces.start + pieces.end) / 2)
    same_edge = moved.found.edge[then] == pieces.edge
    own = same_edge & (moved.kind[then] != whole.kind) & (whole.thing < 0)
    other = same_edge & (moved.other[then] != whole.other) & (whole.other_thing < 0)
    return whole._replace(
        thing=np.where(own, np.int32(thing), whole.thing),
        other_thing=np.where(other, np.int32(thing), whole.other_thing),
    )


def under_balls(whole: Judged, edges: EdgeWalker, floors: Floors) -> Judged:
    """Leave open what has a way down through the ball of a thing whose model is not at hand."""
    shadows = [shadow for ball in floors.balls if (shadow := _Shadow.of(ball, edges)) is not None]
    if not shadows:
        return whole
    cuts = [(np.tile(each.edge, 2), np.concatenate([each.start, each.end])) for each in shadows]
    pieces, rows = cut_at(whole.found, *(np.concatenate(column) for column in zip(*cuts, strict=True)))
    whole = whole.of_pieces(pieces, rows)
    first = np.searchsorted(pieces.edge, np.arange(len(edges.surface) + 1))
    thing, other_thing = whole.thing.copy(), whole.other_thing.copy()
    for shadow in shadows:
        count = first[shadow.edge + 1] - first[shadow.edge]
        of = np.repeat(np.arange(len(shadow.edge)), count)
        at = np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count) + first[shadow.edge][of]
        crossed = at[shadow.crossed(pieces.start[at], pieces.end[at], of, _bottom(whole, at))]
        for column, kind in ((thing, whole.kind), (other_thing, whole.other)):
            open_now = crossed[(column[crossed] < 0) & np.isin(kind[crossed], _BALLS_UNDER)]
            column[open_now] = shadow.thing
    return whole._replace(thing=thing, other_thing=other_thing)


def _bottom(whole: Judged, rows: npt.NDArray[np.intp]) -> Float64:
    """How deep the way down goes from the edge; without end where nothing is below."""
    found = whole.found
    drop = np.fmax(found.drop_start[rows], found.drop_end[rows])
    return np.where(np.isnan(drop), np.inf, np.maximum(drop, 0))


class _Shadow:
    """What of the edges near a ball has the ball below or beside it, `BEYOND` past the edge."""

    def __init__(self, ball: Ball, edges: EdgeWalker, rows: npt.NDArray[np.intp]) -> None:
        self.thing, self.edge = ball.thing.index, rows
        here, along = edges.here[rows], (edges.there - edges.here)[rows]
        self.length = np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-12)
        away = np.array(ball.centre)[:2] - here[:, :2]
        self.middle = (away * along[:, :2]).sum(axis=1) / self.length**2
        off = (away[:, 0] * along[:, 1] - away[:, 1] * along[:, 0]) / self.length - BEYOND
        self.radius = np.sqrt(np.maximum(ball.radius**2 - off**2, 0.0))
        self.start, self.end = (self.middle + side * self.radius / self.length for side in (-1, 1))
        self.height = ball.centre[2] - here[:, 2]
        self.slope = along[:, 2]

    @classmethod
    def of(cls, ball: Ball, edges: EdgeWalker) -> _Shadow | None:
        reach, centre = ball.radius + BEYOND, np.array(ball.centre)[:2]
        low, high = np.minimum(edges.here, edges.there)[:, :2], np.maximum(edges.here, edges.there)[:, :2]
        rows = np.flatnonzero(((low <= centre + reach) & (high >= centre - reach)).all(axis=1))
        found = cls(ball, edges, rows)
        kept = found.radius > 0
        return cls(ball, edges, rows[kept]) if kept.any() else None

    def crossed(self, start: Float64, end: Float64, of: npt.NDArray[np.intp], bottom: Float64) -> Bool:
        """Whether the way down from pieces of edges, row `of` of them, comes through the ball, by its heights there."""
        middle = (start + end) / 2
        inside = (self.start[of] < middle) & (middle < self.end[of])
        nearest = np.clip(self.middle[of], start, end)
        aside = (nearest - self.middle[of]) * self.length[of]
        half = np.sqrt(np.maximum(self.radius[of] ** 2 - aside**2, 0.0))
        heights = [self.height[of] - place * self.slope[of] for place in (start, end)]
        lowest, highest = np.minimum(*heights) - half, np.maximum(*heights) + half
        return np.asarray(inside & (lowest < 0) & (highest > -bottom))
