"""Orientation: pitch, yaw and roll, the look matrix, and how the two meet when a thing is made.

x right, y forward, z up, right-handed; degrees; the columns of a matrix are the thing's right, look and up
vectors. Research document, "Orientation"; rdMatrix_BuildRotate34 and sithThing_Create* in the decompiled
engine.
"""

from __future__ import annotations

import enum

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.bounds import bounded
from jktools.engine.degrees import sine_cosine

GIMBAL_COSINE = 1e-8
"""Cosine of pitch below which yaw and roll count as turning about one axis. Taking them for one costs this
much in the rebuilt matrix, telling them apart the matrix's own rounding (1e-16) over it: 1e-8 is where the
two meet.
"""


class Creation(enum.StrEnum):
    """The ways a thing comes into a level."""

    PLACED = "placed"
    CREATE_THING = "CreateThing"
    CREATE_THING_NR = "CreateThingNR"


def matrix(angles: npt.ArrayLike) -> Float64:
    """Build look matrices from pitch, yaw, roll: `(..., 3) -> (..., 3, 3)`; Rz(yaw) Rx(pitch) Ry(roll).

    Roll acts first, then pitch, then yaw (rdMatrix_BuildRotate34). Multiples of 90 degrees are
    exact, and the bits are the same on every machine.
    """
    pitch, yaw, roll = np.moveaxis(bounded(angles), -1, 0)
    (sp, cp), (sy, cy), (sr, cr) = map(sine_cosine, (pitch, yaw, roll))
    right = (cr * cy - sr * sy * sp, cr * sy + sr * cy * sp, -sr * cp)
    look = (-sy * cp, cy * cp, sp)
    up = (sr * cy + cr * sy * sp, sr * sy - cr * cy * sp, cr * cp)
    return np.stack([np.stack(column, axis=-1) for column in (right, look, up)], axis=-1)


def angles(matrices: npt.ArrayLike) -> Float64:
    """Read pitch, yaw, roll off look matrices: `(..., 3, 3) -> (..., 3)`, degrees in -180 .. 180, pitch -90 .. 90.

    Looking straight up or down, where only yaw -+ roll can be known (gimbal lock), roll is 0 and yaw has all
    of it.
    """
    m = bounded(matrices)
    sp = np.clip(m[..., 2, 1], -1.0, 1.0)
    cp = np.hypot(m[..., 0, 1], m[..., 1, 1])
    locked = cp < GIMBAL_COSINE
    yaw = np.where(locked, np.arctan2(m[..., 1, 0], m[..., 0, 0]), np.arctan2(-m[..., 0, 1], m[..., 1, 1]))
    roll = np.where(locked, 0.0, np.arctan2(-m[..., 2, 0], m[..., 2, 2]))
    read: Float64 = np.rad2deg(np.stack([np.arctan2(sp, cp), yaw, roll], axis=-1))
    return read


def created(
    how: Creation,
    template: npt.ArrayLike = (0.0, 0.0, 0.0),
    *,
    placed: npt.ArrayLike = (0.0, 0.0, 0.0),
    spawner: npt.ArrayLike | None = None,
) -> Float64:
    """Give the look matrix of a new thing: `(..., 3, 3)`.

    `template` is its template's `orient`, `placed` the angles of its line in the JKL, both `(..., 3)`
    degrees; `spawner` the look matrix of the thing it is created at. A placed thing ignores its template's
    `orient`; a created one combines its spawner's orientation with it (research document, "orient template
    property"), and CreateThingNR does as CreateThing does ("CreateThing vs CreateThingNR").
    """
    if how is Creation.PLACED:
        return matrix(placed)
    own = matrix(template)
    return own if spawner is None else bounded(spawner) @ own


def created_velocity(velocity: npt.ArrayLike, look: npt.ArrayLike, *, rotate: bool = True) -> Float64:
    """Give a created thing's first velocity: its template's `vel` in its own frame, unless physics flag 0x20000."""
    v = bounded(velocity)
    return (bounded(look) @ v[..., None])[..., 0] if rotate else v


def spin(look: npt.ArrayLike, angular_velocity: npt.ArrayLike, dt: npt.ArrayLike) -> Float64:
    """Turn look matrices `(..., 3, 3)` by one tick of `angvel`, `(..., 3)` degrees/s of pitch, yaw, roll.

    The axes are the thing's own, however it lies (research document, "Order of Operations"): M' = M R(angvel
    dt).
    """
    return bounded(look) @ matrix(bounded(angular_velocity) * bounded(dt)[..., None])


def renormalised(look: npt.ArrayLike) -> Float64:
    """Take the drift out of look matrices `(..., 3, 3)`: look keeps its direction, right and up are squared to it.

    The engine does so every eighth tick.
    """
    m = bounded(look)
    forward = _unit(m[..., :, 1])
    right = _unit(np.cross(forward, m[..., :, 2]))
    return np.stack([right, forward, np.cross(right, forward)], axis=-1)


def _unit(vectors: Float64) -> Float64:
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    unit: Float64 = np.divide(vectors, size, out=np.zeros_like(vectors), where=size != 0)
    return unit
