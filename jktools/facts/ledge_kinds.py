"""What an interval of an edge is to a body, by each engine profile."""

from __future__ import annotations

import enum
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.profile import Engine
from jktools.facts.bodies import Walker
from jktools.facts.intervals import cut_through, take
from jktools.geometry.ledges import Beyond, Over

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

LEVEL_WITHIN = 1e-4
"""JKU: floors this close in height are one level; seams of real levels differ by 1e-6."""


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
    """Up, and the sphere meets its edge and slides up, at full speed."""
    JUMP = 7
    """Up or over, by a jump."""
    WALL = 8
    UNKNOWN = 9
    """A thing that bodies can stand on may be there or not; a lip that a body slides up on some days only; or what it
    comes to by letting go where no gravity takes it down."""


DOWN = (Kind.SEAMLESS, Kind.FALL)
WALKED = (Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.LIP)
"""Kinds that a body passes without a jump and without letting go."""


_IN_THE_AIR = np.array([Kind.FALL, Kind.WATER, Kind.NONE, Kind.JUMP, Kind.WALL], np.uint8)
"""Kinds that begin with letting go: a body that then floats may come anywhere."""


class Limits(NamedTuple):
    """What decides about a drop or a rise, JKU, in one profile."""

    hover: float
    reattach: float
    clearance: float
    lip: float
    jump: float

    @classmethod
    def of(cls, walker: Walker, engine: Engine, *, lips: bool = True) -> Limits:
        """Those of a body; without `lips`, which are simulated, it takes none."""
        hover, clearance = walker.hover(engine), walker.clearance(engine)
        lip = walker.lip(engine) if lips else clearance
        return cls(hover, walker.reattach(engine), clearance, lip, walker.apex() + clearance)


class Judged(NamedTuple):
    """Intervals with what they are to a body, (n,) each, in the order of edges and along them."""

    found: Beyond
    kind: UInt8
    other: UInt8
    """By the other profile."""
    narrow: Bool
    """The place below is narrower than the body."""
    thing: Int32
    """Index of a thing that leaves the kind open, -1 for none."""
    other_thing: Int32
    """The same for the other profile."""

    def part(self, rows: npt.NDArray[np.bool_] | npt.NDArray[np.intp]) -> Judged:
        """Give some of the intervals."""
        return Judged._make((take(self.found, rows), *(column[rows] for column in self[1:])))

    def of_pieces(self, pieces: Beyond, rows: npt.NDArray[np.intp]) -> Judged:
        """Give pieces of the intervals, each with its row."""
        return self.part(rows)._replace(found=pieces)


def joined(parts: list[Judged]) -> Judged:
    """Put intervals of different edges together."""
    found = Beyond._make(np.concatenate(columns) for columns in zip(*(part.found for part in parts), strict=True))
    rest = (np.concatenate(columns) for columns in zip(*(part[1:] for part in parts), strict=True))
    order = np.lexsort((found.start, found.edge))
    return Judged._make((found, *rest)).part(order)


def judge(found: Beyond, walker: Walker, engine: Engine) -> Judged:
    """Say what intervals are to a body, cut where that changes."""
    radius = walker.body.movesize
    limits = {each: Limits.of(walker, each, lips=_may_be_lip(found, walker, each)) for each in Engine}
    far = limits[Engine.OPENJKDF2].hover - radius
    reattach = [each.reattach for each in limits.values()]
    heights = sorted({0.0} | {cut for each in limits.values() for cut in _cuts(each)})
    found = cut_through(found, ("drop_start", "drop_end"), heights)
    found = cut_through(found, ("past_start", "past_end"), sorted(set(reattach)))
    found = cut_through(found, ("far_start", "far_end"), sorted({far, -far, *reattach}))
    kinds = {each: _classed(found, limits[each], radius, each) for each in Engine}
    if not walker.comes_down:
        kinds = {each: np.where(np.isin(kind, _IN_THE_AIR), Kind.UNKNOWN, kind) for each, kind in kinds.items()}
    (other,) = set(Engine) - {engine}
    shallow = _middle(found.drop_start, found.drop_end) <= limits[engine].reattach
    down = np.isin(kinds[engine], (Kind.FALL, Kind.NONE, Kind.WATER)) | (kinds[engine] == Kind.SEAMLESS) & ~shallow
    nearest = np.fmin(_middle(found.past_start, found.past_end), _middle(found.far_start, found.far_end))
    narrow = down & ~(nearest > limits[engine].reattach)
    nothing = np.full(len(found.edge), -1, np.int32)
    return Judged(found, kinds[engine], kinds[other], narrow, nothing, nothing.copy())


def _cuts(limits: Limits) -> tuple[float, ...]:
    found = (limits.hover, limits.reattach, -limits.clearance, -limits.lip, -limits.hover, -limits.jump)
    return tuple(each for each in found if math.isfinite(each))


def _may_be_lip(found: Beyond, walker: Walker, engine: Engine) -> bool:
    least, most = np.fmin(found.drop_start, found.drop_end), np.fmax(found.drop_start, found.drop_end)
    return bool(((least < -walker.clearance(engine)) & (most > -walker.hover(engine))).any())


def _middle(start: Float64, end: Float64) -> Float64:
    """The value in the middle of intervals, none of which lies across a limit."""
    return np.where(start == end, start, (start + end) / 2)


def _classed(found: Beyond, limits: Limits, radius: float, engine: Engine) -> UInt8:
    """The kind of each interval, none of which lies across a limit."""
    drop = _middle(found.drop_start, found.drop_end)
    far = np.abs(_middle(found.far_start, found.far_end)) <= limits.hover - radius
    seamless = drop <= limits.reattach
    if engine is Engine.OPENJKDF2:
        # Beyond the hover height only the sphere's sweep takes the lower floor, a radius past the edge; and it holds
        # on to the upper floor and to the far side of a gap that is narrower than two radii.
        past = _middle(found.past_start, found.past_end)
        seamless = seamless & ((drop <= limits.hover) | (past <= limits.reattach)) | far | np.isnan(past)
    over = found.over
    rising = drop < 0
    reached = np.select(
        [
            np.maximum(np.abs(found.drop_start), np.abs(found.drop_end)) <= LEVEL_WITHIN,
            ~rising & seamless,
            ~rising,
            -drop <= limits.clearance,
            -drop <= limits.lip,
            (-drop > limits.jump) & (-drop <= limits.hover),
        ],
        [Kind.LEVEL, Kind.SEAMLESS, Kind.FALL, Kind.STEP, Kind.LIP, Kind.UNKNOWN],
        Kind.JUMP,
    )
    jumped = found.rise > 0
    need = np.fmax(-drop, (found.rise - 1) * radius)
    by_jump = np.where(need <= limits.jump, Kind.JUMP, Kind.WALL)
    reached = np.where(reached == Kind.JUMP, by_jump, reached)
    bridging = (engine is Engine.OPENJKDF2) & far
    return np.select(
        [over == Over.BLOCKED, (over == Over.FLOOR) & jumped, jumped, over == Over.WATER, over == Over.FLOOR, bridging],
        [Kind.WALL, by_jump, Kind.WALL, Kind.WATER, reached, Kind.SEAMLESS],
        Kind.NONE,
    ).astype(np.uint8)
