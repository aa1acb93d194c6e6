"""What an AI sees: range, field of view, water, and what stands between.

Source: `sithAI_CheckSightThing` in the decompiled engine. The research document names AI sight ("Sight") and
measured none of it, so both profiles take these rules.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Bool, Float64
from jktools.engine.sight import ThingType

DEFAULT_FOV = 0.0
"""Of an AI file that has none: the front half."""
DEFAULT_SIGHT_RANGE = 20.0
"""JKU, of an AI file that has no sightdist."""
EVERY_DIRECTION = -1.0


class Verdict(enum.IntEnum):
    """Number the answers as the engine does."""

    SEEN = 0
    TOO_FAR = 1
    OUT_OF_VIEW = 2
    HIDDEN = 3


@dataclass(frozen=True, slots=True)
class Look:
    """Hold who looks at what: n pairs."""

    eye: npt.ArrayLike
    """(n, 3) JKU: where the shot would leave, or the position."""
    right: npt.ArrayLike
    """(n, 3) the looker's right vector."""
    forward: npt.ArrayLike
    """(n, 3) the looker's look vector."""
    target: npt.ArrayLike
    """(n, 3) JKU."""
    target_size: npt.ArrayLike
    """(n,) collide radius, JKU."""
    looker_in_water: npt.ArrayLike = False
    target_in_water: npt.ArrayLike = False
    target_on_water: npt.ArrayLike = False
    """The target moves by physics and floats on the surface (physics flag 0x100000)."""


@np.errstate(under="ignore")  # what is too small for a float is 0
def verdicts(look: Look, fov: float = DEFAULT_FOV, sight_range: float = DEFAULT_SIGHT_RANGE) -> npt.NDArray[np.int8]:
    """Judge each pair as if nothing stood between: (n,) int8 of `Verdict`: water first, then range, view.

    `fov` and `sight_range` (JKU) come from the AI file. NaN distances are in range and in view, as they
    compare in the engine.
    """
    offset = np.asarray(look.target, np.float64) - np.asarray(look.eye, np.float64)
    away = np.hypot(np.hypot(offset[:, 0], offset[:, 1]), offset[:, 2])
    direction = offset / np.where(away > 0.0, away, 1.0)[:, None]
    right = np.einsum("ij,ij->i", direction, np.asarray(look.right, np.float64))
    forward = np.einsum("ij,ij->i", direction, np.asarray(look.forward, np.float64))
    order = [
        water_hides(look),
        too_far(away, look.target_size, sight_range),
        out_of_view(right, forward, fov),
    ]
    answers = [Verdict.HIDDEN, Verdict.TOO_FAR, Verdict.OUT_OF_VIEW]
    return np.select(order, answers, Verdict.SEEN).astype(np.int8)


def too_far(distance: npt.ArrayLike, target_size: npt.ArrayLike, sight_range: float) -> Bool:
    """Tell which targets are out of range: (n,) bool.

    The engine takes the target's radius off twice, the first time not below 0: a target of radius r is seen
    from `sight_range` + 2 r.
    """
    size = np.asarray(target_size, np.float64)
    return np.asarray(np.maximum(np.asarray(distance, np.float64) - size, 0.0) - size > sight_range)


def out_of_view(right: npt.ArrayLike, forward: npt.ArrayLike, fov: float = DEFAULT_FOV) -> Bool:
    """Tell which directions lie outside the field of view: (n,) bool.

    `right` and `forward` are the direction's components along the looker's axes. A fov from 0 to 1 sees the
    front where the side component is at most 1 - fov: 0 is the front half, 1 straight ahead only. Below 0,
    down to -1, it sees the front and, behind, where the side component is at least fov + 1; at -1 and below
    it sees everywhere. What is far above or below has little side component, so it is easily seen.
    """
    side, ahead = np.abs(np.asarray(right, np.float64)), np.asarray(forward, np.float64)
    if fov >= 0.0:
        return np.asarray((ahead < 0.0) | (side > 1.0 - fov))
    if fov > EVERY_DIRECTION:
        return np.asarray((ahead < 0.0) & (side < fov + 1.0))
    return np.zeros(np.broadcast_shapes(side.shape, ahead.shape), np.bool_)


def water_hides(look: Look) -> Bool:
    """Tell which pairs the water surface parts; from above a target that floats on it is seen."""
    looker = np.asarray(look.looker_in_water, np.bool_)
    target = np.asarray(look.target_in_water, np.bool_)
    floats = np.asarray(look.target_on_water, np.bool_)
    hidden = (looker & ~target) | (~looker & target & ~floats)
    return np.broadcast_to(hidden, np.asarray(look.target).shape[:1])


def thing_hides(kind: ThingType) -> bool:
    """Tell whether a solid thing between hides the target from an AI: actors and cogs do, players do not."""
    return kind in (ThingType.ACTOR, ThingType.COG)


@np.errstate(under="ignore")  # what is too small for a float is 0
def distance_to_target(look: Look) -> Float64:
    """Give the distance that the AI then knows, JKU, (n,): to the target's rim, not below 0."""
    offset = np.asarray(look.target, np.float64) - np.asarray(look.eye, np.float64)
    away = np.hypot(np.hypot(offset[:, 0], offset[:, 1]), offset[:, 2])
    return np.asarray(np.maximum(away - np.asarray(look.target_size, np.float64), 0.0))
