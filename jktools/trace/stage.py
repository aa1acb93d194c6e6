"""What a simulation sees of a level, whether read from its source or from a compiled file.

Both give the same to the last bit: every decimal of a level, a template or a model is rounded once to float32, which is
what the file holds. The exception is a file of accuracy `fast`, whose vertices and things lie on a grid.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from jktools.compiler import CompiledLevel
from jktools.engine.ground import Vector
from jktools.facts.bodies import insert_z_of
from jktools.facts.motion import Held
from jktools.geometry import Plan
from jktools.geometry.plan import plan_of
from jktools.model import Level


class Start(NamedTuple):
    """Where a body starts: JKU, a sector's index, and degrees."""

    position: Vector
    sector: int
    yaw: float = 0.0


class Stage(Protocol):
    """All that a simulation asks of a level."""

    @property
    def plan(self) -> Plan:
        """Sectors, surfaces, adjoins and their flags."""

    @property
    def gravity(self) -> float:
        """JKU/s^2, of the header."""

    def placed(self, number: int) -> Start:
        """Where the thing of a number stands. Raises ValueError for one that is not in the level."""

    def held(self, name: str) -> Held:
        """The template of a name. Raises ValueError for one that is not in play."""

    def insert_z(self, model: str) -> float | None:
        """The z of a model's insert offset, JKU; None where nothing tells it."""


class SourceStage:
    """A level as it was read from its source and the files beside it."""

    def __init__(self, level: Level) -> None:
        """Look at a level."""
        self._level = level
        self.plan = plan_of(level)
        self.gravity = float(level.header.values.get("gravity", np.zeros(1))[0])
        self.insert_z = insert_z_of(level)

    def placed(self, number: int) -> Start:
        """See `Stage`."""
        table = self._level.document.things
        found = [self._level.things[i] for i in np.flatnonzero(table.number == number).tolist()]
        thing = next((each for each in found if each.dropped is None), None)
        if thing is None:
            why = f": {found[0].dropped}" if found else ""
            raise ValueError(f"the level has no thing {number}{why}")
        x, y, z = thing.position.astype(np.float64).tolist()
        return Start((x, y, z), thing.sector_index, float(thing.angles[1]))

    def held(self, name: str) -> Held:
        """See `Stage`."""
        found = self._level.resolved_templates.get(name)
        if found is None:
            raise ValueError(f"the level has no template {name}")
        if found.dropped is not None:
            raise ValueError(f"template {name} is not in play: {found.dropped}")
        return found


class CompiledStage:
    """A compiled level, from its arrays alone."""

    def __init__(self, level: CompiledLevel) -> None:
        """Look at a level."""
        self._level = level
        self.plan = level.plan
        self.gravity = float(level.world.get("gravity", 0.0))

    def placed(self, number: int) -> Start:
        """See `Stage`."""
        things = self._level.things
        if things is None:
            raise ValueError(f"the file has no things: {self._level.why_absent('things')}")
        rows = np.flatnonzero(things.number == number)
        if not len(rows):
            raise ValueError(f"the level has no thing {number}")
        row = int(rows[0])
        x, y, z = things.position[row].astype(np.float64).tolist()
        return Start((x, y, z), int(things.sector[row]), float(things.angles[row, 1]))

    def held(self, name: str) -> Held:
        """See `Stage`."""
        if self._level.templates is None:
            raise ValueError(f"the file has no templates: {self._level.why_absent('templates')}")
        found = self._level.template(name)
        if found is None:
            raise ValueError(f"the file has no template {name}: those that the level can reach are in it")
        return found

    def insert_z(self, model: str) -> float | None:
        """See `Stage`."""
        offset = self._level.insert_offset(model)
        return None if offset is None else offset[2]


def stage_of(level: Level | CompiledLevel) -> Stage:
    """Make a level ready for simulations."""
    return CompiledStage(level) if isinstance(level, CompiledLevel) else SourceStage(level)
