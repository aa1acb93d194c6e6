"""Reattachment: how deep a step down a body takes without falling, how high a step up, and stairs.

Research document, "Descending From Height"; sithPhysics_FindFloor in the decompiled engine.
"""

from __future__ import annotations

import enum
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.bounds import LIMIT, bounded
from jktools.engine.hover import CROUCHED_INSERT_OFFSET, LEAST_CLEARANCE, SETTLING_SPEED, hover_height
from jktools.engine.profile import Engine


class Rise(enum.IntEnum):
    """What a step up is to a walking body."""

    STEP = 0
    """The sphere passes over it."""
    LIP = 1
    """The sphere meets its edge from above the edge: it slides up, if it is fast enough."""
    WALL = 2


class Flight(NamedTuple):
    """How a body goes down a flight of stairs: for each step `(n,)`."""

    lag: Float64
    """Height over the hover height on leaving the step's edge, before its drop, JKU."""
    seamless: npt.NDArray[np.bool_]


def reattach_distance(
    insert_offset_z: npt.ArrayLike,
    movesize: npt.ArrayLike,
    *,
    height: npt.ArrayLike = 0.0,
    crouching: bool = False,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Give the deepest drop, JKU from floor to floor, that a settled body takes without detaching.

    `research`: max(radius, insert offset) + radius; crouching, with the insert offset 0 that it suspects.
    `openjkdf2`: the search is a ray, then a sphere, of twice the standing hover height H from the position,
    so the limit is 2 H + radius - (present height): H + radius standing, 2 H - 0.01 crouching.
    """
    insert, radius = bounded(insert_offset_z), bounded(movesize)
    if engine is Engine.RESEARCH:
        offset = np.full_like(insert, CROUCHED_INSERT_OFFSET) if crouching else insert
        return np.maximum(radius, offset) + radius
    standing = hover_height(insert, radius, height=height, engine=engine)
    present = hover_height(insert, radius, height=height, crouching=crouching, engine=engine)
    return 2 * standing - present + radius


def search_distance(
    insert_offset_z: npt.ArrayLike,
    movesize: npt.ArrayLike,
    *,
    height: npt.ArrayLike = 0.0,
    attached: bool = True,
    sticks: bool = True,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Give how far below its position, JKU, a body looks for a floor.

    `research`: the reattach distance from the feet of a resting body. The document adds the insert offset
    instead, which is the same from movesize up; below it that would give 0.075 where 0.13 was measured.
    `openjkdf2`: 2 H attached with floor or wall stick (`sticks`), 1.1 H attached without.
    Unattached, in both: movesize + 0.005, the sphere's touch.
    """
    insert, radius = bounded(insert_offset_z), bounded(movesize)
    if not attached:
        return radius + LEAST_CLEARANCE
    hover = hover_height(insert, radius, height=height, engine=engine)
    if engine is Engine.RESEARCH:
        return reattach_distance(insert, radius) + hover
    return (2.0 if sticks else 1.1) * hover


def taken_at_edge(
    drop: npt.ArrayLike,
    insert_offset_z: npt.ArrayLike,
    movesize: npt.ArrayLike,
    *,
    height: npt.ArrayLike = 0.0,
) -> npt.NDArray[np.bool_]:
    """Say whether the lower floor is taken as soon as the position passes the edge: drop at most H (`openjkdf2`).

    A deeper one, up to the reattach distance, is taken by the sphere's sweep once the position is movesize
    past the edge; so a gap narrower than two movesizes goes unnoticed.
    """
    hover = hover_height(insert_offset_z, movesize, height=height, engine=Engine.OPENJKDF2)
    return np.asarray(bounded(drop) <= hover)


def step_up(
    rise: npt.ArrayLike,
    insert_offset_z: npt.ArrayLike,
    movesize: npt.ArrayLike,
    *,
    height: npt.ArrayLike = 0.0,
    engine: Engine = Engine.RESEARCH,
) -> npt.NDArray[np.int8]:
    """Class steps up (`Rise`): up to H - movesize free, up to H a lip, above that a wall; H the hover height.

    "The increased height allowed the player to seamlessly walk onto other surfaces that normally would have
    required jumping" (research document, "Insert Offset").
    """
    hover = hover_height(insert_offset_z, movesize, height=height, engine=engine)
    r = bounded(rise)
    return np.where(r <= hover - bounded(movesize), Rise.STEP, np.where(r <= hover, Rise.LIP, Rise.WALL)).astype(
        np.int8
    )


def walk_down(
    drops: npt.ArrayLike,
    treads: npt.ArrayLike,
    speed: float,
    limit: float,
    *,
    edge_limit: float = math.inf,
    overhang: float = 0.0,
) -> Flight:
    """Follow a body down a flight at `speed` JKU/s: `drops` `(n,)` JKU, each before its tread `(n,)` JKU.

    The body sinks at 0.5 JKU/s, so on stairs steeper than that it lags behind: lag' = max(0, lag + drop -
    0.5 tread / speed), and a step is seamless while lag + drop is within `limit`, the reattach distance.
    After the first that is not, the body falls, and the rest are not seamless.

    In `openjkdf2` a step beyond `edge_limit`, the hover height, is judged only `overhang`, the movesize, past
    its edge; until there the body sinks towards the old tread and gains 0.5 overhang / speed. (A lag above the
    hover height lets go up to 0.005 JKU earlier, which this leaves out.)
    """
    drop, tread = np.broadcast_arrays(bounded(drops), bounded(treads))
    sinking = SETTLING_SPEED / max(speed, 1 / LIMIT)
    lags, seamless, lag = np.empty(len(drop)), np.empty(len(drop), np.bool_), 0.0
    for i, (d, t) in enumerate(zip(drop.tolist(), tread.tolist(), strict=True)):
        late = overhang if lag + d > edge_limit else 0.0
        kept = max(0.0, lag - sinking * late)
        lags[i], seamless[i] = lag, kept + d <= limit
        lag = max(0.0, kept + d - sinking * max(0.0, t - late))
    return Flight(lags, np.logical_and.accumulate(seamless))
