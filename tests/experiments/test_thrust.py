"""Document, "Thrust": the Thrust Chamber, the lanes of the Velocity Hallway, the Actor Control Chamber."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine.profile import Engine
from jktools.engine.thrust import NotStatedError, actor_acceleration
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, Experiment
from tests.experiments.tracing import Run

ENGINES = ("research", "openjkdf2")
RULES = GOLDEN["thrust"]
WELL = "thrust_chamber/in the well"
WAYS = {"forward": "forward", "backward": "back", "strafe_left": "left", "strafe_right": "right"}


def exactly(value: object) -> object:
    return pytest.approx(value, rel=1e-6, abs=1e-9)


def axis_of(way: str, value: float) -> list[float]:
    vector = [0.0, 0.0, 0.0]
    vector["xyz".index(RULES[way]["axis"])] = value
    return vector


# ---- "Player Movement", in the cell that holds the player


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("way", WAYS)
def test_text_1_walking(trace: Run, way: str, engine: str) -> None:
    walk = trace(f"0 walk {WAYS[way]}\n1 end", WELL, "--body", "walkplayer", "--engine", engine)
    assert walk.thrust[1:].tolist() == [exactly(axis_of(way, RULES[way]["walk"]))] * 50
    assert walk.ahead.max() < 0.0132, "the chamber holds the player in place"


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("way", WAYS)
def test_text_1_factors_of_maxthrust(trace: Run, way: str, engine: str) -> None:
    """'Template property maxthrust is used to determine baseline forward walk speed': the factors, at another one."""
    walk = trace(f"0 walk {WAYS[way]}\n0.1 end", WELL, "--set", "maxthrust=0.8", "--engine", engine)
    assert walk.thrust[-1] == exactly(axis_of(way, 0.8 * RULES[way]["factor"]))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("way", WAYS)
def test_text_1_running_and_crouching(trace: Run, way: str, engine: str) -> None:
    """A run doubles, crouching halves and hides the run."""
    script = f"0 run {WAYS[way]}\n0.5 crouch\n1 end"
    walk = trace(script, WELL, "--body", "walkplayer", "--engine", engine)
    running, crouching = (RULES[way]["walk"] * RULES[name] for name in ("run_factor", "crouch_factor"))
    assert walk.thrust[10] == exactly(axis_of(way, running))
    assert walk.thrust[40] == exactly(axis_of(way, crouching))


@pytest.mark.parametrize(
    ("start", "keys", "thrust"),
    [
        (WELL, "walk forward", [0, 2 + 0.5, 0]),
        (WELL, "walk left", [-(1.4 + 0.5), 0, 0]),
        (WELL, "walk back", [0, -(1 + 0.5), 0]),
        (WELL, "run forward", [0, 2 * (2 + 0.5), 0]),
        ("velocity_hallway/start of no floor", "walk forward", [0, 0.3 * (2 + 0.5), 0]),
    ],
)
def test_text_1_extra_speed(trace: Run, start: str, keys: str, thrust: list[float]) -> None:
    """SetActorExtraSpeed 'simply adds value (BEFORE any other mod)', and 'AFTER' the direction's factor."""
    walk = trace(f"0 extra-speed 0.5\n0 {keys}\n0.5 end", start, "--body", "walkplayer")
    assert walk.thrust[-1].tolist() == exactly(thrust)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("start", ["velocity_hallway/start of floor", "pit_rows/before 0.120114 0.11"])
def test_thrust_is_read_in_the_look_and_acts_along_it(
    smithdev: Experiment, trace: Run, start: str, engine: str
) -> None:
    """One chamber lies as it is built, the other is turned by half a circle: the thrust is along y in both."""
    assert RULES["frame"] == "look direction"
    walk = trace("0 walk forward\n0.5 end", start, "--engine", engine)
    assert walk.thrust[-1] == exactly([0.0, 2.0, 0.0])
    assert walk.velocity[-1] / walk.speed[-1] == exactly(smithdev.look(start))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("gait", ["walk forward", "run forward"])
