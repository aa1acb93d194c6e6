"""Document, "Detecting Detachment": sector thrust, the plate whose flags are toggled, walkways and stairs."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER
from jktools.engine.flags import SurfaceFlag
from jktools.engine.ground import Ground
from jktools.engine.profile import Engine
from jktools.engine.reattach import walk_down
from jktools.engine.simulation import History, Phase, simulate
from jktools.engine.thrust import Keys
from jktools.facts.ledges import DOWN, Kind
from jktools.geometry import Plan
from jktools.geometry.collision import MOVEMENT, Collision
from jktools.trace.in_level import LevelSimulation
from jktools.trace.level_ground import LevelGround
from jktools.trace.stage import Stage, stage_of
from tests.experiments.conftest import Compile
from tests.experiments.scripts import calls
from tests.experiments.smithdev import GOLDEN, HANDLE, Experiment
from tests.experiments.tracing import Run

FLOOR, SOLID = np.uint32(SurfaceFlag.FLOOR), np.uint32(SurfaceFlag.COLLISION)
ENGINES = ("research", "openjkdf2")


# ---- sector thrust


@pytest.mark.parametrize("engine", ENGINES)
def test_upward_thrust_waits_for_the_jump(smithdev: Experiment, trace: Run, engine: str) -> None:
    """'The player is not accelerated upwards until he jumps': with the thrust that the level's script sets."""
    assert GOLDEN["sector_thrust"]["upward_while_attached"] == "nothing until the jump"
    strength = float(smithdev.cog_values("velocity_hallway/lift")[2])
    script = f"0 sector-thrust 0 0 {strength}\n1 jump\n1.5 end"
    walk = trace(script, "velocity_hallway/start of thrust", "--engine", engine)
    assert walk.attached[:51].all() and not walk.velocity[:51].any()
    assert walk.said == ["leaves the ground"]
    # Up at thrust less gravity, from the jump's 1.5 on.
    assert walk.velocity[-1, 2] > 1.5 + 0.4 * (strength - 4) * 0.8
    assert walk.position[-1, 2] > 1


@pytest.mark.parametrize("engine", ENGINES)
def test_upward_thrust_without_a_floor_acts_at_once(smithdev: Experiment, trace: Run, engine: str) -> None:
    assert GOLDEN["sector_thrust"]["upward_on_non_floor"] == "at once"
    strength = float(smithdev.cog_values("velocity_hallway/lift")[2])
    script = f"0 sector-thrust 0 0 {strength}\n0.5 end"
    rise = trace(script, "velocity_hallway/start of thrust over no floor", "--engine", engine)
    assert rise.velocity[1, 2] == pytest.approx((strength - 4) * 0.02, rel=1e-6)


def test_the_lanes_with_thrust(smithdev: Experiment) -> None:
    """Both have the sector flag, both are named by the script; only one has a floor."""
    lanes = ["velocity_hallway/thrust", "velocity_hallway/thrust over no floor"]
    geometry = smithdev.level.geometry
    assert [int(geometry.sector_flags[smithdev.sector(lane)]) & 0x8 for lane in lanes] == [0x8, 0x8]
    assert smithdev.cog_values("velocity_hallway/lift")[:2] == [str(smithdev.sector(lane)) for lane in lanes]
    floors = [smithdev.surfaces(f"{lane}.floor")[0] for lane in lanes]
    assert [int(geometry.surface_flags[floor]) & 0x1 for floor in floors] == [0x1, 0]


# ---- "Surface Flags": the plate


def toggled(smithdev: Experiment, *, floor: bool = True, shut: bool = True) -> Stage:
    """The compiled level with the plate as the script's two switches leave it."""
    stage = stage_of(smithdev.level)
    surfaces, adjoins = (flags.copy() for flags in (stage.plan.surface_flags, stage.plan.adjoin_flags))
    (plate,) = smithdev.surfaces("floor_flags/room.plate")
    (below,) = smithdev.surfaces("floor_flags/well.plate")
    if not floor:
        surfaces[plate] &= ~FLOOR
    if not shut:
        surfaces[[plate, below]] &= ~SOLID
        adjoins[stage.plan.surface_adjoin[[plate, below]]] |= MOVEMENT
    return Toggled(stage.plan._replace(surface_flags=surfaces, adjoin_flags=adjoins), stage)


