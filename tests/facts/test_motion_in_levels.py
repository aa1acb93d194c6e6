"""Motion of the bodies of real levels against the simulation that `jktools trace` runs: a second opinion on each."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.compiler.section import Section
from jktools.engine.body import Body
from jktools.engine.flags import SectorFlag
from jktools.engine.profile import Engine
from jktools.engine.simulation import Simulation, World
from jktools.engine.thrust import Keys
from jktools.facts.motion import bodies, body_of, gravity_of
from jktools.session import load
from tests.support.levels import CORPUS

LEVELS = (
    "gob/masspack.gob!jkl/lagoon.jkl",
    "gob/masspack.gob!jkl/azulcity.jkl",
    "gob/canyon_camera.gob!jkl/canyon_camera.jkl",
    "jkl/hell.jkl",
    "jkl/kamislookout3.jkl",
)
FRAME = 1 / 50
WALK, RUN = Keys(forward=1.0), Keys(forward=1.0, run=True)
GAITS = {
    "walk": WALK, "back": Keys(forward=-1.0), "strafe": Keys(strafe=1.0), "run": RUN,
    "crouch": Keys(forward=1.0, crouch=True),
}  # fmt: skip


def standing(body: Body, engine: Engine, gravity: float) -> Simulation:
    simulation = Simulation(body, engine=engine, world=World(gravity=gravity))
    simulation.rest_on_ground()
    simulation.position[2] = simulation.hover_height()
    return simulation


def steady(simulation: Simulation, keys: Keys, *, floating: bool = False) -> float:
    """The speed after 40 seconds."""
    for _ in range(2000):
        simulation.tick(keys, FRAME)
        if floating:
            simulation.velocity[2], simulation.position[2] = 0.0, 1000.0
    return float(np.linalg.norm(simulation.velocity[:2]))


def floating(body: Body, engine: Engine, gravity: float, *, water: bool) -> Simulation:
    world = World(gravity=gravity, sector=SectorFlag.UNDERWATER if water else 0)
    return Simulation(body, engine=engine, world=world, position=np.array([0.0, 0.0, 1000.0]))


def stop(simulation: Simulation) -> float:
    start = float(simulation.position[1])
    steady(simulation, Keys())
    return float(simulation.position[1]) - start


def jump(body: Body, engine: Engine, gravity: float, keys: Keys, speed: float) -> tuple[float, float]:
    """Height, and way until the body is as high again as it started: in the air, so that no floor ends it earlier."""
    simulation = floating(body, engine, gravity, water=False)
    start = top = float(simulation.position[2])
    rise = body.jumpspeed * (0.7 if keys.crouch else 1.0)
    simulation.velocity = np.array([0.0, speed, rise])
    while True:
        before = simulation.position.copy()
        simulation.tick(keys, FRAME)
        if simulation.position[2] <= start:
            part = (before[2] - start) / (before[2] - simulation.position[2])
            return top - start, float(before[1] + (simulation.position[1] - before[1]) * part)
        top = max(top, float(simulation.position[2]))


@cache
def simulated(body: Body, engine: Engine, gravity: float) -> dict[str, float]:
    """Every figure of the section that a simulation can tell."""
    found = {name: steady(standing(body, engine, gravity), keys) for name, keys in GAITS.items()}
    for name, water in (("air", False), ("swim", True)):
        found[name] = steady(floating(body, engine, gravity, water=water), WALK, floating=True)
    for name, keys in (("walk", WALK), ("run", RUN)):
        moving = standing(body, engine, gravity)
        steady(moving, keys)
        found[f"stop_{name}"] = stop(moving)
    found["jump_height"], found["jump_reach"] = jump(body, engine, gravity, WALK, found["walk"])
    found["run_jump_reach"] = jump(body, engine, gravity, RUN, found["run"])[1]
    crouched = Keys(forward=1.0, crouch=True)
    found["crouched_jump_height"] = jump(body, engine, gravity, crouched, found["crouch"])[0]
    return found


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize("path", LEVELS)
def test_the_compiled_figures_are_what_the_simulation_does(path: str, engine: Engine) -> None:
    if not CORPUS.exists():
        pytest.skip("no corpus")
    level = load(str(CORPUS / path))
    settings = CompileSettings(engine=engine.value, only=frozenset({"motion"}))  # type: ignore[arg-type]
    motion = CompiledLevel(compile_level(level, settings)).sections["motion"]
    assert isinstance(motion, Section)
    row_of = {int(template): row for row, template in enumerate(motion.template)}
    tried = 0
    for held in bodies(level):
        body, row = body_of(held), row_of.get(held.owner.index)
        if body.player and row is not None:
            tried += 1
            expected = simulated(body, engine, gravity_of(level))
            told = {name: float(np.ravel(getattr(motion, name)[row])[0]) for name in expected}
            assert told == pytest.approx(expected, rel=1e-6), held.owner.title
    assert tried
