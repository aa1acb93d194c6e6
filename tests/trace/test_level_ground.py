"""A body in a level: positions worked out by hand, the trajectories over floors given by numbers, real levels."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fixtures.rooms import Level as Builder
from fixtures.smithdev.pack import GOB, HANDLES
from jktools.cli import main
from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER
from jktools.engine.flags import SectorFlag
from jktools.engine.ground import SURFACES, Steps, Tread
from jktools.engine.profile import Engine
from jktools.engine.simulation import History, Phase, Simulation, simulate
from jktools.engine.thrust import Keys, Support
from jktools.geometry import points_outside
from jktools.geometry.collision import Collision
from jktools.geometry.plan import plan_of
from jktools.model import Level
from jktools.trace.in_level import LevelSimulation, start_at, trace_in_level
from jktools.trace.level_ground import LevelGround
from jktools.trace.script import parse
from jktools.trace.stage import Start, stage_of
from tests.support.hub import hub
from tests.support.levels import ROOT, corpus_files, level_of, two_rooms
from tests.support.terraces import rounded, terraces

R, HOVER = 0.065, 0.120114
HUB = level_of(hub().text())
ROOMS = level_of(two_rooms())
MIDDLE = Start((0.5, 0.5, 0.12), 0)
ALL_KEYS = "0 run forward\n2 run left\n3 jump\n4 run forward right\n6 run back\n7 jump\n8 run right\n10 end\n"


def ground(level: Level, x: float, y: float, z: float, sector: int = 0) -> LevelGround:
    return LevelGround(Collision(plan_of(level)), (x, y, z), sector)


def end(script: str, level: Level = ROOMS, start: Start = MIDDLE, *, fps: float = 50.0) -> list[float]:
    last: list[float] = trace_in_level(script, level, start, fps=fps).position[-1].tolist()
    return last


# ---- by hand, in the two rooms: x 0 .. 1, y 0 .. 1 and 1 .. 2, z 0 .. 1


def test_rests_at_its_hover_height() -> None:
    assert end("1 end") == pytest.approx([0.5, 0.5, HOVER], abs=1e-12)
    assert end("0 crouch\n2 end") == pytest.approx([0.5, 0.5, R], abs=1e-12)


@pytest.mark.parametrize(
    ("direction", "place"), [("right", (1 - R, 0.5)), ("left", (R, 0.5)), ("back", (0.5, R)), ("forward", (0.5, 2 - R))]
)
def test_walls_stop_at_movesize(direction: str, place: tuple[float, float]) -> None:
    assert end(f"0 run {direction}\n3 end")[:2] == pytest.approx(place, abs=1e-12)


def test_crossing_the_adjoin_changes_the_sector() -> None:
    feet = ground(ROOMS, 0.5, 0.5, 0.12)
    for y, sector in ((0.9, 0), (1.0, 0), (1.1, 1), (1.9, 1), (0.999, 0)):
        feet.move_to((0.5, y, 0.12))
        assert feet.sector == sector, y


def test_the_adjoin_passed_decides_between_overlapping_sectors() -> None:
    """Two rooms in the same place, one behind each half of a wall."""
    builder = Builder("halves")
    here = builder.room((0, 0, 0), (1, 1, 1))
    for left in (0, 0.5):
        there = builder.room((0, 1, 0), (1, 2, 1))
        builder.window(here, there, (left, 1, 0), (left + 0.5, 1, 1))
    level = level_of(builder.text())
    for x, sector in ((0.25, 1), (0.75, 2)):
        feet = ground(level, x, 0.9, 0.12)
        feet.move_to((x, 1.1, 0.12))
        assert feet.sector == sector


def test_the_ray_down_reaches_as_far_as_told() -> None:
    feet = ground(ROOMS, 0.5, 0.5, 0.5)
    assert feet.floor_below((0.5, 0.5, 0.5), 0.499, 0.0, 0x1) is None
    found = feet.floor_below((0.5, 0.5, 0.5), 0.5, 0.0, 0x1)
    assert found and found.point == (0.5, 0.5, 0.0) and found.normal == (0.0, 0.0, 1.0) and found.surface == 0x5


@pytest.mark.parametrize("flags", ["0x5", "0x4"])
def test_an_adjoin_without_movement_is_a_wall(flags: str) -> None:
    shut = level_of(two_rooms("World adjoins 2", f"0: {flags} 1 1", f"1: {flags} 0 1"))
    assert end("0 run forward\n3 end", shut)[1] == pytest.approx(1 - R, abs=1e-12)


def test_a_wall_without_the_collision_flag_is_none() -> None:
    ghostly = level_of(two_rooms("World surfaces 12", "5: 0 0x0 0x4 4 3 1 -1 0 4 1,0 5,1 6,2 2,3 1 1 1 1"))
    assert end("0 run right\n1 end", ghostly)[0] > 1 + R


def test_slides_along_a_wall() -> None:
    """What goes into the wall is lost, what goes along it is kept: y is that of a body without the wall."""
    free = end("0 run forward right\n1 end", terraces(Steps.flat().treads), Start((0, 0.5, 0.12), 0))
    x, y, z = end("0 run forward right\n1 end", start=Start((1 - R, 0.5, 0.12), 0))
    assert (x, y, z) == pytest.approx((1 - R, free[1], HOVER), abs=1e-12) and y > 0.9


def test_looks_where_its_thing_looks() -> None:
    turned = level_of(two_rooms("Section: THINGS", "0: walkplayer walkplayer .5 .5 .12 0 90 0 0"))
    assert start_at(turned, "0").yaw == 90
    assert end("0 run forward\n3 end", turned, start_at(turned, "0"))[:2] == pytest.approx([R, 0.5], abs=1e-9)


def test_a_launch_goes_where_the_thing_looks() -> None:
    """At 1 JKU/s with surfdrag 3, one frame of 0.02 s: 0.94 JKU/s left, 0.0188 JKU far."""
    turned = level_of(two_rooms("Section: THINGS", "0: walkplayer walkplayer .5 .5 .12 0 90 0 0"))
    moved = trace_in_level("0 velocity 0 1 0\n0.02 end", turned, start_at(turned, "0"))
    assert moved.velocity[-1] == pytest.approx([-0.94, 0, 0], abs=1e-12)
    assert moved.position[-1] == pytest.approx([0.5 - 0.0188, 0.5, HOVER], abs=1e-9)


def test_a_sector_with_thrust_lifts_who_jumped() -> None:
    """8 up against 4 down: after the jump the body never comes back; without the sector's flag it does."""
    script = "0 sector-thrust 0 0 8\n0.5 jump\n3 end"
    lifted = trace_in_level(script, level_of(two_rooms("Sector 0", "Flags 0x8")), MIDDLE)
    assert lifted.attached[:25].all() and (lifted.position[:25, 2] == lifted.position[0, 2]).all()
    assert lifted.position[-1, 2] == pytest.approx(1 - R, abs=1e-9)
    assert end(script)[2] == pytest.approx(HOVER, abs=1e-9)


