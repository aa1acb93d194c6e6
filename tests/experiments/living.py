"""What is in play: things, their bodies, and the level's surfaces under the flags that scripts give them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

import jktools
from jktools.engine.thrust import actor_acceleration
from jktools.geometry.collision import MOVEMENT, SOLID, Collision, SectorFaces
from jktools.trace.in_level import LevelSimulation
from tests.experiments.smithdev import Experiment

Array = np.ndarray[Any, np.dtype[np.float64]]
FLIES = 0x2000
"""Physics flag."""


class LiveCollision(Collision):
    """The level's surfaces under the flags that they have now."""

    def __init__(self, level: jktools.Level, smithdev: Experiment) -> None:
        super().__init__(level)
        self.compiled = smithdev.level
        self.surface_flags = self.compiled.surface_flags.astype(np.int64)
        self.adjoin_flags = self.compiled.adjoin_flags.astype(np.int64)

    def faces(self, sector: int) -> SectorFaces:
        """A sector's surfaces, as last changed."""
        known = sector in self._faces
        faces = super().faces(sector)
        if not known:
            faces.polygons = tuple(p._replace(flags=int(self.surface_flags[p.surface])) for p in faces.polygons)
            faces.leads = tuple(self._lead(p.surface) for p in faces.polygons)
        return faces

    def changed(self, surface: int) -> None:
        """Forget what was known of the sector of a surface whose flags are others now."""
        self._faces.pop(int(self.compiled.surface_sector[surface]), None)

    def behind(self, surface: int) -> int:
        """The sector behind a surface's adjoin; SOLID without one."""
        adjoin = int(self.compiled.surface_adjoin[surface])
        if adjoin < 0:
            return SOLID
        return int(self.compiled.surface_sector[self.compiled.adjoin_surface[self.compiled.adjoin_mirror[adjoin]]])

    def _lead(self, surface: int) -> int:
        adjoin = int(self.compiled.surface_adjoin[surface])
        return self.behind(surface) if adjoin >= 0 and self.adjoin_flags[adjoin] & MOVEMENT else SOLID


class Body(LevelSimulation):
    """A body on its way; an actor that has a goal accelerates straight to it."""

    goal: Array | None = None
    ai_speed = 1.0

    def _own_acceleration(self, thrust: Array, crouching: bool, dt: float) -> Array:
        if self.goal is None:
            return super()._own_acceleration(thrust, crouching, dt)
        return actor_acceleration(
            self.body, self.goal - self.position, move_speed=self.ai_speed,
            three_dimensional=bool(self.body.physflags & FLIES),
        )  # fmt: skip


@dataclass
class Thing:
    """A thing in play."""

    number: int
    template: str
    type: int
    place: Array
    look: Array
    sector: int
    body: Body | None = None
    thrust: Array = field(default_factory=lambda: np.zeros(3))
    """As GetThingThrust reads it."""
    path: list[Array] = field(default_factory=list)
    """The frames of a thing that moves along them; the first is where it was placed."""
    frame: int = 0
    heading: tuple[int, float] | None = None
    """The frame that it moves to, and JKU/s."""
    carrier: Thing | None = None
    """What it is attached to, and `hold` its place in that one's frame."""
    hold: Array = field(default_factory=lambda: np.zeros(3))
    looks_at: Array | None = None
    born: int = 0
    died: int | None = None
    """Milliseconds."""
