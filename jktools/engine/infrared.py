"""IR mode: what the IR goggles and Force Seeing do to light."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64
from jktools.engine.profile import Engine


def surface_light(world: float, face_extra: npt.ArrayLike, engine: Engine = Engine.RESEARCH) -> Float64:
    """Give the light of surfaces while EnableIRMode(`world`, ...) is on: (...) in 0..1.

    Research document, "IR Mode": the level renders as fully lit. `sithRender_EnableIRMode` and the surface
    loop in the decompiled engine: evenly at `world` (clamped to 0..1), or at the face's own extra light where
    that is more. `face_extra` is (...); NaN counts as 0.
    """
    extra = clamped(face_extra)
    if engine is Engine.RESEARCH:
        return np.ones_like(extra)
    return np.maximum(clamped(world), extra)


def thing_ambient(thing: float, engine: Engine = Engine.RESEARCH) -> float:
    """Give the ambient light of things while EnableIRMode(..., `thing`) is on.

    Research: fully lit; decompiled engine: the second argument, clamped to 0..1. The game's scripts pass 1.
    """
    return 1.0 if engine is Engine.RESEARCH else float(clamped(thing))


def clamped(light: npt.ArrayLike) -> Float64:
    """Clamp light to 0..1; NaN counts as 0."""
    return np.asarray(np.clip(np.nan_to_num(np.asarray(light, np.float64), nan=0.0), 0.0, 1.0))