def test_a_ceiling_stops_a_jump() -> None:
    weightless = level_of(two_rooms("Sector 0", "Flags 0x1"))
    assert end("0 jump\n3 end", weightless) == pytest.approx([0.5, 0.5, 1 - R], abs=1e-12)


def test_water_takes_the_floor_away() -> None:
    wet = level_of(two_rooms("Sector 1", "Flags 0x2"))
    body = LevelSimulation(stage_of(wet), MIDDLE, WALKPLAYER)
    body.rest_on_ground()
    assert body.support() is Support.SURFACE
    walk = simulate(body, [Phase(0, Keys(forward=1))], 2.0, 0.02)
    assert [i.event for i in walk.incidents] == [Event.DETACHES] and walk.position[-1, 1] > 1
    assert body.world.sector == SectorFlag.UNDERWATER and body.support() is Support.WATER


def test_starts_in_the_air_where_no_floor_is_near() -> None:
    drop = trace_in_level("3 end", ROOMS, Start((0.5, 0.5, 0.5), 0))
    assert not drop.attached[0] and drop.attached[-1]
    assert [i.event for i in drop.incidents] == [Event.ATTACHES]


def test_overlapping_sectors_are_told_apart() -> None:
    """A room in the same place that no adjoin leads into is not there, though its floor is higher."""
    builder = Builder("overlap")
    here, there = builder.room((0, 0, 0), (1, 1, 1)), builder.room((0, 1, 0), (1, 2, 1))
    builder.room((0, 1, 0.3), (1, 2, 1))
    builder.window(here, there, (0, 1, 0), (1, 1, 1))
    assert end("0 run forward\n3 end", level_of(builder.text())) == pytest.approx([0.5, 2 - R, HOVER], abs=1e-12)


# ---- from the hub east through the door (y 1.5 .. 2.5) over the pit (x 5 .. 7, 0.2 deep)


def test_the_hub_the_pit_room_and_the_pit() -> None:
    walk = trace_in_level("0 walk right\n12 end", HUB, start_at(HUB, "0"))
    assert [i.event for i in walk.incidents] == [Event.DETACHES, Event.ATTACHES]
    left, landed = (round(i.time / 0.02) for i in walk.incidents)
    assert walk.position[left - 1, 0] <= 5 < walk.position[left, 0]
    # It lands on its sphere, in a pit whose depth is a float32.
    assert walk.position[landed, 2] == pytest.approx(R - 0.2, abs=1e-7)
    assert walk.position[-1] == pytest.approx([7 - R, 2, HOVER - 0.2], abs=1e-7)