class Toggled:
    """A stage with another geometry."""

    def __init__(self, plan: Plan, stage: Stage) -> None:
        self.plan, self.gravity = plan, stage.gravity
        self.placed, self.held, self.insert_z = stage.placed, stage.held, stage.insert_z


def ground(stage: Stage, body: LevelSimulation) -> Ground:
    return LevelGround(Collision(stage.plan), body.level_ground.place, body.level_ground.sector)


def stands_then_walks(first: Stage, then: Stage, engine: Engine) -> History:
    """On the plate: a second as it is, a second after the switch without a key, then a step."""
    start = first.placed(HANDLE["floor_flags"]["things"]["on the plate"])
    body = LevelSimulation(first, start, WALKPLAYER, engine)
    body.rest_on_ground()
    phases = [Phase(0), Phase(1, Keys(), ground(then, body)), Phase(2, Keys(forward=1))]
    return simulate(body, phases, 2.6, 0.02)


@pytest.mark.parametrize("engine", Engine)
def test_a_stationary_player_does_not_notice_that_his_floor_is_none(smithdev: Experiment, engine: Engine) -> None:
    assert GOLDEN["reattach"]["only_while_moving"] is True
    walk = stands_then_walks(toggled(smithdev), toggled(smithdev, floor=False), engine)
    assert walk.attached[:101].all() and not walk.attached[101:].any()
    assert (walk.position[:101, 2] == walk.position[0, 2]).all()
    assert [(round(i.time, 2), i.event) for i in walk.incidents] == [(2.02, Event.DETACHES)]
    assert walk.position[-1, 2] < walk.position[0, 2] - 0.02, "he sinks in"


@pytest.mark.parametrize("engine", Engine)
def test_a_stationary_player_does_not_notice_that_he_stands_on_a_floor(smithdev: Experiment, engine: Engine) -> None:
    walk = stands_then_walks(toggled(smithdev, floor=False), toggled(smithdev), engine)
    assert not walk.attached[:101].any()
    assert walk.position[100, 2] == pytest.approx(GOLDEN["walkplayer"]["movesize"], abs=1e-6)
    assert [(round(i.time, 2), i.event) for i in walk.incidents] == [(2.02, Event.ATTACHES)]
    assert walk.position[-1, 2] > walk.position[100, 2] + 0.02, "the landing raises him"


@pytest.mark.parametrize("engine", Engine)
def test_a_stationary_player_does_not_notice_that_his_floor_is_gone(smithdev: Experiment, engine: Engine) -> None:
    """'This, too, resulted in nothing happening until the player attempted to move.'"""
    walk = stands_then_walks(toggled(smithdev), toggled(smithdev, shut=False), engine)
    assert walk.attached[:101].all()
    assert (walk.position[:101, 2] == walk.position[0, 2]).all()
    assert [(round(i.time, 2), i.event) for i in walk.incidents[:1]] == [(2.02, Event.DETACHES)]


def test_the_script_names_the_plate(smithdev: Experiment) -> None:
    """The compiler knows that the plate may change: what lies under it is left open, not called a wall."""
    (plate,) = smithdev.surfaces("floor_flags/room.plate")
    (below,) = smithdev.surfaces("floor_flags/well.plate")
    assert smithdev.cog_values("floor_flags/toggle")[2:] == [str(plate), str(below)]


def test_the_script_toggles_what_the_experiment_does() -> None:
    """One switch the floor flag 0x1; the other movement 0x2 and solidity 0x4 of both sides: as `toggled` writes."""
    both = ("plate", "below")
    for change, other in (("clear", "set"), ("set", "clear")):
        opens = [f"{change}adjoinflags({side}, 0x2)" for side in both]
        solid = [f"{other}surfaceflags({side}, 0x4)" for side in both]
        assert calls("sd_toggle.cog", f"{change}adjoinflags") == opens
        floor = f"{other}surfaceflags(plate, 0x1)"
        assert calls("sd_toggle.cog", f"{other}surfaceflags") == [floor, *solid]


# ---- "Descending From Height", its beginning: walkways and stairs

