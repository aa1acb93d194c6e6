"""Things that move on a path, and the frames of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from jktools.geometry.validity import Float64
from jktools.model import Level, Thing
from jktools.model.resolved import Origin
from jktools.syntax.template.parameters import Scope


class Mover(NamedTuple):
    """A placed thing with frames of its own."""

    thing: Thing
    positions: Float64
    """(n, 3) JKU."""
    origins: tuple[Origin, ...]
    """Of each frame."""


def movers(level: Level) -> list[Mover]:
    """The things on a path whose line has all their frames; those of a template lie relative to where it is placed."""
    found = []
    for thing in level.things:
        frames = thing.resolved.values.get("frame")
        if frames is None or frames.use.scope is not Scope.PATH or thing.dropped is not None:
            continue
        if isinstance(frames.value, tuple) and all(origin.owner == thing for origin in frames.origins):
            positions = np.array([frame[:3] for frame in frames.value if isinstance(frame, tuple)], np.float64)
            if np.isfinite(positions).all():
                found.append(Mover(thing, positions, frames.origins))
    return found
