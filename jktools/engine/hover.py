"""Insert offset: how high a body hangs over its floor, and how it settles there.

Research document, "Insert Offset"; sithPhysics_ThingGetInsertOffsetZ and sithPhysics_ThingPhysAttached in the
decompiled engine.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.bounds import bounded
from jktools.engine.profile import Engine

LEAST_CLEARANCE = 0.005
"""JKU that the decompiled engine keeps between the collision sphere and the floor."""
CROUCHED_CLEARANCE = 0.01
SETTLING_SPEED = 0.5
"""JKU/s: linear. The document saw "perhaps a quarter of a second" at an insert offset of 0.3, which would be
about 1 JKU/s; it had no clock on it. This is the decompiled engine's, and the default of both profiles."""
CROUCHED_INSERT_OFFSET = 0.0
"""What the document suspects in place of the insert offset while crouching."""


def hover_height(
    insert_offset_z: npt.ArrayLike,
    movesize: npt.ArrayLike,
    *,
    height: npt.ArrayLike = 0.0,
    crouching: bool = False,
    engine: Engine = Engine.RESEARCH,
) -> Float64:
    """Give the height of a resting body's position over its floor, JKU; arguments broadcast.

    `research`: the insert offset, but never lower than the sphere ("sunken in"); crouching, an insert offset
    of 0. `openjkdf2`: at least movesize + 0.005; crouching, movesize + 0.01. A template's `height` replaces
    the standing one.
    """
    insert, radius, own = bounded(insert_offset_z), bounded(movesize), bounded(height)
    if engine is Engine.RESEARCH:
        offset = np.full_like(insert, CROUCHED_INSERT_OFFSET) if crouching else np.where(own != 0, own, insert)
        return np.maximum(offset, radius)
    if crouching:
        return radius + CROUCHED_CLEARANCE + np.zeros_like(insert + own)
    return np.where(own != 0, own, np.maximum(insert, radius + LEAST_CLEARANCE))


def settle(error: npt.ArrayLike, dt: npt.ArrayLike) -> Float64:
    """Give what one tick of `dt` seconds leaves of a height error, JKU, above (+) or below (-) the hover height.

    At most 0.5 JKU/s either way, along z for bodies kept upright and else along the floor's normal.
    """
    e = bounded(error)
    return e - np.clip(e, -SETTLING_SPEED * bounded(dt), SETTLING_SPEED * bounded(dt))


def settling_seconds(error: npt.ArrayLike) -> Float64:
    """Give the time that a height error takes to settle, seconds."""
    return np.abs(bounded(error)) / SETTLING_SPEED


def landing_seconds(
    insert_offset_z: npt.ArrayLike, movesize: npt.ArrayLike, engine: Engine = Engine.RESEARCH
) -> Float64:
    """Give the time from touching the floor with the collision sphere to the full hover height, seconds."""
    return settling_seconds(hover_height(insert_offset_z, movesize, engine=engine) - bounded(movesize))
