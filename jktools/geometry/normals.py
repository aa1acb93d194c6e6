"""How the normals that a level writes fit the polygons they belong to."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.corners import Corners, Float64
from jktools.model import Level


class NormalFit(NamedTuple):
    """One entry a surface, NaN where its normal is missing or not finite.

    `length` is that of the written normal; `angle` is between it and the polygon's (degrees; 0 where the polygon has
    no area or the normal no length); `distance` is the farthest that a corner lies off the plane through the first
    corner that the written direction gives (JKU): the plane that the engine collides with.
    """

    length: Float64
    angle: Float64
    distance: Float64


def normal_fit(level: Level, corners: Corners) -> NormalFit:
    """Measure every written normal."""
    written = written_normals(level)
    length = np.linalg.norm(written, axis=1)
    unit = np.divide(written, length[:, None], out=np.zeros_like(written), where=length[:, None] > 0)
    drawn = corners.normal
    measured = (length > 0) & (drawn != 0).any(axis=1)
    # atan2 keeps small angles that arccos rounds away.
    angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(unit, drawn), axis=1), (unit * drawn).sum(axis=1)))
    off = np.abs(((corners.position - corners.position[corners.first]) * unit[corners.surface]).sum(axis=1))
    distance = np.zeros(len(written))
    np.maximum.at(distance, corners.surface, off)
    return NormalFit(length, np.where(measured, angle, 0.0), np.where(length > 0, distance, 0.0))


def written_normals(level: Level) -> Float64:
    """(surfaces, 3) normals as written; NaN where one is missing or not finite."""
    count = len(level.surfaces)
    written = np.full((count, 3), np.nan)
    rows = min(count, len(level.document.normals))
    written[:rows] = level.document.normals.direction[:rows]
    written[~np.isfinite(written).all(axis=1)] = np.nan
    return written
