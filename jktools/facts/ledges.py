"""Ledges: what a walking body meets beyond each edge of each floor, as intervals along the edge.

Research document, "Descending From Height", measured what rows of pits do to one body; here it is worked out for every
edge of a level and every body that walks there.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.profile import Engine
from jktools.facts.bodies import Walker
from jktools.facts.platforms import Platforms
from jktools.geometry.exact_ledges import ExactLedges
from jktools.geometry.ledges import Beyond, EdgeWalker, Gait, Over
from jktools.model import Level

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

LEVEL_WITHIN = 1e-4
"""JKU: floors this close in height are one level; seams of real levels differ by 1e-6."""
AI_NO_WALK = 0x8
"""Surface flag: the engine's AI does not walk there."""
AI_MAXSTEP = 0.5
"""JKU: how far down the engine's AI takes a floor to be one, when its class does not say."""
SAMPLES = 8
"""Places an edge that the tier `fast` looks at."""
MOST_RISES = 64
"""Heights at which a jump over a wall is tried; beyond, a jump that high is not followed."""


class Kind(enum.IntEnum):
    """What an interval of an edge is to a body."""

    LEVEL = 0
    SEAMLESS = 1
    """Down, and the body stays attached."""
    FALL = 2
    WATER = 3
    NONE = 4
    """Down to no floor: something without the floor flag, or nothing at all."""
    STEP = 5
    """Up, and the sphere passes over it."""
    LIP = 6
    """Up, and the sphere meets its edge: it slides up if it is fast enough."""
    JUMP = 7
    """Up or over, by a jump."""
    WALL = 8
    UNKNOWN = 9
    """A thing that bodies can stand on may be there, and its faces are not known."""


DOWN = (Kind.SEAMLESS, Kind.FALL)
WALKED = (Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.LIP)
"""Kinds that a body passes without a jump and without letting go."""


@dataclass(frozen=True, slots=True)
class Ledges:
    """The intervals of all floor edges for one body, in the order of edges and along them; (n,) each."""

    walker: Walker
    engine: Engine
    edges: EdgeWalker
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
    sector: Int32
    thing: Int32
    """Index of the thing that makes it UNKNOWN, -1 for none."""
    drop_start: Float64
    drop_end: Float64
    """From the edge down, JKU; NaN where there is nothing to come onto."""
    narrow: Bool
    """The place below is narrower than the body, as far as the middle of the interval tells."""
    ai_stops: Bool
    """The engine's AI does not walk over it."""

    def __len__(self) -> int:
        return len(self.edge)

    @property
    def surface(self) -> Int32:
        """The floor whose edge it is."""
        return self.edges.surface[self.edge]

    @property
    def corner(self) -> Int32:
        """Which edge of the floor."""
        return self.edges.corner[self.edge]

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

    def middle(self, row: int) -> tuple[float, float, float]:
        """A point of the edge, JKU."""
        (here,), (there,) = self.edges.ends([self.edge[row]])
        x, y, z = here + (there - here) * (self.start[row] + self.end[row]) / 2
        return float(x), float(y), float(z)


class Limits(NamedTuple):
    """What decides about a drop or a rise, JKU, in one profile."""

    hover: float
    reattach: float
    clearance: float
    jump: float

    @classmethod
    def of(cls, walker: Walker, engine: Engine) -> Limits:
        """Those of a body."""
        hover, clearance = walker.hover(engine), walker.clearance(engine)
        return cls(hover, walker.reattach(engine), clearance, walker.apex() + clearance)


