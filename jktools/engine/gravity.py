"""Gravity, mass, pushing and sector thrust.

Research document, "Mass / Gravity" and "Detecting Detachment"; sithPhysics_ThingPhysGeneral,
_ThingPhysUnderwater, _ThingPhysAttached and _ThingApplyForce in the decompiled engine.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.body import Body
from jktools.engine.bounds import bounded
from jktools.engine.flags import PhysicsFlag, SectorFlag
from jktools.engine.profile import Engine
from jktools.engine.thrust import Support

WORLD_GRAVITY = 4.0
"""JKU/s^2: what the header of every level that we have says ("World Gravity 4.00")."""
HALF_GRAVITY = 0.5
LIFTING_FORCE = 0.5
"""A force whose z gives more than this speed (JKU/s) detaches the body it acts on."""
SLOPE_GRAVITY = (0.2, 0.8)
"""Bounds of the part of gravity, 1 - friction, that an attached player still feels; on a level floor it is
removed again with the component along the normal."""


class Push(NamedTuple):
    """What a force does at once."""

    velocity_change: Float64
    detaches: bool
    skips_drag: bool
    """Whether the next tick on a surface goes without drag (PhysicsFlag.FORCE_APPLIED)."""


def gravity_acceleration(
    body: Body,
    support: Support = Support.AIR,
    *,
    sector: int = 0,
    gravity: float = WORLD_GRAVITY,
    at_water_surface: bool = False,
) -> float:
    """Give the acceleration along z, JKU/s^2, of a body that nothing carries; an attached body has none.

    Mass does not change it (research document, "Gravity": 0.1 and 1000 land together), but a body of mass 0
    or without the gravity flag has none in the air. Under water it is scaled by buoyancy, not by the flags of
    the air, and absent at the surface.
    """
    if support is Support.SURFACE or not body.physflags & PhysicsFlag.GRAVITY:
        return 0.0
    if support is Support.WATER:
        return 0.0 if at_water_surface else -gravity * body.buoyancy
    if body.mass == 0 or sector & SectorFlag.NO_GRAVITY:
        return 0.0
    return -gravity * (HALF_GRAVITY if body.physflags & PhysicsFlag.HALF_GRAVITY else 1.0)


def slope_acceleration(body: Body, friction: float, *, moving: bool, gravity: float = WORLD_GRAVITY) -> float:
    """Give the acceleration along z, JKU/s^2, that pulls an attached player down a slope.

    gravity * clamp(1 - friction, 0.2, 0.8), for players that move or stand on ice; the floor's normal takes its
    share of it afterwards.
    """
    if not (body.player and body.physflags & PhysicsFlag.GRAVITY and (moving or friction < SLOPE_GRAVITY[1])):
        return 0.0
    low, high = SLOPE_GRAVITY
    return -gravity * min(high, max(low, 1 - friction))


def feels_sector_thrust(body: Body, sector: int) -> bool:
    """Say whether a sector's thrust acts on a body: the sector's flag, a mass, and no exemption."""
    exempt = body.mass == 0 or body.physflags & PhysicsFlag.NO_SECTOR_THRUST
    return bool(sector & SectorFlag.THRUST) and not exempt


def sector_acceleration(
    body: Body,
    thrust: npt.ArrayLike,
    support: Support,
    *,
    sector: int = SectorFlag.THRUST,
    normal: npt.ArrayLike = (0.0, 0.0, 1.0),
) -> Float64:
    """Give the acceleration `(3,)`, JKU/s^2, of a sector's thrust `(3,)`.

    An attached body feels none of the part along the floor's unit `normal`: "not accelerated upwards until he
    jumps" (research document, "Detecting Detachment"). Unattached bodies feel all of it at once.
    """
    if not feels_sector_thrust(body, sector):
        return np.zeros(3)
    s, n = bounded(thrust), bounded(normal)
    return s - n * (s @ n) if support is Support.SURFACE else s


def sector_thrust_detaches(
    body: Body, thrust: npt.ArrayLike, *, gravity: float = WORLD_GRAVITY, engine: Engine = Engine.RESEARCH
) -> bool:
    """Say whether an attached body is lifted off: never in `research`; `openjkdf2`: thrust z above gravity * mass."""
    if engine is Engine.RESEARCH or not feels_sector_thrust(body, SectorFlag.THRUST):
        return False
    return bool(bounded(thrust)[..., 2] > bounded(gravity) * bounded(body.mass))


@np.errstate(under="ignore")
def apply_force(body: Body, force: npt.ArrayLike) -> Push:
    """Push a body with a force `(3,)` (mass JKU/s): velocity changes by force / mass, and not at all without mass.

    The heavier, the harder to push (research document, "Gravity"); the quotient and its consequences are
    sithPhysics_ThingApplyForce's.
    """
    vector = bounded(force)
    mass = bounded(body.mass)
    if mass <= 0:
        return Push(np.zeros_like(vector), False, False)
    change = bounded(vector / mass)
    return Push(change, bool(change[..., 2] > LIFTING_FORCE), True)
