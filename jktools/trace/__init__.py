"""Motion as data: scripts in, simulated or recorded traces out, and fits of what a recording shows."""

from __future__ import annotations

from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.simulation import History, Simulation, simulate
from jktools.trace.fitting import fit
from jktools.trace.script import parse

__all__ = ["fit", "trace"]


def trace(
    script: str,
    *,
    body: Body = WALKPLAYER,
    engine: Engine = Engine.RESEARCH,
    scheme: Scheme | None = None,
    fps: float = 50.0,
) -> History:
    """Simulate a body under a script's text (see `trace.script`) from rest at the origin, at `fps` frames a second.

    `scheme` None is the profile's own. Raises ScriptError for a line that makes no sense and NotStatedError for
    what the profile does not say, ValueError for a sector's thrust.
    """
    read = parse(script)
    if any(phase.sector_thrust for phase in read.phases):
        raise ValueError("sector-thrust is for a level: floors given by numbers have no sectors")
    simulation = Simulation(body, read.ground, engine=engine, scheme=scheme)
    simulation.rest_on_ground()
    return simulate(simulation, read.phases, read.seconds, 1 / fps)
