"""Dynamic light on level vertices and on models, and how light adds up to brightness.

The research document ("Dynamic Light Attenuation") found one slope for every light, the light value only
setting the start; it has no figure for the slope. The decompiled engine has 0.8 a JKU, and with it the
document's own target (a square whose vertices lie 0.1414 JKU from its centre) gives its tables. Both profiles
therefore agree here. That a light ends at a distance equal to its value, which the document first assumed, is
refuted by its own table: it ends at value / slope.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64

WORLD_FALLOFF = 0.8
"""Light lost per JKU on the vertices of the level (`sithRender_RenderDynamicLights`, decompiled engine)."""

MODEL_FALLOFF = 0.4
"""Light lost per JKU on the vertices of models (`rdLight_CalcVertexIntensities`)."""

MAX_LIGHTS = 32
"""Lights that the engine takes into a frame; further ones do not shine."""


@np.errstate(under="ignore")  # what is too small for a float is 0
def reach(intensity: npt.ArrayLike, falloff: float = WORLD_FALLOFF) -> Float64:
    """Give the distance at which lights end, JKU, (...) as `intensity`; 0 for a light up to 0 or NaN."""
    return np.asarray(np.maximum(np.nan_to_num(np.asarray(intensity, np.float64), nan=0.0), 0.0) / falloff)


@np.errstate(under="ignore")  # what is too small for a float is 0
def light_on_vertices(vertices: npt.ArrayLike, positions: npt.ArrayLike, intensities: npt.ArrayLike) -> Float64:
    """Add up the dynamic light on level vertices: (n,) float64, not yet clamped.

    `vertices` is (n, 3) and `positions` (m, 3), JKU; `intensities` is (m,). Each light gives its value less
    0.8 times the distance, and nothing beyond. A light or a vertex that is NaN gets or gives nothing.
    """
    corners, lights, values = _checked(vertices, positions, intensities)
    total = np.zeros(len(corners))
    for position, value in zip(lights, values, strict=True):
        away = _distance(corners - position)
        total += np.where(away < value / WORLD_FALLOFF, value - WORLD_FALLOFF * away, 0.0)
    return total


@np.errstate(under="ignore")  # what is too small for a float is 0
def light_on_model(
    vertices: npt.ArrayLike, normals: npt.ArrayLike, positions: npt.ArrayLike, intensities: npt.ArrayLike
) -> Float64:
    """Add up the dynamic light on a model's vertices: (n,) float64 in 0..1.

    `vertices` and unit `normals` are (n, 3), `positions` (m, 3), all in one frame, JKU; `intensities` is
    (m,). Each light gives its value less 0.4 times the distance, times the cosine to the normal, from the
    front only.
    """
    corners, lights, values = _checked(vertices, positions, intensities)
    facing = np.asarray(normals, np.float64)
    if facing.shape != corners.shape:
        raise ValueError(f"one normal a vertex: got shapes {facing.shape} and {corners.shape}")
    total = np.zeros(len(corners))
    for position, value in zip(lights, values, strict=True):
        total += _from_front(position - corners, facing, float(value))
    return np.asarray(np.minimum(total, 1.0))


@np.errstate(under="ignore")  # what is too small for a float is 0
def light_on_surfaces(vertex_light: npt.ArrayLike, first: npt.ArrayLike) -> Float64:
    """Give the light at the centre of surfaces, the mean of their vertices: (s,) float64.

    `vertex_light` is (n,), the vertices surface by surface; `first` is (s,), where each surface starts.
    Raises ValueError for a surface without vertices.
    """
    light = np.asarray(vertex_light, np.float64)
    starts = np.asarray(first, np.intp)
    counts = np.diff(starts, append=len(light))
    if (counts <= 0).any() or (starts < 0).any():
        raise ValueError("each surface has at least one vertex")
    return np.asarray(np.add.reduceat(light, starts) / counts if len(starts) else np.zeros(0))


@np.errstate(under="ignore")  # what is too small for a float is 0
def surface_brightness(
    sector_extra: npt.ArrayLike, vertex: npt.ArrayLike, dynamic: npt.ArrayLike, face_extra: npt.ArrayLike
) -> Float64:
    """Give how bright a vertex is drawn, 0..1: its light summed, at least the sector's extra light.

    Arguments are (...) and broadcast. Source: `rdCache_SendFaceListToHardware` in the decompiled engine.
    """
    own = _clamped(np.asarray(vertex, np.float64) + np.asarray(dynamic) + np.asarray(face_extra))
    return np.asarray(np.maximum(own, _clamped(sector_extra)))


@np.errstate(under="ignore")  # what is too small for a float is 0
def thing_brightness(ambient: npt.ArrayLike, extra: npt.ArrayLike) -> Float64:
    """Give the ambient brightness of a thing, 0..1: its sector's ambient and extra light."""
    return _clamped(np.asarray(ambient, np.float64) + np.asarray(extra))


@np.errstate(under="ignore")  # what is too small for a float is 0
def pixel(brightness: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """Give the level 0..255 at which a white texture is drawn: (...) uint8, cut to a whole number."""
    return np.floor(_clamped(brightness) * 255.0).astype(np.uint8)


def _checked(
    vertices: npt.ArrayLike, positions: npt.ArrayLike, intensities: npt.ArrayLike
) -> tuple[Float64, Float64, Float64]:
    corners = np.asarray(vertices, np.float64)
    lights = np.asarray(positions, np.float64).reshape(-1, 3)
    values = np.asarray(intensities, np.float64).reshape(-1)
    if corners.ndim != 2 or corners.shape[1] != 3:
        raise ValueError(f"vertices are (n, 3), got shape {corners.shape}")
    if len(lights) != len(values):
        raise ValueError(f"{len(lights)} light positions, but {len(values)} intensities")
    return corners, lights[:MAX_LIGHTS], values[:MAX_LIGHTS]


def _distance(offsets: Float64) -> Float64:
    # Levels hold float32: the squares fit a float64, and hypot would take five times as long.
    x, y, z = offsets[:, 0], offsets[:, 1], offsets[:, 2]
    return np.asarray(np.sqrt(x * x + y * y + z * z))


def _from_front(towards: Float64, normals: Float64, value: float) -> Float64:
    away = _distance(towards)
    reached = (away > 0.0) & (away < value / MODEL_FALLOFF)
    cosine = np.einsum("ij,ij->i", towards, normals) / np.where(reached, away, 1.0)
    return np.where(reached & (cosine > 0.0), (value - MODEL_FALLOFF * away) * cosine, 0.0)


def _clamped(light: npt.ArrayLike) -> Float64:
    return np.asarray(np.clip(np.nan_to_num(np.asarray(light, np.float64), nan=0.0), 0.0, 1.0))