WAYS = {
    "walks down": 5.0,
    "walks the second": 5.0,
    "walks the third": 5.0,
    "walks the gentle flight": 3.0,
}
"""JKU from each ghost until its part of the way is done."""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("gait", ["walk", "run"])
@pytest.mark.parametrize("way", WAYS)
def test_a_walkway_of_many_surfaces_is_never_let_go(trace: Run, way: str, gait: str, engine: str) -> None:
    """'When walking down a slope, stairs ... the player is never actually detached.'"""
    seconds = WAYS[way] / (2 / 3 if gait == "walk" else 4 / 3) + 0.5
    walk = trace(f"0 {gait} forward\n{seconds} end", f"walkway/{way}", "--engine", engine)
    assert walk.attached.all() and walk.said == []
    assert walk.ahead[-1] > WAYS[way] - 0.3
    assert walk.position[-1, 2] < walk.position[0, 2] - 0.35


def test_no_edge_of_the_ramps_is_a_fall(smithdev: Experiment) -> None:
    ledges = smithdev.level.ledges
    assert ledges is not None
    body = smithdev.body("walkplayer")
    floors = {
        surface
        for name, found in HANDLE["walkway"]["surfaces"].items()
        for surface in found
        if name.endswith(".floor") and "step" not in name
    }
    rows = [row for floor in floors for row in smithdev.ledges(body, floor) if ledges.below[row] in floors]
    # An edge that is not listed is level, and so is one of that kind.
    assert {Kind(ledges.kind[row]) for row in rows} <= {Kind.LEVEL}
    ramps, turns, door = 3 * 4, 6, 1
    assert len(floors) == ramps + turns + door


@pytest.mark.parametrize("engine", ENGINES)
def test_each_step_alone_is_low_enough(compiled: Compile, engine: str) -> None:
    level = compiled("--engine", engine)
    ledges = level.level.ledges
    assert ledges is not None
    for name, flight in level.about("walkway")["flights"].items():
        upper = "third turn" if name == "gentle" else "rest"
        for i in range(flight["steps"]):
            (floor,) = level.surfaces(f"walkway/{upper}.floor")
            (next_floor,) = level.surfaces(f"walkway/{name} step {i}.floor")
            rows = level.ledges(level.body("walkplayer"), floor, next_floor)
            assert [Kind(kind) for kind in ledges.kind[rows] if kind in DOWN] == [Kind.SEAMLESS]
            upper = f"{name} step {i}"


@pytest.mark.parametrize("gait", ["walk", "run"])
def test_the_steep_flight_is_walked_and_fallen_down(smithdev: Experiment, trace: Run, gait: str) -> None:
    """A body sinks at 0.5 JKU/s: at a run the steep flight's lag adds up to more than 0.185114."""
    flight = smithdev.about("walkway")["flights"]["steep"]
    speed = 2 / 3 if gait == "walk" else 4 / 3
    drops, treads = [flight["drop"]] * flight["steps"], [flight["tread"]] * flight["steps"]
    predicted = walk_down(drops, treads, speed, GOLDEN["reattach"]["changeover"][0]["predicted"])
    walk = trace(f"0 {gait} forward\n{3 / speed + 0.5} end", "walkway/walks the steep flight")
    assert bool(predicted.seamless.all()) is (gait == "walk")
    assert (walk.said == []) is bool(predicted.seamless.all())
    if gait == "run":
        first = int(np.flatnonzero(~predicted.seamless)[0])
        left = walk.ahead[int(np.flatnonzero(walk.attached == 0)[0])]
        assert 1 + first * flight["tread"] <= left < 1 + (first + 1) * flight["tread"]


# ---- basins: what jktools makes of the document's pits


def test_basins(smithdev: Experiment) -> None:
    """The pits are left by a jump, the trap is not left at all, and the well under the plate is not judged."""
    basins = smithdev.level.basins
    assert basins is not None
    held = {}
    for row in range(len(basins.body)):
        if basins.body[row] == smithdev.body("walkplayer"):
            for surface in basins.surface[basins.surface_start[row] : basins.surface_start[row + 1]]:
                held[int(surface)] = row
    (pit,) = smithdev.surfaces("pit_rows/pit 0.120114 0.2.floor")
    (trap,) = smithdev.surfaces("pit_rows/trap.floor")
    assert [float(basins.shallowest[held[pit]]), float(basins.deepest[held[pit]])] == pytest.approx([0.2, 0.2])
    jump, nothing = 0x2, 0
    assert (basins.left[held[pit]], basins.left[held[trap]]) == (jump, nothing)
    fall = 0x2
    assert basins.entered[held[pit]] & fall and basins.entered[held[trap]] & fall