def ledges_of(
    level: Level,
    edges: EdgeWalker,
    walker: Walker,
    platforms: Platforms,
    engine: Engine = Engine.RESEARCH,
    accuracy: str = "balanced",
    threads: int = 0,
) -> Ledges:
    """Work out the ledges of a level for one body whose hover height is known."""
    limits = {each: Limits.of(walker, each) for each in Engine}
    own = limits[engine]
    radius = walker.body.movesize
    rises = math.ceil(min(walker.apex() / radius, MOST_RISES))
    gait = Gait(own.hover, radius, radius, rises)
    if accuracy == "exact":
        found = ExactLedges(level, edges).beyond(gait)
    else:
        found = edges.beyond(gait, SAMPLES if accuracy == "fast" else 0, threads)
    cuts = sorted({0.0} | {c for each in limits.values() for c in _thresholds(each)})
    found = _cut(found, cuts)
    kinds = {each: _classed(found, limits[each], walker, each) for each in Engine}
    down = np.isin(kinds[engine], (Kind.FALL, Kind.NONE, Kind.WATER))
    thing = np.full(len(found.edge), -1, np.int32)
    thing[down] = platforms.near(edges, Beyond(**{name: column[down] for name, column in found._asdict().items()}))
    narrow = down & ~(np.fmin(found.past, found.far) > own.reattach)
    for kind in kinds.values():
        kind[thing >= 0] = Kind.UNKNOWN
    (other,) = set(Engine) - {engine}
    return Ledges(
        walker, engine, edges, found.edge, found.start, found.end, kinds[engine], kinds[other], found.met,
        found.sector, thing, found.drop_start, found.drop_end, narrow, _ai_stops(level, found, walker),
    )  # fmt: skip


def _thresholds(limits: Limits) -> tuple[float, ...]:
    return (limits.hover, limits.reattach, -limits.clearance, -limits.hover, -limits.jump)


def _cut(found: Beyond, cuts: list[float]) -> Beyond:
    """Cut intervals where the drop crosses one of the values."""
    for value in cuts:
        before, after = found.drop_start - value, found.drop_end - value
        crossing = (before < 0) & (after > 0) | (before > 0) & (after < 0)
        if not crossing.any():
            continue
        part = np.divide(before, before - after, out=np.zeros_like(before), where=crossing)
        place = found.start + part * (found.end - found.start)
        first = np.repeat(np.arange(len(crossing)), 1 + crossing)
        second = np.append(False, first[1:] == first[:-1])
        halves = {name: column[first] for name, column in found._asdict().items()}
        cut = crossing[first]
        halves["start"] = np.where(cut & second, place[first], halves["start"])
        halves["end"] = np.where(cut & ~second, place[first], halves["end"])
        halves["drop_start"] = np.where(cut & second, value, halves["drop_start"])
        halves["drop_end"] = np.where(cut & ~second, value, halves["drop_end"])
        found = Beyond(**halves)
    return found


def _classed(found: Beyond, limits: Limits, walker: Walker, engine: Engine) -> UInt8:
    """The kind of each interval, none of which lies across a limit."""
    deepest, least = np.fmax(found.drop_start, found.drop_end), np.fmin(found.drop_start, found.drop_end)
    radius = walker.body.movesize
    seamless = deepest <= limits.reattach
    if engine is Engine.OPENJKDF2:
        # Beyond the hover height only the sphere's sweep takes the lower floor, a radius past the edge; and it holds
        # on to the upper floor and to the far side of a gap that is narrower than two radii.
        caught = (least <= limits.hover) | (found.past <= limits.reattach)
        bridged = (np.abs(found.far) <= limits.hover - radius) | np.isnan(found.past)
        seamless = seamless & caught | bridged
    over = found.over
    rising = least < 0
    reached = np.select(
        [
            np.maximum(np.abs(found.drop_start), np.abs(found.drop_end)) <= LEVEL_WITHIN,
            ~rising & seamless,
            ~rising,
            -least <= limits.clearance,
            -least <= limits.hover,
        ],
        [Kind.LEVEL, Kind.SEAMLESS, Kind.FALL, Kind.STEP, Kind.LIP],
        Kind.JUMP,
    )
    jumped = found.rise > 0
    need = np.fmax(-least, (found.rise - 1) * radius)
    by_jump = np.where(need <= limits.jump, Kind.JUMP, Kind.WALL)
    reached = np.where(reached == Kind.JUMP, by_jump, reached)
    bridging = (engine is Engine.OPENJKDF2) & (np.abs(found.far) <= limits.hover - radius)
    return np.select(
        [over == Over.BLOCKED, (over == Over.FLOOR) & jumped, jumped, over == Over.WATER, over == Over.FLOOR, bridging],
        [Kind.WALL, by_jump, Kind.WALL, Kind.WATER, reached, Kind.SEAMLESS],
        Kind.NONE,
    ).astype(np.uint8)


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
