"""What is in play: things, their bodies, and the level's surfaces under the flags that scripts give them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from jktools.engine.flags import PhysicsFlag
from jktools.engine.thrust import actor_acceleration
from jktools.geometry.collision import SOLID, Collision
from jktools.trace.in_level import LevelSimulation
from jktools.trace.stage import Stage

Array = np.ndarray[Any, np.dtype[np.float64]]


class LiveCollision(Collision):
    """The level's surfaces under the flags that they have now."""

    def __init__(self, stage: Stage) -> None:
        self.surface_flags, self.adjoin_flags = stage.plan.surface_flags.copy(), stage.plan.adjoin_flags.copy()
        super().__init__(stage.plan._replace(surface_flags=self.surface_flags, adjoin_flags=self.adjoin_flags))

    def change(self, surface: int, *, flags: tuple[int, int] = (0, 0), adjoin: tuple[int, int] = (0, 0)) -> None:
        """Set and clear flags of a surface, and of its adjoin."""
        self.surface_flags[surface] = int(self.surface_flags[surface]) & ~flags[1] | flags[0]
        if adjoin != (0, 0):
            number = self.plan.surface_adjoin[surface]
            self.adjoin_flags[number] = int(self.adjoin_flags[number]) & ~adjoin[1] | adjoin[0]
        self._faces.clear()

    def behind(self, surface: int) -> int:
        """The sector behind a surface's adjoin; SOLID without one."""
        return int(self.plan.by_adjoin(self.plan.adjoin_sector, SOLID)[surface])

    def surfaces(self, sector: int) -> range:
        """The surfaces of a sector."""
        first = int(self.plan.first_surface[sector])
        return range(first, first + int(self.plan.surface_count[sector]))

    def corners(self, sector: int) -> Array:
        """(n, 3), JKU: those of all its surfaces."""
        own = self.surfaces(sector)
        corners = slice(self.plan.corner_start[own.start], self.plan.corner_start[own.stop])
        return self.plan.positions[self.plan.corner_vertex[corners]].astype(np.float64)


class Body(LevelSimulation):
    """A body on its way; an actor that has a goal accelerates straight to it."""

    goal: Array | None = None
    ai_speed = 1.0

    def _own_acceleration(self, thrust: Array, crouching: bool, dt: float) -> Array:
        if self.goal is None:
            return super()._own_acceleration(thrust, crouching, dt)
        return actor_acceleration(
            self.body, self.goal - self.position, move_speed=self.ai_speed,
            three_dimensional=bool(self.body.physflags & PhysicsFlag.FLIES),
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
