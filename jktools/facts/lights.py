"""The light that still things throw on the level's vertices, as the engine's dynamic light would.

A light reaches every vertex within its intensity / 0.8 JKU, whatever stands between (sithRender_RenderDynamicLights in
the decompiled engine; research document, "Dynamic Light Attenuation"). Each is worked out alone, and all are: that a
frame takes 32 at most depends on the view, and is the matter of `jktools.facts.in_view`. Scripts can dim a light: this
is how the level starts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.engine.light import light_on_vertices, reach
from jktools.geometry.validity import Float64, Int32
from jktools.model import Level, Thing
from jktools.model.resolved import Resolved

STILL = "none"
SHINES = 0x1
"""Thing flag: `light` sets it, and a later `thingflags` can take it away."""
DARK = 0x2 | 0x10 | 0x80000
"""Thing flags with which nothing shines: to be removed, not drawn, disabled (sithRender_Clip)."""


class StillLight(NamedTuple):
    """One thing that shines and does not move by itself."""

    thing: Thing
    intensity: float
    reach: float
    """JKU."""
    vertices: Int32
    """The vertices of surfaces that it lights, ascending."""
    amounts: Float64
    """What it adds to the light of each."""
    nearest: float
    """JKU to the nearest vertex of a surface; infinite where there is none."""


def still_lights(level: Level) -> list[StillLight]:
    """The lights of placed things that neither physics nor a path moves, in the order of the level."""
    used = lit_vertices(level)
    corners = level.vertices[used].astype(np.float64)
    found = []
    for thing in level.things:
        held = thing.resolved
        intensity = held.number("light")
        if (
            thing.dropped is None
            and held.move == STILL
            and intensity > 0
            and may_shine(held)
            and np.isfinite(thing.position).all()
        ):
            found.append(_light(thing, intensity, used, corners))
    return found


def may_shine(held: Resolved) -> bool:
    """Whether the flags of a thing let it shine."""
    flags = held.flags("thingflags")
    return bool(flags & SHINES) and not flags & DARK


def lit_vertices(level: Level) -> Int32:
    """The vertices that a sound surface uses, ascending."""
    table = level.document.surfaces
    keep = np.repeat(level.sound_surfaces, np.diff(table.corner_start))
    return np.unique(table.corner_vertex[keep]).astype(np.int32)


def _light(thing: Thing, intensity: float, used: Int32, corners: Float64) -> StillLight:
    position = thing.position.astype(np.float64)
    amounts = light_on_vertices(corners, position[None], [intensity])
    lit = np.flatnonzero(amounts > 0)
    nearest = float(np.sqrt(((corners - position) ** 2).sum(axis=1).min())) if len(corners) else np.inf
    return StillLight(thing, intensity, float(reach(intensity)), used[lit], amounts[lit], nearest)
