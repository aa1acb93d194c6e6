"""Document, "Drag Coefficients": the players of its tables in the lanes of the Velocity Hallway."""

from __future__ import annotations

import math

import numpy as np
import pytest

from jktools.cli import main
from jktools.trace.recording import read
from tests.experiments.conftest import Compile
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, HANDLE, Experiment
from tests.experiments.tracing import Run

ENGINES = ("research", "openjkdf2")
FLOOR, NO_FLOOR = "velocity_hallway/start of floor", "velocity_hallway/start of no floor"
FRAME = 0.02


def player(smithdev: Experiment, name: str, **drags: float) -> str:
    """A template's name, once its compiled record is known to have the drags of the document's table."""
    record = smithdev.template(name)
    expected = {key: GOLDEN["walkplayer"][key] for key in ("surfdrag", "airdrag", "staticdrag")} | drags
    assert {key: record[key] for key in expected} == pytest.approx(expected, rel=1e-6), name
    return name


def changes(speed: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
    return np.diff(speed).tolist()


# ---- "Baseline"


@pytest.mark.parametrize("engine", ENGINES)
def test_baseline(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 1: thrust 2, the speed nears 0.65 ever slower; then it falls to about 0.3 and to 0 from there."""
    measured = GOLDEN["steady_speed"]["walk_floor"]
    level = compiled("--engine", engine)
    name = player(level, "walkplayer")
    assert level.template(name)["surfdrag"] == measured["drag"]
    walk = trace("0 walk forward\n7 release\n9 end", FLOOR, "--body", name, "--engine", engine)
    assert walk.attached.all() and walk.said == []
    assert np.linalg.norm(walk.thrust[1:351], axis=1).tolist() == pytest.approx([measured["thrust"]] * 350)
    assert walk.speed[350] == pytest.approx(measured["speed"], abs=measured["tolerance"])
    assert level.motion(name)["walk"] == pytest.approx(measured["speed"], abs=measured["tolerance"])
    assert level.motion(name)["walk"] == pytest.approx(walk.speed[350], rel=1e-6)
    gains = changes(walk.speed[:100])
    assert gains == sorted(gains, reverse=True) and gains[-1] > 0
    last = int(np.flatnonzero(walk.speed)[-1])
    assert walk.speed[last] <= GOLDEN["walkplayer"]["staticdrag"] < walk.speed[last - 1]


# ---- "No drag"


@pytest.mark.parametrize("engine", ENGINES)
def test_no_drag(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 2: a linear gain under thrust, kept without it, and no limit."""
    rules = GOLDEN["no_drag"]
    level = compiled("--engine", engine)
    name = player(level, "vel_no_drag", surfdrag=0, airdrag=0, staticdrag=0)
    script = "0 walk forward\n1 release\n3 walk forward\n5 end"
    walk = trace(script, FLOOR, "--body", name, "--engine", engine)
    assert rules["growth"] == "linear under thrust"
    assert changes(walk.speed[:51]) == pytest.approx([2 * FRAME] * 50)
    assert changes(walk.speed[151:]) == pytest.approx([2 * FRAME] * 99)
    assert rules["kept_without_thrust"] is bool((walk.speed[50:151] == walk.speed[50]).all())
    assert rules["limit"] == "none" and math.isinf(level.motion(name)["walk"])


# ---- "Non-floor surface"


@pytest.mark.parametrize("engine", ENGINES)
def test_non_floor_surface(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 3: thrust 0.6, and yet a peak of 1.2, far above the walk's 0.65."""
    measured = GOLDEN["steady_speed"]["walk_non_floor"]
    level = compiled("--engine", engine)
    name = player(level, "walkplayer")
    assert level.template(name)["airdrag"] == measured["drag"]
    slide = trace("0 walk forward\n15 end", NO_FLOOR, "--body", name, "--engine", engine)
    assert not slide.attached.any()
    assert slide.thrust[-1, 1] == pytest.approx(measured["thrust"])
    assert slide.speed[-1] == pytest.approx(measured["speed"], abs=measured["tolerance"])
    assert level.motion(name)["air"] == pytest.approx(measured["speed"], abs=measured["tolerance"])
    # Sunken in to the sphere: no insert offset without a floor.
    assert slide.position[-1, 2] == pytest.approx(GOLDEN["walkplayer"]["movesize"], abs=1e-6)


# ---- "Airdrag"


@pytest.mark.parametrize("engine", ENGINES)
def test_airdrag(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 4: with air drag alone it acts where there is no floor, and nothing acts on a floor."""
    assert GOLDEN["only_airdrag"] == {"non_floor": "air drag acts", "floor": "no drag at all"}
    name = player(compiled("--engine", engine), "vel_only_air", surfdrag=0, staticdrag=0)
    script = "0 walk forward\n3 release\n5 end"
    slide = trace(script, NO_FLOOR, "--body", name, "--engine", engine)
    gains = changes(slide.speed[:150])
    assert gains == sorted(gains, reverse=True) and gains[0] == pytest.approx(0.6 * FRAME)
    kept = slide.speed[152:] / slide.speed[151:-1]
    assert kept.tolist() == pytest.approx([1 - 0.5 * FRAME] * len(kept))
    walk = trace(script, FLOOR, "--body", name, "--engine", engine)
    assert changes(walk.speed[:151]) == pytest.approx([2 * FRAME] * 150)
    assert (walk.speed[151:] == walk.speed[150]).all()


# ---- "Staticdrag on normal surface"


@pytest.mark.parametrize("engine", ENGINES)
def test_staticdrag_on_normal_surface(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 5: an 'infinite' static drag changes nothing while thrust acts, and stops at once without it."""
    level = compiled("--engine", engine)
    name = player(level, "vel_infinite_static", staticdrag=GOLDEN["static_drag"]["infinite"])
    script = "0 walk forward\n2 release\n3 run forward\n5 release\n6 end"
    walk = trace(script, FLOOR, "--body", name, "--engine", engine)
    usual = trace(script, FLOOR, "--body", "walkplayer", "--engine", engine)
    assert (walk.speed[:101] == usual.speed[:101]).all() and walk.speed[100] > 0.6
    assert not walk.speed[101:151].any() and not walk.speed[251:].any()
    assert walk.speed[250] > 1.3 and walk.thrust[250, 1] == pytest.approx(4)
    assert level.motion(name)["stop_walk"] == level.motion(name)["stop_run"] == [0, 0]


# ---- "Staticdrag on non-floor surface"


@pytest.mark.parametrize("engine", ENGINES)
def test_staticdrag_on_non_floor_surface(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 6: no stop when the thrust ends, only air drag."""
    name = player(compiled("--engine", engine), "vel_infinite_static", staticdrag=999)
    slide = trace("0 walk forward\n5 release\n15 end", NO_FLOOR, "--body", name, "--engine", engine)
    kept = slide.speed[252:] / slide.speed[251:-1]
    assert kept.tolist() == pytest.approx([1 - 0.5 * FRAME] * len(kept))
    assert bool(slide.speed[-1] == 0) is GOLDEN["static_drag"]["applies_on_non_floor"]


# ---- "No staticdrag"


@pytest.mark.parametrize("engine", ENGINES)
def test_no_staticdrag(compiled: Compile, trace: Run, engine: str) -> None:
    """Drawing 7: the speed nears 0 slowly, without the step from 0.3."""
    name = player(compiled("--engine", engine), "vel_no_static", staticdrag=0)
    walk = trace("0 walk forward\n3 release\n5 end", FLOOR, "--body", name, "--engine", engine)
    kept = walk.speed[152:] / walk.speed[151:-1]
    assert kept.tolist() == pytest.approx([1 - 3 * FRAME] * len(kept))
    assert 0 < walk.speed[-1] < 0.01


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("lane", ["icy", "very icy"])
def test_no_staticdrag_is_like_ice(trace: Run, lane: str, engine: str) -> None:
    """'This seems to emulate the effect of the Icy / VeryIcy surface flags': the player slides on below 0.3."""
    start = f"velocity_hallway/start of {lane}"
    walk = trace("0 walk forward\n1 release\n5 end", start, "--body", "walkplayer", "--engine", engine)
    assert walk.attached.all()
    on_a_floor = trace("0 walk forward\n1 release\n5 end", FLOOR, "--body", "walkplayer", "--engine", engine)
    sliding, stopping = (float(np.min(each.speed[51:][each.speed[51:] > 0])) for each in (walk, on_a_floor))
    assert stopping > 0.28 and sliding < 0.1


# ---- "Static Drag"


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("name", "threshold"),
    [*zip(("vel_half_static", "walkplayer", "vel_double_static"), GOLDEN["static_drag"]["thresholds"], strict=True)],
)
def test_static_drag(compiled: Compile, trace: Run, name: str, threshold: float, engine: str) -> None:
    """Drawings 8 to 10: the drop to 0 is instant, from the first speed at or below the threshold."""
    assert GOLDEN["static_drag"]["applies_when"] == "attached to a surface, no acceleration, speed <= staticdrag"
    level = compiled("--engine", engine)
    player(level, name, staticdrag=threshold)
    walk = trace("0 run forward\n7 release\n9 end", FLOOR, "--body", name, "--engine", engine)
    last = int(np.flatnonzero(walk.speed)[-1])
    assert walk.speed[last] <= threshold < walk.speed[last - 1]
    assert walk.speed[350] > 1.3
    # The way that the compiled file says it takes to rest from a run.
    way = float(walk.ahead[-1] - walk.ahead[350])
    assert level.motion(name)["stop_run"] == pytest.approx([way, way], abs=1e-6)


# ---- "Dynamic Drag"

DECAYS = {3.0: "vel_no_static", 1.5: "vel_half_drag", 6.0: "vel_double_drag", 0.375: "vel_eighth_drag"}


@pytest.mark.parametrize("row", GOLDEN["dynamic_drag"]["decay_time"], ids=lambda row: str(row["surfdrag"]))
def test_dynamic_drag_raw_data(smithdev: Experiment, trace: Run, row: dict[str, float]) -> None:
    """Table 12: from a speed of 1, set as the hallway's script sets it, to 0, at the document's own frame time."""
    fit = GOLDEN["dynamic_drag"]["fit"]
    name = player(smithdev, DECAYS[row["surfdrag"]], surfdrag=row["surfdrag"], staticdrag=0)
    frame = fit["frame_seconds"]
    script = f"0 velocity 0 1 0\n{row['seconds'] * 1.2} end"
    slowing = trace(script, FLOOR, "--body", name, "--fps", str(1 / frame))
    frames = int(np.flatnonzero(slowing.speed)[-1]) + 1
    # What is left of the speed before it shows as 0.
    slowest = float(slowing.speed[frames - 1])
    assert slowest >= fit["rest_speed"] > slowest * (1 - row["surfdrag"] * frame)
    taken = (frames - fit["frames_lost"]) * frame
    assert taken == pytest.approx(row["seconds"], rel=fit["max_relative_error"])


def test_dynamic_drag_summary(smithdev: Experiment, trace: Run, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Tables 13 and 14: one frame takes 0.869554 to 0.814772; and a fit of the trace finds the coefficient."""
    row, frame = GOLDEN["dynamic_drag"]["single_step"], GOLDEN["dynamic_drag"]["fit"]["frame_seconds"]
    name = player(smithdev, "vel_no_static", staticdrag=0)
    step = trace(f"0 velocity 0 {row['v0']} 0\n{frame} end", FLOOR, "--body", name, "--fps", str(1 / frame))
    assert step.speed[-1] == pytest.approx(row["v1"], abs=5e-7)
    # Table 14 to its last digit, by the frame time that it gives; Table 13's two quotients by the timestamps.
    lost = float(step.speed[-1]) - row["v0"]
    assert (lost, lost / frame) == pytest.approx((row["dv"], row["acceleration"]), rel=1e-7)
    assert row["t1"] - row["t0"] == pytest.approx(frame, abs=2e-6)
    quotients = [lost / (row["t1"] - row["t0"]) / v for v in (row["v0"], float(step.speed[-1]))]
    assert quotients == pytest.approx([row["coefficient_from_v0"], row["coefficient_from_v1"]], abs=2e-3)
    folder = tmp_path_factory.mktemp("fit")
    (folder / "keys.txt").write_text("0 velocity 0 1 0\n2 end\n")
    log = folder / "log.csv"
    start = str(HANDLE["velocity_hallway"]["things"]["start of floor"])
    words = ["--level", str(smithdev.path), "--at", start, "--body", name, "-o", str(log)]
    assert main(["trace", "run", str(folder / "keys.txt"), *words]) == 0
    recorded = read(log)
    moving = recorded.velocity[1:]
    slopes = np.diff(moving[:, 1]) / FRAME / moving[:-1, 1]
    assert slopes.tolist() == pytest.approx([-3.0] * len(slopes), rel=1e-6)
    assert round(row["coefficient_from_v0"]) == -3


# ---- "Velocity Hallway": its script

DOOR, HALL = "velocity_hallway/door", "velocity_hallway/hall"
ON_SHALLOW_WATER = -0.25
"""JKU beside the door's middle: before it lie the lanes of shallow and of deep water."""


def test_velocity_hallway(smithdev: Experiment) -> None:
    """`velocityresearch.cog`: time, thrust and velocity 'on a continuous basis while the player is in it'."""
    play = Play(smithdev, DOOR, aside=ON_SHALLOW_WATER)
    entered = play.run_until(HALL, "walk forward").time
    play.run(1, "walk forward")
    play.run(0.5)
    assert play.player.sector == smithdev.sector(HALL)
    printed = play.printed("research")
    assert [time for time, _ in printed] == pytest.approx([entered + 0.1 * i for i in range(1, 16)])
    at = {moment.time: moment for moment in play.seen}
    for time, words in printed:
        thrust, speed = (float(np.linalg.norm(vector)) for vector in (at[time].thrust, at[time].velocity))
        assert words[0] == "time, thrust, velocity"
        assert words[1:] == pytest.approx([time, thrust, speed], rel=1e-6)
    thrusts = [words[2] for _, words in printed]
    assert thrusts == [GOLDEN["steady_speed"]["walk_floor"]["thrust"]] * 10 + [0.0] * 5
    play.run_until(DOOR, "walk back")
    before = len(play.said)
    play.run(1)
    assert len(play.said) == before, "he has left the hall"


def test_the_lanes_beside_the_hall_print_too(smithdev: Experiment) -> None:
    """Lanes that are sectors of their own: who changes them is read on without a gap."""
    play = Play(smithdev, "velocity_hallway/start of no gravity")
    first = play.run_until("velocity_hallway/thrust", "walk right").time
    second = play.run_until("velocity_hallway/no gravity", "walk left").time
    play.run(0.5)
    times = [time for time, _ in play.printed("research")]
    assert times[0] == pytest.approx(first + 0.1)
    assert [time for time in times if time > second] == pytest.approx([second + 0.1 * i for i in range(1, 6)])
    assert max(np.diff(times)) < 0.2


@pytest.mark.parametrize("row", GOLDEN["dynamic_drag"]["decay_time"], ids=lambda row: str(row["surfdrag"]))
def test_the_script_sends_off_at_the_speed_of_the_tables(smithdev: Experiment, row: dict[str, float]) -> None:
    """'Will assign a velocity value directly on the player upon entering the sector': Table 12 once more.

    The switch turns it on. He enters over shallow water, which leaves thrust and drag alone.
    """
    fit = GOLDEN["dynamic_drag"]["fit"]
    frame = round(fit["frame_seconds"] * 1000)
    play = Play(smithdev, DOOR, body=DECAYS[row["surfdrag"]], aside=ON_SHALLOW_WATER, frame=frame)
    play.press("switch")
    assert play.printed("research") == [(0, ["sending off", 1])]
    sent = play.run_until(HALL, "walk forward")
    assert sent.velocity.tolist() == pytest.approx(smithdev.look("velocity_hallway/start of floor"), abs=1e-6)
    slowing = play.run(row["seconds"] * 1.2)
    frames = 1 + sum(bool(moment.velocity.any()) for moment in slowing)
    taken = (frames - fit["frames_lost"]) * fit["frame_seconds"]
    assert taken == pytest.approx(row["seconds"], rel=fit["max_relative_error"])
    assert slowing[-1].place[1] < play.seen[0].place[1] + 12 and not slowing[-1].velocity.any()


def test_the_switch_ends_the_sending(smithdev: Experiment) -> None:
    play = Play(smithdev, DOOR, aside=ON_SHALLOW_WATER)
    play.press("switch")
    play.press("switch")
    assert [words for _, words in play.printed("research")] == [["sending off", 1, "sending off", 0]]
    entered = play.run_until(HALL, "walk forward")
    assert np.linalg.norm(entered.velocity) < 0.65