def test_the_example_of_the_docs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "walk.txt").write_text("0 walk forward\n3 end\n")
    start = json.loads(HANDLES.read_text("ascii"))["pit_rows"]["things"]["before 0.120114 0.2"]
    level = f"{GOB}!jkl/smithdev.jkl"
    assert main(["trace", "run", str(tmp_path / "walk.txt"), "--level", level, "--at", str(start)]) == 0
    said = capsys.readouterr().err.splitlines()
    page = (ROOT / "docs/engine.md").read_text("utf-8")
    assert f"smithdev.jkl --at {start} -o walk.csv" in page
    assert len(said) == 2 and "".join(f"    {line}\n" for line in said) in page


def test_on_an_edge_the_higher_floor_carries() -> None:
    feet = ground(HUB, 4.5, 2, 0.12, sector=2)
    for x, height in ((5.0, 0.0), (5.001, -0.2)):
        found = feet.floor_below((x, 2, 0.12), 1.0, 0.0, 0x1)
        assert found and found.point[2] == pytest.approx(height, abs=1e-7)


def test_beside_the_door_is_a_wall() -> None:
    assert end("0 run right\n6 end", HUB, Start((2, 2.6, 0.18), 0))[0] == pytest.approx(4 - R, abs=1e-12)


def test_glass_stops_and_is_no_floor() -> None:
    assert end("0 run left\n6 end", HUB, start_at(HUB, "0"))[0] == pytest.approx(R, abs=1e-12)


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize(
    ("depth", "events"),
    [(0.1, []), (0.185, []), (0.1852, [Event.DETACHES, Event.ATTACHES]), (0.2, [Event.DETACHES, Event.ATTACHES])],
)
def test_pits_beyond_the_reattach_distance_detach(engine: Engine, depth: float, events: list[Event]) -> None:
    """Insert offset 0.120114 and movesize 0.065 reattach up to 0.185114 (research document, "Descending")."""
    pit = terraces([Tread(-1, 0), Tread(0, -depth)])
    walk = trace_in_level("0 walk forward\n3 end", pit, Start((0, -0.5, 0.12), 0), engine=engine)
    assert [i.event for i in walk.incidents] == events
    assert walk.position[-1, 2] == pytest.approx(HOVER - depth, abs=1e-7)


# ---- the same shapes given by numbers


def both(steps: Steps, script: str, engine: Engine, fps: float, y: float) -> tuple[History, History]:
    """The trajectories over the level and over the numbers."""
    level = trace_in_level(script, terraces(steps.treads), Start((0, y, 0.12), 0), engine=engine, fps=fps)
    given_floor = Simulation(WALKPLAYER, steps, engine=engine, position=np.array((0, y, 0.12)))
    given_floor.rest_on_ground()
    read = parse(script)
    return level, simulate(given_floor, read.phases, read.seconds, 1 / fps)


def assert_same(level: History, numbers: History) -> None:
    assert np.abs(level.position - numbers.position).max() < 1e-6
    assert np.abs(level.velocity - numbers.velocity).max() < 1e-6
    assert (level.attached == numbers.attached).all()
    assert [(i.time, i.event) for i in level.incidents] == [(i.time, i.event) for i in numbers.incidents]


SHAPES = {
    "flat": Steps.flat(),
    "icy": Steps.flat(SURFACES["icy"]),
    "slope of water": Steps((Tread(-1, 0), Tread(0, 0, SURFACES["shallow-water"]))),
    "pit 0.25": rounded((-1, 0), (0, -0.25), (1, 0)),
    "pit 0.1": rounded((-1, 0), (0, -0.1), (1, 0)),
    "stairs down": rounded(*((i / 4, -0.05 * i) for i in range(8))),
    "stairs up": rounded(*((i / 4, 0.05 * i) for i in range(8))),
    "lip": rounded((-1, 0), (0.25, 0.08)),
    "wall": rounded((-1, 0), (0.25, 1)),
}
WALKS = {
    "walk": "0 walk forward\n2 release\n3 end",
    "run and leap": "0 run forward\n0.3 jump\n1.4 crouch\n2 stand\n2.2 jump\n3 run back\n4 end",
}


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize(("shape", "walk", "fps"), list(itertools.product(SHAPES, WALKS, (10.0, 50.0))))
def test_moves_as_over_floors_given_by_numbers(shape: str, walk: str, fps: float, engine: Engine) -> None:
    assert_same(*both(SHAPES[shape], WALKS[walk], engine, fps, -0.5))


