"""Document, "Detecting Detachment": sector thrust, the plate whose flags are toggled, walkways and stairs."""

from __future__ import annotations

import numpy as np
import pytest

from fixtures.smithdev.chambers.velocity_hallway import LIFT
from jktools.engine.profile import Engine
from jktools.engine.reattach import walk_down
from jktools.facts.ledges import DOWN, Kind
from tests.experiments.conftest import Compile
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, HANDLE, Experiment
from tests.experiments.tracing import Run

ENGINES = ("research", "openjkdf2")


# ---- sector thrust


@pytest.mark.parametrize("engine", Engine)
def test_upward_thrust_waits_for_the_jump(smithdev: Experiment, engine: Engine) -> None:
    """'The player is not accelerated upwards until he jumps': with the thrust that `sd_lift.cog` sets at the start."""
    assert GOLDEN["sector_thrust"]["upward_while_attached"] == "nothing until the jump"
    play = Play(smithdev, "velocity_hallway/start of thrust", engine=engine)
    assert play.sector_thrust[play.player.sector].tolist() == [0, 0, LIFT]
    before = play.run(1)
    assert all(moment.attached and not moment.velocity.any() for moment in before)
    after = play.run(0.5, "jump")
    assert not any(moment.attached for moment in after)
    # Up at thrust less gravity, from the jump's 1.5 on.
    assert after[-1].velocity[2] > 1.5 + 0.4 * (LIFT - 4) * 0.8
    assert after[-1].place[2] > 1


@pytest.mark.parametrize("engine", Engine)
def test_upward_thrust_without_a_floor_acts_at_once(smithdev: Experiment, engine: Engine) -> None:
    assert GOLDEN["sector_thrust"]["upward_on_non_floor"] == "at once"
    play = Play(smithdev, "velocity_hallway/start of thrust over no floor", engine=engine)
    assert play.run(0.02)[0].velocity[2] == pytest.approx((LIFT - 4) * 0.02, rel=1e-6)


def test_only_the_lanes_of_the_script_lift(smithdev: Experiment) -> None:
    """Beside them there is no thrust: a jump comes down again, and in the lane without gravity it does not."""
    heights = {}
    for lane in ("floor", "no gravity"):
        play = Play(smithdev, f"velocity_hallway/start of {lane}")
        heights[lane] = play.run(1, "jump")[-1].place[2]
    assert heights["floor"] == pytest.approx(GOLDEN["walkplayer"]["insert_offset_z"], abs=1e-6)
    assert heights["no gravity"] > 1


def test_the_lanes_with_thrust(smithdev: Experiment) -> None:
    """Both have the sector flag, both are named by the script; only one has a floor."""
    lanes = ["velocity_hallway/thrust", "velocity_hallway/thrust over no floor"]
    geometry = smithdev.level.geometry
    assert [int(geometry.sector_flags[smithdev.sector(lane)]) & 0x8 for lane in lanes] == [0x8, 0x8]
    assert smithdev.cog_values("velocity_hallway/lift")[:2] == [str(smithdev.sector(lane)) for lane in lanes]
    floors = [smithdev.surfaces(f"{lane}.floor")[0] for lane in lanes]
    assert [int(geometry.surface_flags[floor]) & 0x1 for floor in floors] == [0x1, 0]


# ---- "Surface Flags": the plate


def at_the_plate(smithdev: Experiment, engine: Engine) -> Play:
    """A second on the plate, which nobody has touched."""
    play = Play(smithdev, "floor_flags/on the plate", engine=engine)
    assert all(moment.attached for moment in play.run(1))
    return play


@pytest.mark.parametrize("engine", Engine)
def test_a_stationary_player_does_not_notice_that_his_floor_is_none(smithdev: Experiment, engine: Engine) -> None:
    """'When the player is completely stationary and the floor flag is cleared then nothing initially happens.'"""
    assert GOLDEN["reattach"]["only_while_moving"] is True
    play = at_the_plate(smithdev, engine)
    start = play.player.place[2]
    play.press("floor switch")
    still = play.run(1)
    assert all(moment.attached and moment.place[2] == start for moment in still)
    step = play.run(0.6, "walk forward")
    assert not any(moment.attached for moment in step), "from the first frame of his step on"
    assert step[-1].place[2] == pytest.approx(GOLDEN["walkplayer"]["movesize"], abs=1e-6), "he sinks in"


@pytest.mark.parametrize("engine", Engine)
def test_a_stationary_player_does_not_notice_that_he_stands_on_a_floor(smithdev: Experiment, engine: Engine) -> None:
    """'Likewise, when sunken in and completely stationary, and the button is pressed to set the floor flag.'"""
    play = at_the_plate(smithdev, engine)
    play.press("floor switch")
    play.run(0.3, "walk forward")
    # Only air drag slows who is sunken in: by `research` for ever less, so that the last of it is taken by hand.
    sunken = play.run(20)[-1]
    assert not sunken.attached and np.abs(sunken.velocity).max() < 1e-5
    assert play.player.body is not None
    play.player.body.velocity = np.zeros(3)
    assert sunken.place[2] == pytest.approx(GOLDEN["walkplayer"]["movesize"], abs=1e-6)
    assert play.collision.surface_flags[smithdev.surfaces("floor_flags/room.plate")[0]] == 0x4
    play.press("floor switch")
    assert not any(moment.attached for moment in play.run(1))
    step = play.run(0.6, "walk forward")
    assert all(moment.attached for moment in step), "from the first frame of his step on"
    assert step[-1].place[2] > sunken.place[2] + 0.02, "the landing raises him"


@pytest.mark.parametrize("engine", Engine)
def test_a_stationary_player_does_not_notice_that_his_floor_is_gone(smithdev: Experiment, engine: Engine) -> None:
    """'This, too, resulted in nothing happening until the player attempted to move': and then he is in the well."""
    play = at_the_plate(smithdev, engine)
    start = play.player.place[2]
    play.press("pass switch")
    still = play.run(1)
    assert all(moment.attached and moment.place[2] == start for moment in still)
    step = play.run(0.6, "walk forward")
    assert not step[0].attached
    depth = smithdev.about("floor_flags")["depth"]
    assert play.player.sector == smithdev.sector("floor_flags/well")
    assert step[-1].place[2] == pytest.approx(start - float(depth), abs=1e-6)


@pytest.mark.parametrize("engine", Engine)
def test_the_switches_put_it_back(smithdev: Experiment, engine: Engine) -> None:
    """Pressed twice, each leaves the plate as it was: flags of both sides, and a floor to walk on."""
    play = at_the_plate(smithdev, engine)
    before = play.collision.surface_flags.copy(), play.collision.adjoin_flags.copy()
    changed = []
    for switch in ("floor switch", "pass switch"):
        play.press(switch)
        now = play.collision.surface_flags, play.collision.adjoin_flags
        changed.append([int((a != b).sum()) for a, b in zip(before, now, strict=True)])
        play.press(switch)
        assert all((a == b).all() for a, b in zip(before, now, strict=True))
    assert changed == [[1, 0], [2, 2]]
    assert all(moment.attached for moment in play.run(0.6, "walk forward"))


def test_the_script_names_the_plate(smithdev: Experiment) -> None:
    """The compiler knows that the plate may change: what lies under it is left open, not called a wall."""
    (plate,) = smithdev.surfaces("floor_flags/room.plate")
    (below,) = smithdev.surfaces("floor_flags/well.plate")
    assert smithdev.cog_values("floor_flags/toggle")[2:] == [str(plate), str(below)]


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
