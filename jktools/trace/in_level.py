"""A trace in a level: a body that starts at a thing or a point, and lives by the flags of the sector it is in."""

from __future__ import annotations

import dataclasses

import numpy as np

from jktools.compiler import CompiledLevel
from jktools.engine import orientation
from jktools.engine.arrays import Float64
from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.flags import PhysicsFlag, SurfaceFlag
from jktools.engine.ground import Steps, Vector
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.simulation import History, Simulation, World, simulate
from jktools.engine.thrust import Keys
from jktools.facts.bodies import hovering_body
from jktools.geometry.collision import Collision
from jktools.model import Level
from jktools.trace.level_ground import LevelGround
from jktools.trace.script import parse
from jktools.trace.stage import Stage, Start, stage_of


class LevelSimulation(Simulation):
    """A body in a level: its sector's flags act on it, and its thrust points where it looks.

    Gravity is the level's. A sector's thrust vector is not in a JKL (COGs set it): it is 0 until a phase gives one.
    """

    def __init__(
        self, stage: Stage, start: Start, body: Body, engine: Engine = Engine.RESEARCH, scheme: Scheme | None = None
    ) -> None:
        """Put a body into a level. Raises ValueError for a sector that does not exist or is broken."""
        self.level_ground = LevelGround(Collision(stage.plan), start.position, start.sector)
        world = World(gravity=stage.gravity, sector=self.level_ground.sector_flags)
        super().__init__(body, self.level_ground, world, engine, scheme, np.array(start.position, np.float64))
        self.look: Float64 = orientation.matrix((0.0, start.yaw, 0.0))

    def rest_on_ground(self) -> None:
        """Set the body down on a surface up to two hover heights below it, a standing body's search; else it falls."""
        near = self.ground.floor_below(self._place(), 2 * self.hover_height(), 0.0, int(SurfaceFlag.COLLISION))
        if near is not None:
            super().rest_on_ground()

    def launch(self, velocity: Vector) -> None:
        """Give the body a velocity, JKU/s in the frame of its look: x right, y forward, z up."""
        self.velocity = self.look @ np.array(velocity, np.float64)

    def tick(self, keys: Keys, dt: float, *, jumps: bool = False) -> tuple[Float64, list[tuple[Event, float]]]:
        """Advance by `dt` seconds under the flags of the sector in which the body is (see `Simulation.tick`)."""
        self.level_ground.move_to(self._place())
        self.world = dataclasses.replace(self.world, sector=self.level_ground.sector_flags)
        return super().tick(keys, dt, jumps=jumps)

    def _own_acceleration(self, thrust: Float64, crouching: bool, dt: float) -> Float64:
        turned: Float64 = self.look @ super()._own_acceleration(thrust, crouching, dt)
        return turned


def trace_in_level(
    script: str,
    level: Level | CompiledLevel,
    start: Start,
    *,
    body: Body = WALKPLAYER,
    engine: Engine = Engine.RESEARCH,
    scheme: Scheme | None = None,
    fps: float = 50.0,
) -> History:
    """Simulate a body in a level under a script's text, from rest on the floor if one is near below its start.

    A compiled level gives the history that its source gives, to the last bit, but at accuracy `fast` (`trace.stage`).
    Raises ScriptError for a line that makes no sense, NotStatedError for what the profile does not say, and
    ValueError for a script that brings its own floors or a start outside the level.
    """
    read = parse(script)
    if read.ground != Steps.flat() or any(phase.ground for phase in read.phases):
        raise ValueError("a script for a level has no floor and no surface lines: the level has its own")
    simulation = LevelSimulation(stage_of(level), start, body, engine, scheme)
    simulation.rest_on_ground()
    return simulate(simulation, read.phases, read.seconds, 1 / fps)


def body_named(level: Level | CompiledLevel, name: str) -> Body:
    """The body of a template of the level, with the insert offset of its model.

    Raises ValueError for a template that the level does not have, that does not move by physics, or whose model, which
    would tell how high it hovers over floors, is not at hand.
    """
    stage = stage_of(level)
    held = stage.held(name)
    if held.move != "physics":
        raise ValueError(f"template {name} does not move by physics, but move={held.move}")
    body, hovers = hovering_body(held, stage.insert_z)
    if not hovers and body.physflags & PhysicsFlag.FLOOR_STICK:
        raise ValueError(f"template {name} hovers over floors by its model {held.name_in('model3d')}, not at hand")
    return body


def start_at(level: Level | CompiledLevel, place: str) -> Start:
    """Read where a body starts: a thing's number, which brings its yaw, or `x,y,z,sector`.

    Raises ValueError for a thing or sector that the level does not have.
    """
    words = place.split(",")
    try:
        numbers = [float(word) for word in words[:3]]
        index = int(words[-1])
    except ValueError:
        raise ValueError(f"{place!r} is neither a thing's number nor x,y,z,sector") from None
    stage = stage_of(level)
    if len(words) == 1:
        return stage.placed(index)
    if len(words) != 4 or not np.isfinite(numbers).all():
        raise ValueError(f"{place!r} is neither a thing's number nor x,y,z,sector")
    sectors = len(stage.plan.sector_flags)
    if not 0 <= index < sectors:
        raise ValueError(f"sector {index} is none of the level's {sectors}")
    return Start((numbers[0], numbers[1], numbers[2]), index)
