"""Drag: the part of a body's speed that surfaces, air and water take, and the threshold that stops it.

Research document, "Drag Coefficients", "Static Drag", "Dynamic Drag"; sithPhysics_ApplyDrag and
sithPhysics_ThingPhysAttached in the decompiled engine.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.body import Body
from jktools.engine.bounds import bounded, length
from jktools.engine.flags import SurfaceFlag
from jktools.engine.profile import Engine
from jktools.engine.thrust import Support

ICY_FRICTION = 0.3
VERY_ICY_FRICTION = 0.1
LEAST_FRICTION = 0.25
"""The engine raises a lower friction to this before it acts on drag and thrust, so very icy is 0.25 there."""
STATIC_FRICTION = 0.8
"""Static drag needs more friction than this: it is off on every kind of ice."""
UNDERWATER_DRAG_FACTOR = 4.0

REST_SPEED = {Engine.RESEARCH: 1e-3, Engine.OPENJKDF2: 1e-5}
"""JKU/s below which drag leaves nothing. `openjkdf2`: a constant, for each component (rdMath_ClampVector).
`research`: inferred from Table 12, whose four times all fit 1e-3; open whether the game or the log rounds
there.
"""


class Coefficients(NamedTuple):
    """What acts on a body in one tick."""

    drag: float
    """1/s, of the velocity."""
    static: float
    """Speed at which the body stops dead, JKU/s; 0 for none."""


def friction(surface: int, *, turning: bool = False) -> float:
    """Give a surface's friction in `openjkdf2`: 1, icy 0.3, very icy 0.25 (0.1 where only `turning` reads it)."""
    if surface & SurfaceFlag.VERY_ICY:
        return VERY_ICY_FRICTION if turning else LEAST_FRICTION
    return ICY_FRICTION if surface & SurfaceFlag.ICY else 1.0


def coefficients(
    body: Body,
    support: Support,
    surface: int = 0,
    *,
    thrusting: bool = False,
    sector_thrust: bool = False,
    force_applied: bool = False,
    engine: Engine = Engine.RESEARCH,
) -> Coefficients:
    """Choose the drag and the static threshold that act on a body this tick.

    | support | drag | static threshold |
    |---|---|---|
    | surface | surfdrag (`openjkdf2`: times friction) | staticdrag, without acceleration and off ice |
    | air | airdrag | none |
    | water | 4 airdrag | none |

    Acceleration is own thrust or a sector's. A tick in which a force was applied (PhysicsFlag.FORCE_APPLIED)
    has no drag on a surface, and without surfdrag the engine never looks at staticdrag. On ice the document
    saw what staticdrag 0 looks like ("No staticdrag") and measured no more: `research` leaves surfdrag as it
    is there.
    """
    if support is Support.AIR:
        return Coefficients(body.airdrag, 0.0)
    if support is Support.WATER:
        return Coefficients(UNDERWATER_DRAG_FACTOR * body.airdrag, 0.0)
    if force_applied:
        return Coefficients(0.0, 0.0)
    grip = friction(surface)
    stopped = not thrusting and not sector_thrust and grip > STATIC_FRICTION
    static = body.staticdrag if stopped else 0.0
    if engine is Engine.RESEARCH:
        return Coefficients(body.surfdrag, static)
    return Coefficients(body.surfdrag * grip, static * grip if body.surfdrag else 0.0)


def stops(velocity: npt.ArrayLike, static: npt.ArrayLike, engine: Engine = Engine.RESEARCH) -> npt.NDArray[np.bool_]:
    """Say which bodies, `(..., 3)`, stop at once: speed at or below the threshold (`openjkdf2`: strictly below)."""
    speed, static = length(velocity), bounded(static)
    below = speed <= static if engine is Engine.RESEARCH else speed < static
    return np.asarray(below & (static != 0))


def rest(velocity: npt.ArrayLike, engine: Engine = Engine.RESEARCH) -> Float64:
    """Set what is too slow to count to 0: the whole velocity `(..., 3)`, or in `openjkdf2` each component."""
    v = bounded(velocity)
    slow = np.abs(v) if engine is Engine.OPENJKDF2 else length(v)[..., None]
    return np.where(slow < REST_SPEED[engine], 0.0, v)


@np.errstate(under="ignore")
def apply_drag(
    velocity: npt.ArrayLike,
    drag: npt.ArrayLike,
    static: npt.ArrayLike,
    dt: npt.ArrayLike,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Take one tick's drag off velocities `(..., 3)`; `drag` (1/s), `static` (JKU/s) and `dt` (s) are `(...)`.

    `research`: v - v drag dt, as Tables 13 and 14 have it, which reverses and beyond dt x drag = 2 blows up.
    `openjkdf2`: the same with drag dt clamped to 1, so that the worst is a full stop.
    """
    v = bounded(velocity)
    fraction = bounded(drag) * bounded(dt)
    if engine is Engine.OPENJKDF2:
        fraction = np.minimum(fraction, 1.0)
    fraction = fraction[..., None]
    slowed = np.where(fraction == 0, v, rest(v - v * fraction, engine))
    return np.where(stops(v, static, engine)[..., None], 0.0, slowed)


def decay_frames(
    drag: npt.ArrayLike,
    dt: npt.ArrayLike,
    *,
    speed: npt.ArrayLike = 1.0,
    rest_speed: npt.ArrayLike | None = None,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Count the ticks in which drag alone brings `speed` below `rest_speed`, with no static threshold.

    `rest_speed` defaults to `REST_SPEED[engine]`. Infinite without drag, 1 where dt x drag reaches 1 and NaN
    beyond it in `research`, whose Euler step overshoots there.
    """
    fraction = np.asarray(bounded(drag) * bounded(dt))
    goal = bounded(REST_SPEED[engine] if rest_speed is None else rest_speed) / bounded(speed)
    inside = (fraction > 0) & (fraction < 1)
    frames = np.ceil(np.log(goal) / np.log1p(-np.where(inside, fraction, 0.5)))
    beyond = 1.0 if engine is Engine.OPENJKDF2 else np.where(fraction == 1, 1.0, np.nan)
    return np.where(inside, frames, np.where(fraction == 0, np.inf, beyond))
