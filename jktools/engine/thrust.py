"""Thrust: from keys to the vector that COG reads, and from that vector to a change of velocity.

Research document, "Player Movement" (Text 1) and "Actor Movement"; sithControl_PlayerMovement,
sithControl_FreeCam, sithPhysics_ThingPhys* and sithAI in the decompiled engine.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.body import Body
from jktools.engine.bounds import bounded, length
from jktools.engine.flags import PhysicsFlag, SurfaceFlag
from jktools.engine.profile import Engine

BACKWARD_FACTOR = 0.5
STRAFE_FACTOR = 0.7
RUN_FACTOR = 2.0
SLOW_FACTOR = 0.5
CROUCH_FACTOR = 0.5
UNATTACHED_FACTOR = 0.3
UNDERWATER_FACTOR = 0.6
DEEP_WATER_FACTOR = 0.5
CROUCHED_FRICTION = 0.8
"""What replaces a surface's friction for the thrust of a crouching body in the decompiled engine."""
SWIM_FACTOR = 0.5
"""Part of maxthrust that the jump and crouch keys add along z under water."""

MOST_AI_SPEED = 2.0
"""The greatest factor on maxthrust with which an AI walks or runs; the leap of an attack has 4 (sithAICmd)."""

ACTOR_READABLE_THRUST = 0.0
"""What GetThingThrust tells of an AI actor even while it moves: its steps never pass through the thrust vector."""


class NotStatedError(ValueError):
    """The research document treats the system but its figure is missing or illegible."""


class Support(enum.StrEnum):
    """What carries a body, in the order in which the engine asks (sithPhysics_ThingTick)."""

    SURFACE = "surface"
    WATER = "water"
    AIR = "air"


@dataclass(frozen=True, slots=True)
class Keys:
    """What the player holds. Axes are -1 .. 1: forward positive, strafe positive to the right."""

    forward: float = 0.0
    strafe: float = 0.0
    run: bool = False
    slow: bool = False
    crouch: bool = False
    jump: bool = False


def player_thrust(
    body: Body,
    keys: Keys,
    support: Support = Support.SURFACE,
    surface: int = 0,
    *,
    extra_speed: float = 0.0,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Give the thrust vector that GetThingThrust reads: `(3,)`, JKU/s^2, in the body's look frame (x right, y forward).

    `surface` is the flag word of the surface under an attached body, `extra_speed` what SetActorExtraSpeed
    set. Raises NotStatedError for deep water in `research`: the document's factors are illegible.
    """
    # Axes are kept to single keys' worth; a joystick between gives the part.
    forward, strafe = (min(1.0, max(-1.0, axis)) for axis in (keys.forward, keys.strafe))
    in_air = support is not Support.SURFACE
    base = np.array(
        [
            _axis(body, strafe, STRAFE_FACTOR, extra_speed, engine),
            _axis(body, forward, _forward_factor(forward, in_air, engine), extra_speed, engine),
            0.0,
        ]
    )
    if support is Support.WATER:
        base[2] = (keys.jump - keys.crouch) * SWIM_FACTOR * body.maxthrust
        return base * UNDERWATER_FACTOR
    if support is Support.AIR:
        flying = engine is Engine.OPENJKDF2 and body.physflags & PhysicsFlag.FLIES
        return base if flying else base * UNATTACHED_FACTOR
    return base * gait_factor(keys) * surface_thrust_factor(surface, engine)


def _forward_factor(forward: float, in_air: bool, engine: Engine) -> float:
    # The document's table halves a step back wherever it is made; the engine only on a surface.
    halved = forward < 0 and not (in_air and engine is Engine.OPENJKDF2)
    return BACKWARD_FACTOR if halved else 1.0


def _axis(body: Body, axis: float, factor: float, extra_speed: float, engine: Engine) -> float:
    if engine is Engine.OPENJKDF2:
        return (body.maxthrust + extra_speed) * factor * axis
    return (body.maxthrust * factor + extra_speed) * axis


def gait_factor(keys: Keys) -> float:
    """Give the factor of crouching (which hides run and slow), running and the slow key; 1 for a walk.

    Text 1: crouching cuts by 50 %, run doubles but not while crouching. The slow key is in the engine only.
    """
    if keys.crouch:
        return CROUCH_FACTOR
    return (RUN_FACTOR if keys.run else 1.0) * (SLOW_FACTOR if keys.slow else 1.0)


def surface_thrust_factor(surface: int, engine: Engine = Engine.RESEARCH) -> float:
    """Give the factor of a surface's flags on the thrust vector: water only; ice acts on drag.

    Shallow water is 1 (Text 1). Raises NotStatedError for deep water in `research`.
    """
    if not surface & (SurfaceFlag.DEEP_WATER | SurfaceFlag.VERY_DEEP_WATER):
        return 1.0
    if engine is Engine.RESEARCH:
        raise NotStatedError("the research document's factors for deep water are illegible: use engine openjkdf2")
    return DEEP_WATER_FACTOR


def thrust_acceleration(
    thrust: npt.ArrayLike,
    orientation: npt.ArrayLike | None = None,
    *,
    friction: float = 1.0,
    crouching: bool = False,
    attached: bool = True,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Turn a thrust vector into acceleration in the world, JKU/s^2: `(..., 3)` through `(3, 3)` look matrices.

    In `openjkdf2` an attached body's thrust is scaled by the surface's friction (see `drag.friction`), or by
    0.8 while it crouches: ice halts feet although the thrust vector does not show it
    (sithPhysics_ThingPhysAttached).
    """
    vector = bounded(thrust)
    if orientation is not None:
        vector = (bounded(orientation) @ vector[..., None])[..., 0]
    if engine is Engine.RESEARCH or not attached:
        return vector
    return vector * (CROUCHED_FRICTION if crouching else friction)


def capped(acceleration: npt.ArrayLike, maxvel: npt.ArrayLike, dt: npt.ArrayLike) -> Float64:
    """Cap thrust `(..., 3)`, JKU/s^2, so that one tick of `dt` seconds adds at most `maxvel` (JKU/s) to a velocity.

    The decompiled engine does so for attached bodies (sithPhysics_ThingPhysAttached): a body of maxvel 0 does not
    move by its own thrust there.
    """
    a = bounded(acceleration)
    added, most = length(a) * bounded(dt), bounded(maxvel)
    part = np.divide(most, added, out=np.ones(np.broadcast_shapes(most.shape, added.shape)), where=added > most)
    return a * part[..., None]


def actor_acceleration(
    body: Body,
    direction: npt.ArrayLike,
    *,
    move_speed: float = 1.0,
    three_dimensional: bool = False,
) -> Float64:
    """Give an AI actor's acceleration towards `direction`, `(3,)` in the world, whichever way it looks.

    sithAI adds direction * maxthrust * move_speed * dt to the velocity, along z only for flyers and swimmers
    (`three_dimensional`): the document's hypothesis (a), "applied directly". No penalty backwards or
    sideways.
    """
    vector = bounded(direction).copy()
    if not three_dimensional:
        vector[..., 2] = 0.0
    size = length(vector)[..., None]
    unit = np.divide(vector, size, out=np.zeros_like(vector), where=size != 0)
    return unit * bounded(body.maxthrust * move_speed)
