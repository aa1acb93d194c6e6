"""Things that bodies can stand on, as places where nothing can be said of what lies below an edge.

A thing with thing flag 0x40 carries bodies on its faces (lifts, bridges, crates). Here each is the ball of its size, at
its place and all along its frames: whether one of its faces is there is not worked out.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.geometry.ledges import Beyond, EdgeWalker
from jktools.model import Level, Thing

Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]

STANDABLE = 0x40
"""Thing flag: bodies stand on it."""
SIZE_UNKNOWN = 2.0
"""JKU: what is taken for the size of a thing that neither says it nor has its model at hand; that of a large lift."""
MOST_PLACES = 256
"""Places of one thing along its frames; beyond, they lie farther apart than half its size."""


class Platforms:
    """The things of a level that bodies can stand on, with all places that they come to."""

    def __init__(self, level: Level) -> None:
        """Find them."""
        places: list[Float64] = []
        things: list[int] = []
        sizes: list[float] = []
        self.guessed: list[Thing] = []
        """Those whose size is not known."""
        for thing in level.things:
            if thing.dropped is not None or not thing.resolved.flags("thingflags") & STANDABLE:
                continue
            size = thing.resolved.values.get("size")
            if size is not None and isinstance(size.value, float):
                reach = size.value
            else:
                reach = SIZE_UNKNOWN
                self.guessed.append(thing)
            stops = _stops(thing)
            along = _spread(stops, reach / 2)
            places.append(along)
            things += [thing.index] * len(along)
            sizes += [reach] * len(along)
        self.place: Float64 = np.concatenate(places) if places else np.zeros((0, 3))
        self.thing: Int32 = np.array(things, np.int32)
        self.size: Float64 = np.array(sizes, np.float64)

    def near(self, edges: EdgeWalker, found: Beyond) -> Int32:
        """For each interval, (n,), a thing that may lie between the edge and what is below, -1 for none."""
        near = np.full(len(found.edge), -1, np.int32)
        here, there = edges.ends(found.edge)
        first, last = (here + (there - here) * part[:, None] for part in (found.start, found.end))
        top = np.maximum(first[:, 2], last[:, 2])
        drop = np.fmax(found.drop_start, found.drop_end)
        bottom = np.minimum(first[:, 2], last[:, 2]) - np.where(np.isnan(drop), np.inf, np.maximum(drop, 0))
        for place, size, thing in zip(self.place, self.size, self.thing, strict=True):
            level = (place[2] - size <= top) & (place[2] + size >= bottom)
            along = (last - first)[:, :2]
            square = np.maximum((along * along).sum(axis=1), 1e-12)
            part = np.clip(((place[:2] - first[:, :2]) * along).sum(axis=1) / square, 0, 1)
            apart = np.hypot(*(first[:, :2] + along * part[:, None] - place[:2]).T)
            near[level & (apart <= size) & (near < 0)] = thing
        return near


def _stops(thing: Thing) -> Float64:
    """Where a thing is placed, and its frames."""
    stops = [thing.position.astype(np.float64)]
    frames = thing.resolved.values.get("frame")
    if frames is not None and isinstance(frames.value, tuple):
        stops += [np.array(frame[:3], np.float64) for frame in frames.value if isinstance(frame, tuple)]
    return np.array([stop for stop in stops if np.isfinite(stop).all()], np.float64).reshape(-1, 3)


def _spread(stops: Float64, apart: float) -> Float64:
    """Places along the way from stop to stop, no farther apart than asked where that does not take too many."""
    if len(stops) < 2:
        return stops
    legs = np.linalg.norm(np.diff(stops, axis=0), axis=1)
    apart = max(apart, float(legs.sum()) / MOST_PLACES, 1e-3)
    parts = [
        here + (there - here) * np.linspace(0, 1, int(leg / apart) + 2)[:, None]
        for here, there, leg in zip(stops, stops[1:], legs, strict=False)
    ]
    return np.concatenate(parts)