def test_text_1_not_attached(trace: Run, gait: str, engine: str) -> None:
    """'Final thrust is cut to 30% (crouch/run/surfaceflag mods are ignored)'."""
    slide = trace(f"0 {gait}\n1 end", "velocity_hallway/start of no floor", "--body", "walkplayer", "--engine", engine)
    assert not slide.attached.any()
    assert slide.thrust[-1] == exactly([0.0, 2.0 * RULES["unattached_factor"], 0.0])


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("lane", ["icy", "very icy", "shallow water"])
def test_text_1_surfaces_that_leave_thrust_alone(trace: Run, lane: str, engine: str) -> None:
    assert RULES["icy_changes_thrust"] is False and RULES["shallow_water_factor"] == 1.0
    walk = trace("0 walk forward\n1 end", f"velocity_hallway/start of {lane}", "--engine", engine)
    assert walk.attached.all()
    assert walk.thrust[-1] == exactly([0.0, 2.0, 0.0])


@pytest.mark.parametrize("lane", ["deep water", "very deep water"])
def test_text_1_deep_water(trace: Run, lane: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The document's factors are illegible: `research` says so, the decompiled engine has 0.5."""
    start = f"velocity_hallway/start of {lane}"
    with pytest.raises(AssertionError, match="illegible"):
        trace("0 walk forward\n1 end", start)
    walk = trace("0 walk forward\n1 end", start, "--engine", "openjkdf2")
    assert walk.thrust[-1] == exactly([0.0, 1.0, 0.0])


def test_the_lanes_have_the_flags_of_the_table(smithdev: Experiment) -> None:
    flags = smithdev.level.geometry.surface_flags
    for name in ("deep_water", "shallow_water", "very_deep_water", "icy", "very_icy"):
        (lane,) = smithdev.surfaces(f"velocity_hallway/hall.{name.replace('_', ' ')}")
        assert flags[lane] == RULES["flags"][name] | GOLDEN["flags"]["surface"]["floor"] | 0x4


def test_falling_shows_no_thrust(trace: Run) -> None:
    fall = trace("1 end", "insert_offset/over the floor")
    assert fall.velocity[:, 2].min() < -1
    assert bool(fall.thrust.any()) is RULES["gravity_changes_thrust"]


# ---- "Applying Thrust"


@pytest.mark.parametrize("engine", ENGINES)
def test_applying_thrust(smithdev: Experiment, trace: Run, engine: str) -> None:
    """Thrust turned by the look and applied as an acceleration: one frame gives 2 * 0.02 JKU/s."""
    assert smithdev.template("walkplayer")["maxthrust"] == GOLDEN["walkplayer"]["maxthrust"]
    start = "pit_rows/before 0.120114 0.11"
    walk = trace("0 walk forward\n0.02 end", start, "--engine", engine)
    assert walk.velocity[-1] == exactly([c * 2.0 * 0.02 for c in smithdev.look(start)])


# ---- "Actor Movement"


def test_actors_move_by_maxthrust(smithdev: Experiment) -> None:
    """The two actors of the control chamber differ in their speed as in their maxthrust."""
    rules = GOLDEN["actor_thrust"]
    thrusts = {"sd_powerdroid": rules["powerdroid_maxthrust"], "sd_robotsentry": rules["robotsentry_maxthrust"]}
    for name, maxthrust in thrusts.items():
        record, motion = smithdev.template(name), smithdev.motion(name)
        assert record["maxthrust"] == pytest.approx(maxthrust, rel=1e-6)
        assert int(record["physflags"]) & rules["uses_thrust_physflag"]
        if name == "sd_robotsentry":
            assert motion["air"] == pytest.approx(maxthrust / record["airdrag"], rel=1e-6)
            assert np.isnan(motion["walk"]), "it takes no floor"
            continue
        assert motion["walk"] == pytest.approx(maxthrust / record["surfdrag"], rel=1e-6)
        # No penalty backwards or sideways: an AI is moved directly, not by keys.
        assert motion["back"] == motion["strafe"] == motion["walk"]


def test_actors_start_before_they_face_their_goal(smithdev: Experiment) -> None:
    assert GOLDEN["actor_thrust"]["moves_before_facing"] is True
    things = smithdev.level.things
    assert things is not None
    actor, goal, sight = (
        things.position[smithdev.thing(f"actor_control/{name}")] for name in ("powerdroid", "goal", "sight")
    )
    towards, looking = goal - actor, sight - actor
    assert np.dot(towards, looking) < 0, "the script has it look the other way"
    pushed = actor_acceleration(smithdev.engine_body("sd_powerdroid"), towards)
    flat = np.array([*towards[:2], 0.0]) / np.linalg.norm(towards[:2])
    assert pushed == pytest.approx((0.2 * flat).tolist(), rel=1e-5)


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("name", ["powerdroid", "robotsentry"])
def test_actors_read_no_thrust(smithdev: Experiment, name: str, engine: Engine) -> None:
    """`sd_errand.cog`: GetThingThrust 'seems to report a 0 vector even when the actor is most definitely moving'.

    Walker and flyer: both go to one place and look at another, and the script prints until they have arrived.
    """
    play = Play(smithdev, "actor_control/goal", engine=engine)
    (actor,) = play.living(f"sd_{name}")
    goal, sight = (play.things[smithdev.thing(f"actor_control/{each}")].place for each in ("goal", "sight"))
    start = actor.place.copy()
    play.press(f"switch {name}")
    assert actor.looks_at == pytest.approx(sight)
    play.run(5)
    printed = [words for _, words in play.printed(name)]
    assert len(printed) == 50
    assert {words[1] for words in printed} == {float(GOLDEN["actor_thrust"]["get_thing_thrust"])}
    speeds = [float(words[2]) for words in printed]
    assert speeds[0] > 0 and speeds == sorted(speeds)
    # "A velocity analysis on actor movement shows a very similar result to the player's": maxthrust over drag.
    record, gait = smithdev.template(f"sd_{name}"), "walk" if name == "powerdroid" else "air"
    drag = record["surfdrag" if name == "powerdroid" else "airdrag"]
    assert speeds[-1] == pytest.approx(smithdev.motion(f"sd_{name}")[gait], rel=1e-3)
    # Straight to its goal while it looks the other way; only the flyer rises.
    axes = slice(0, 2 if name == "powerdroid" else 3)
    way, wanted = (actor.place - start)[axes], (goal - start)[axes]
    assert way / np.linalg.norm(way) == exactly(wanted / np.linalg.norm(wanted))
    assert GOLDEN["actor_thrust"]["moves_before_facing"] is bool(way @ (sight - start)[axes] < 0)
    play.run(70)
    coasts = speeds[-1] / drag
    assert np.linalg.norm((actor.place - goal)[:2]) < record["movesize"] + coasts
    assert [words[2] for _, words in play.printed(name)].count(0.0) == 1, "one more when it stands, and no other"


# ---- "Thrust Chamber": its script


@pytest.mark.parametrize("engine", Engine)
def test_thrust_chamber(smithdev: Experiment, engine: Engine) -> None:
    """`sd_thrust.cog` prints the thrust of who is in the well, by the flags that its switch gives the floor."""
    cell = smithdev.sector("thrust_chamber/cell")
    play = Play(smithdev, "thrust_chamber/room", engine=engine, aside=2 - 5 / 64)
    play.run(0.6, "walk forward")
    for _ in range(1000):
        # Gingerly, a frame at a time: the well is hardly wider than he is.
        play.run(0.02, "slow forward")
        play.run(0.02)
        while not play.seen[-1].attached and play.player.sector != cell:
            play.run(0.02)
        if play.player.sector == cell:
            break
    assert play.said == [] and play.player.sector == cell
    play.run(1)
    (ground,) = smithdev.surfaces("thrust_chamber/cell.floor")
    flags, read = RULES["flags"], {}
    kinds = ["floor", "no floor", "icy", "very_icy", "shallow_water", "deep_water", "very_deep_water"]
    for kind in kinds:
        if kind != "floor":
            play.press("switch")
        solid = 0x4 if kind == "no floor" else 0x5
        assert play.collision.surface_flags[ground] == solid | flags.get(kind, 0)
        if "deep" in kind and engine is Engine.RESEARCH:
            with pytest.raises(NotStatedError, match="illegible"):
                play.run(0.2, "walk right")
            continue
        # Who stands still does not notice; a body without a floor cannot jump, but moves as far as the well lets it.
        play.run(1.5, "jump")
        play.run(0.2, "walk right")
        assert play.seen[-1].attached is (kind != "no floor")
        assert play.player.sector == cell
        play.run(0.4, "walk left")
        read[kind] = play.printed("monitor")[-1][1]
    left = RULES["strafe_left"]["walk"]
    whole, cut = ["thrust", exactly(left), 0.0, 0.0], ["thrust", exactly(left * RULES["unattached_factor"]), 0.0, 0.0]
    expected = {"floor": whole, "no floor": cut, "icy": whole, "very_icy": whole, "shallow_water": whole}
    if engine is Engine.OPENJKDF2:
        halved = ["thrust", exactly(left * 0.5), 0.0, 0.0]
        expected |= {"deep_water": halved, "very_deep_water": halved}
    assert read == expected
    play.press("switch")
    assert play.collision.surface_flags[ground] == 0x5, "and from the beginning"