ACTIONS = ["run forward", "run back", "walk forward", "walk back", "jump", "crouch", "stand", "release"]


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.tuples(st.integers(1, 8), st.sampled_from([-20, -8, -4, -2, 2, 3, 4, 8])), min_size=1, max_size=6),
    st.lists(st.sampled_from(ACTIONS), min_size=8, max_size=8),
    st.sampled_from(Engine),
    st.sampled_from([10.0, 30.0, 50.0]),
)
def test_moves_as_over_any_treads(rises: list[tuple[int, int]], actions: list[str], engine: Engine, fps: float) -> None:
    """Treads of eighths, rises of 64ths of a JKU, keys every half second."""
    starts = itertools.accumulate((width for width, _ in rises), initial=0)
    heights = itertools.accumulate((rise for _, rise in rises))
    treads = zip(starts, heights, strict=False)
    steps = rounded((-1, 0), *((start / 8, height / 64) for start, height in treads))
    script = "".join(f"{i / 2} {action}\n" for i, action in enumerate(actions))
    assert_same(*both(steps, f"{script}4 end", engine, fps, -0.5))


def test_the_level_of_treads_has_their_heights_to_the_last_bit() -> None:
    steps = rounded((-1, 0), (0, -77 / 64), (1, -12.046875), (2, 1 / 3))
    floors = terraces(steps.treads).vertices[:, 2]
    assert {float(np.float32(round(tread.height, 6))) for tread in steps.treads} <= set(floors.tolist())
    assert -77 / 64 in floors.tolist() and -12.046875 in floors.tolist()


def test_moves_as_over_a_flight_that_ends_in_a_rise() -> None:
    """Four treads of 1/8 JKU, each 20/64 below the last, then one 3/64 up, at 10 frames a second."""
    heights = (-20, -40, -60, -80, -77)
    steps = rounded((-1, 0), *((i / 8, height / 64) for i, height in enumerate(heights)))
    assert_same(*both(steps, "0 run forward\n4 end", Engine.RESEARCH, 10.0, -0.5))


# ---- never through a wall


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.floats(-300, 300), min_size=3, max_size=3),
    st.sampled_from([1.0, 10.0, 50.0]),
    st.sampled_from(["run forward", "run right back", "crouch"]),
)
def test_never_leaves_the_rooms(velocity: list[float], fps: float, keys: str) -> None:
    body = LevelSimulation(stage_of(ROOMS), Start((0.4, 0.6, 0.5), 0), WALKPLAYER)
    body.velocity = np.array(velocity)
    path = simulate(body, parse(f"0 {keys}\n2 end").phases, 20 / fps, 1 / fps).position
    assert (path >= R - 1e-9).all() and (path <= np.array([1, 2, 1]) - R + 1e-9).all()


@pytest.mark.parametrize("direction", ["forward", "back", "left", "right", "forward left", "back right"])
def test_a_run_at_10_frames_a_second_stays_inside(direction: str) -> None:
    path = trace_in_level(f"0 run {direction}\n5 end", ROOMS, MIDDLE, fps=10).position
    assert np.ptp(path, axis=0).max() > 0.4
    assert (path >= R - 1e-9).all() and (path <= np.array([1, 2, 1]) - R + 1e-9).all()


# ---- what cannot start


@pytest.mark.parametrize("script", ["floor 0 1\n1 end", "0 surface icy\n1 end"])
def test_a_script_brings_no_floors(script: str) -> None:
    with pytest.raises(ValueError, match="the level has its own"):
        trace_in_level(script, ROOMS, MIDDLE)


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("9", "no thing 9"),
        ("x", "neither a thing's number nor"),
        ("1,2,0", "neither a thing's number nor"),
        ("nan,0,0,0", "neither a thing's number nor"),
        ("0,0,0,2", "sector 2 is none of the level's 2"),
    ],
)
def test_a_start_outside_the_level_is_refused(place: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        start_at(ROOMS, place)


# ---- real levels


@pytest.mark.parametrize("name", ["lagoon.jkl", "azulcity.jkl", "hell.jkl"])
@pytest.mark.parametrize("engine", Engine)
def test_ten_seconds_in_a_real_level(corpus: object, name: str, engine: Engine) -> None:
    """From the player's start, never NaN, and never more than movesize outside every sector."""
    level = next(level_of(data, path) for path, data in corpus_files() if path.endswith(name))
    player = next(thing for thing in level.things if thing.template_name.lower() == "walkplayer")
    walk = trace_in_level(ALL_KEYS, level, start_at(level, str(player.number)), engine=engine)
    assert np.isfinite(walk.position).all() and np.ptp(walk.position[:, :2], axis=0).max() > 1
    sound = np.flatnonzero(level.sound_sectors)
    for place in walk.position[::5]:
        assert points_outside(level, np.repeat(place[None], len(sound), axis=0), sound).distance.min() <= R
