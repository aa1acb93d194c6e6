"""Lips: steps up whose edge a walking body's sphere meets below its middle, and whether it slides up over them."""

from __future__ import annotations

from functools import cache

import numpy as np

from jktools.engine.body import Body
from jktools.engine.ground import SURFACES, Steps, Tread
from jktools.engine.integration import steady_speed
from jktools.engine.profile import Engine
from jktools.engine.simulation import Simulation, World
from jktools.engine.thrust import Keys, player_thrust

TICK = 0.02
"""Seconds: the fixed substep of the decompiled engine's players. Slower frames climb higher lips: 0.082 JKU for the
player's run at 30 a second, 0.074 at 50, 0.069 at 100."""
PHASES = 4
"""Places within a tick's way from which the body comes: where in a tick it meets the lip decides about 0.005 JKU."""
MOST_TICKS = 250
HALVINGS = 8
"""The highest lip is found to a 256th of the radius."""
STUCK = 1e-6
"""JKU a tick: a body that comes on by less stands before its lip."""


@cache
def highest_lip(body: Body, gravity: float, engine: Engine = Engine.RESEARCH) -> float:
    """Give the highest step, JKU, that a body surely goes up without a jump: simulated, straight on, at full speed.

    No less than what its sphere passes over, no more than its hover height. A player runs, an actor walks.
    """
    standing = Simulation(body, engine=engine).hover_height()
    low, high = max(standing - body.movesize, 0.0), max(standing, 0.0)
    keys = Keys(forward=1.0, run=body.player)
    thrust = float(np.linalg.norm(player_thrust(body, keys, engine=engine)))
    speed = float(steady_speed(thrust, body.surfdrag))
    if not 0 < speed < np.inf:
        return low
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        starts = (2 * body.movesize + speed * TICK * phase / PHASES for phase in range(PHASES))
        climbs = all(_climbs(body, middle, start, speed, keys, World(gravity=gravity), engine) for start in starts)
        low, high = (middle, high) if climbs else (low, middle)
    return low


def _climbs(body: Body, rise: float, start: float, speed: float, keys: Keys, world: World, engine: Engine) -> bool:
    floor = SURFACES["floor"]
    walk = Simulation(
        body, Steps((Tread(-1.0, 0.0, floor), Tread(0.0, rise, floor))), world, engine=engine,
        position=np.array([0.0, -start, 0.0]), velocity=np.array([0.0, speed, 0.0]),
    )  # fmt: skip
    walk.rest_on_ground()
    for _ in range(MOST_TICKS):
        before = walk.position
        walk.tick(keys, TICK)
        if walk.position[1] > 0:
            return True
        if bool((np.abs(walk.position - before) < STUCK).all()):
            return False
    return False
