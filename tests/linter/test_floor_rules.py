"""Basins and stairs beyond the examples of their rules: what lets a body out, and what takes it down."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from fixtures.rooms import Level as Builder
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.basins import Entry, Way
from jktools.facts.ledges import Kind
from jktools.linter import find_rule, lint
from jktools.model import Level
from tests.support.levels import level_of, two_rooms

PIT = find_rule("JK701").bad[0].lines
"""Room 1 lies 0.6 JKU below room 0, where the player starts."""


def pit(*more: str) -> Level:
    return level_of(two_rooms(*PIT, *more))


def left(level: Level) -> Way:
    facts = LevelFacts(level)
    (basin,) = facts.basins(facts.bodies[0])
    assert basin.surfaces == (6,)
    return basin.left


def test_a_pit_deeper_than_a_jump_is_inescapable() -> None:
    facts = LevelFacts(pit())
    (basin,) = facts.basins(facts.bodies[0])
    assert (basin.entered, basin.left, basin.is_inescapable) == (Entry.FALL, Way(0), True)
    assert (basin.shallowest, basin.deepest) == pytest.approx((0.6, 0.6))


@pytest.mark.parametrize(
    ("flags", "way"),
    [("0x2", Way.WATER), ("0x40", Way.DEADLY), ("0x8", Way.UNKNOWN), ("0x1", Way.UNKNOWN), ("0x10", Way(0))],
)
def test_sector_flags_that_let_out(flags: str, way: Way) -> None:
    level = pit("Sector 1", f"Flags {flags}")
    facts = LevelFacts(level)
    found = facts.basins(facts.bodies[0])
    if flags == "0x2":
        assert found == ()  # the way down is a way into the water
    else:
        assert left(level) == way


def test_a_lift_in_the_pit_may_help() -> None:
    lift = "2: lift crate .5 1.5 -.5 0 0 0 1 type=cog collide=3 thingflags=0x40 size=.3"
    assert left(pit("World things 3", lift)) & Way.MOVER


def test_a_script_that_names_the_sector_may_help() -> None:
    assert left(pit("World cogs 1", "0: door.cog 1 -1 wind.wav")) & Way.UNKNOWN


def test_a_start_in_the_pit_is_no_trap() -> None:
    facts = LevelFacts(pit("World things 3", "2: walkplayer walkplayer .5 1.5 -.4 0 0 0 1"))
    (basin,) = facts.basins(facts.bodies[0])
    assert basin.entered & Entry.START
    assert not basin.is_inescapable


def test_a_fall_that_kills_is_no_trap() -> None:
    assert left(level_of(two_rooms(*(line.replace("-.6", "-5") for line in PIT)))) == Way.DEADLY


def test_a_deadly_drop_is_where_the_simulated_landing_costs_a_hundred_points() -> None:
    """Without drag: (sqrt(2 g h) - 2.5)^2 * 45 = 100, so h = (2.5 + sqrt(100 / 45))^2 / (2 * 4)."""
    walker = LevelFacts(pit()).bodies[0]
    assert walker.deadly_drop() == pytest.approx((2.5 + np.sqrt(100 / 45)) ** 2 / 8, abs=2e-4)


def test_a_long_tread_between_steps_is_no_stair_that_makes_fall() -> None:
    rule = find_rule("JK702")
    assert [d.code.id for d in lint(level_of(two_rooms(*rule.bad[0].lines)), [rule])] == ["JK702"]
    longer = [line.replace(" 1.1 ", " 1.7 ") for line in rule.bad[0].lines]
    assert lint(level_of(two_rooms(*longer)), [rule]) == []


def test_the_message_names_both_sides() -> None:
    (found,) = lint(pit(), [find_rule("JK701")])  # the jump: 1.5^2 / 8, and 0.055 below the sphere
    assert found.message == (
        "surface 6 (sector 1, surface 0) lies 0.6 JKU below the floors that lead in, but a jump takes walkplayer up "
        "0.3362 JKU"
    )
    uneven = [line.replace("13: 1 1 -.6", "13: 1 1 -.7") for line in PIT]
    (found,) = lint(level_of(two_rooms(*uneven)), [find_rule("JK701")])
    assert " lies 0.6 to 0.7 JKU below " in found.message


PLAYER = "walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5"


@pytest.mark.parametrize(("flags", "way"), [(0, Way(0)), (0x1, Way.UNKNOWN), (0x8, Way.UNKNOWN), (0x40, Way.DEADLY)])
def test_what_the_sector_does_that_lies_over_the_floor(flags: int, way: Way) -> None:
    """A shaft of two sectors, 1 JKU deep; the upper one lifts or kills."""
    builder = Builder("shaft")
    builder.room((0, 0, 0), (2, 2, 4))
    builder.room((0, 2, -0.5), (2, 4, 4), flags=flags)
    builder.room((0, 2, -1), (2, 4, -0.5))
    builder.window(0, 1, (0, 2, 0), (2, 2, 4))
    builder.window(1, 2, (0, 2, -0.5), (2, 4, -0.5))
    builder.templates.append(PLAYER)
    facts = LevelFacts(level_of(builder.text()))
    (basin,) = facts.basins(facts.bodies[0])
    assert basin.left == way


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize(("gap", "basins"), [(0.05, 0), (0.125, 0), (0.15, 1)])
def test_a_gap_that_no_body_fits_in_is_no_basin(engine: Engine, gap: float, basins: int) -> None:
    """The player is 0.13 JKU wide; the decompiled engine holds it on to the far side."""
    builder = Builder("gap")
    for start, end, z in ((0.0, 2.0, 0.0), (2.0, 2 + gap, -1.0), (2 + gap, 4.0, 0.0)):
        builder.room((0, start, z), (2, end, 4))
    builder.window(0, 1, (0, 2, 0), (2, 2, 4))
    builder.window(1, 2, (0, 2 + gap, 0), (2, 2 + gap, 4))
    builder.templates.append(PLAYER)
    facts = LevelFacts(level_of(builder.text()))
    assert len(facts.basins(facts.bodies[0], engine)) == basins


WALKS = PLAYER + " maxthrust=2 surfdrag=3"


@pytest.mark.parametrize(("off", "told"), [(-1e-3, 0), (1e-3, 1)])
def test_what_is_higher_than_the_lip_that_is_climbed_needs_a_jump(off: float, told: int) -> None:
    """Two floors in one hall, one higher than the other by as much as the simulated body climbs, and a little."""

    def hall(rise: float) -> Level:
        builder = Builder("step")
        builder.room((0, 0, 0), (2, 2, 4))
        builder.room((0, 2, rise), (2, 4, 4))
        builder.window(0, 1, (0, 2, rise), (2, 2, 4))
        builder.templates.append(WALKS)
        return level_of(builder.text())

    (walker,) = [each for each in LevelFacts(hall(1)).bodies if each.body.maxthrust]
    lip = walker.lip(Engine.RESEARCH)
    assert walker.clearance(Engine.RESEARCH) < lip + off < walker.hover(Engine.RESEARCH)
    found = lint(hall(round(lip + off, 6)), [find_rule("JK704")])
    assert len(found) == told
    assert all(f"walkplayer surely walks up no more than {lip:.4g} JKU" in each.message for each in found)


@pytest.mark.parametrize(("gravity", "basins"), [("4", 1), ("0", 0), ("-1", 0)])
def test_no_basin_holds_what_floats(gravity: str, basins: int) -> None:
    facts = LevelFacts(level_of(two_rooms(*PIT).replace("World Gravity 4", f"World Gravity {gravity}")))
    (walker,) = facts.bodies
    assert walker.gravity == float(gravity)
    assert len(facts.basins(walker)) == basins
    assert len(lint(facts.level, [find_rule("JK701")])) == basins
    kinds = {Kind(kind) for kind in facts.ledges(walker).kind.tolist()}
    assert (kinds <= {Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.LIP, Kind.UNKNOWN}) is (basins == 0)


@pytest.mark.parametrize(("gravity", "airdrag", "apex"), [
    (-1.0, 0.5, np.inf), (0.0, 0.0, np.inf), (0.0, 0.5, 1.5 / 0.5), (1e-9, 0.5, 1.5 / 0.5), (4.0, 0.0, 1.5**2 / 8),
])  # fmt: skip
def test_how_high_a_jump_goes_where_little_takes_it_down(gravity: float, airdrag: float, apex: float) -> None:
    (walker,) = LevelFacts(pit()).bodies
    body = replace(walker.body, airdrag=airdrag)
    assert replace(walker, gravity=gravity, body=body).apex() == pytest.approx(apex, rel=1e-6)
    assert replace(walker, gravity=gravity, body=replace(body, jumpspeed=0.0)).apex() == 0


def trench(*sections: tuple[float, float, float], high: float = 4) -> Level:
    """Rooms side by side along y, each 4 JKU wide from y to y with its floor at z, open to each other above both."""
    builder = Builder("trench")
    for start, end, z in sections:
        builder.room((0, start, z), (4, end, high))
    for index, ((_, end, z), (_, _, after)) in enumerate(pairwise(sections)):
        builder.window(index, index + 1, (0, end, max(z, after)), (4, end, high))
    builder.templates.append(WALKS)
    return level_of(builder.text())


def basins(level: Level) -> list[tuple[tuple[int, ...], Way]]:
    facts = LevelFacts(level)
    z = {i: float(level.surfaces[i].positions[0, 2]) for i in range(len(level.surfaces))}
    return [(tuple(round(z[i], 3) for i in b.surfaces), b.left) for b in facts.basins(facts.bodies[0])]  # type: ignore[misc]


def test_a_slot_that_no_body_fits_in_hides_no_basin() -> None:
    """The player is 0.13 JKU wide; the slot cuts the pit's floor in two, which are one basin still."""
    assert basins(trench((0, 2, 0), (2, 3, -1), (3, 3.1, -3), (3.1, 4, -1))) == [((-1, -1), Way(0))]
    # Beyond the slot lies what lets out: a step, from which a way leads down, and a lip.
    for rise, way in ((0.05, []), (0.07, [((-1.0,), Way.WALK)])):
        found = basins(trench((0, 2, 0), (2, 3, -1), (3, 3.1, -3), (3.1, 4, -1 + rise), (4, 5, -2)))
        assert [each for each in found if each[0][0] != -2] == way
    # A body fits into a wider one, and is caught there.
    assert basins(trench((0, 2, 0), (2, 3, -1), (3, 3.2, -2), (3.2, 4, -1))) == [((-2.0,), Way(0))]


@pytest.mark.parametrize(("length", "told"), [(5.9, 1), (6.1, 0)])
def test_what_holds_most_of_the_floor_is_where_the_level_goes_on(length: float, told: int) -> None:
    level = trench((0, 2, 0), (2, 2 + length, -1))
    facts = LevelFacts(level)
    (basin,) = facts.basins(facts.bodies[0])
    assert basin.share == pytest.approx(length / (2 + length))
    assert basin.is_inescapable
    assert len(lint(level, [find_rule("JK701")])) == told


def test_a_slot_without_a_floor_hides_no_basin_either() -> None:
    builder = Builder("slot")
    for start, end, z, flags in ((0.0, 2.0, 0, 5), (2.0, 3.0, -1, 5), (3.0, 3.1, -3, 4), (3.1, 4.0, -1, 5)):
        builder.room((0, start, z), (4, end, 4), floor_flags=flags)
    builder.window(0, 1, (0, 2, 0), (4, 2, 4))
    builder.window(1, 2, (0, 3, -1), (4, 3, 4))
    builder.window(2, 3, (0, 3.1, -1), (4, 3.1, 4))
    builder.templates.append(WALKS)
    assert basins(level_of(builder.text())) == [((-1, -1), Way(0))]
