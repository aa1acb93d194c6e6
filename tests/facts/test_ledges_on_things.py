"""Ledges that lead onto things, past them and from them, where they are placed and at their frames."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from benchmarks.ledge_disagreement import GAIT, Twin, compare, scenes
from benchmarks.ledge_tiers import differing
from jktools.compiler import CompiledLevel, compile_level
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.basins import Way
from jktools.facts.floors import PLACED
from jktools.facts.ledges import Kind, Ledges
from jktools.geometry import Ending
from jktools.geometry.ledges import BEYOND, EdgeWalker, Over
from jktools.linter import find_rule
from jktools.model import Level
from jktools.session import load
from tests.support.boxes import box, boxes
from tests.support.levels import CORPUS, level_with_files

PIT = find_rule("JK701").bad[0].lines
"""Room 1, from y = 1 to 2, lies 0.6 JKU below room 0; the player hovers at 0.12 and takes 0.185 without a fall."""
KIND = "lift none type=cog collide=3 size=.6 thingflags=0x40 model3d=box.3do"
FLAT = (0.4, 0.4, 0.125)
"""Half the sizes of the box."""
FRAMES = " move=path numframes=2 frame=(.5/1.4/{a}:0/0/0) frame=(.5/1.4/{b}:0/0/0)"


@contextmanager
def with_box(
    place: str,
    size: tuple[float, float, float] = FLAT,
    more: str = "",
    kind: str = KIND,
    name: str = "box",
    model: Sequence[str] = (),
) -> Iterator[Level]:
    """The pit, and a box, or another model, placed at x y z pitch yaw roll."""
    files = [f"== 3do/{name}.3do", *(model or box(*size))]
    lines = [*PIT, kind, "World things 3", f"2: lift crate {place} 1{more}"]
    lines = ["World templates 4" if line == "World templates 3" else line for line in lines]
    lines = [line + " maxthrust=2 surfdrag=3 maxvel=1" if line.startswith("walkplayer") else line for line in lines]
    with level_with_files(*lines, *files) as level:
        yield level


def brink(found: Ledges) -> list[tuple[float, float, Kind]]:
    """The edge of room 0 over the pit, from x = 0 to 1: intervals and their kinds."""
    rows = np.flatnonzero((found.surface == 0) & (found.corner == 2))[::-1]
    ends = [(1 - found.end[row], 1 - found.start[row], Kind(found.kind[row])) for row in rows]
    return [(round(float(a), 4), round(float(b), 4), kind) for a, b, kind in ends]


def ledges(level: Level, accuracy: str = "balanced") -> Ledges:
    facts = LevelFacts(level)
    return facts.ledges(facts.bodies[0], accuracy=accuracy)


@pytest.mark.parametrize(
    ("height", "kind"),
    [
        (0.0, Kind.LEVEL), (-0.1, Kind.SEAMLESS), (-0.3, Kind.FALL), (0.05, Kind.STEP), (0.065, Kind.LIP),
        (0.1, Kind.JUMP), (0.3, Kind.JUMP), (0.5, Kind.WALL),
    ],
)  # fmt: skip
@pytest.mark.parametrize("accuracy", ["balanced", "exact"])
def test_a_box_beyond_the_edge_is_what_its_top_is(height: float, kind: Kind, accuracy: str) -> None:
    """Half a box high above its place; deep enough that nobody passes beneath it."""
    with with_box(f".5 1.4 {height - 0.5} 0 0 0", (0.4, 0.4, 0.5)) as level:
        found = ledges(level, accuracy)
    assert brink(found) == [(0, 0.1, Kind.FALL), (0.1, 0.9, kind), (0.9, 1, Kind.FALL)]
    row = np.flatnonzero((found.surface == 0) & (found.corner == 2))[1]
    assert (found.onto[row], found.onto_face[row]) == (2, 0 if kind is not Kind.WALL else 5)
    assert found.below[row] == -1
    if kind not in (Kind.WALL, Kind.JUMP):
        assert found.drop_start[row] == pytest.approx(-height, abs=1e-6)


def test_beneath_a_high_box_the_pit_is_what_it_was() -> None:
    with with_box(".5 1.4 .6 0 0 0") as level:
        assert brink(ledges(level)) == [(0, 1, Kind.FALL)]


def test_a_thing_that_moves_leaves_open_what_it_changes() -> None:
    with with_box(".5 1.4 -.125 0 0 0", more=FRAMES.format(a=-0.125, b=-0.475)) as level:
        found = ledges(level)
    assert brink(found) == [(0, 0.1, Kind.FALL), (0.1, 0.9, Kind.UNKNOWN), (0.9, 1, Kind.FALL)]
    row = np.flatnonzero((found.surface == 0) & (found.corner == 2))[1]
    assert found.thing[row] == 2
    assert found.drop_start[row] == 0, "as it is placed"


def test_a_thing_that_moves_where_it_makes_no_difference_leaves_nothing_open() -> None:
    """Its top is a fall below the brink at each frame."""
    with with_box(".5 1.4 -.425 0 0 0", more=FRAMES.format(a=-0.375, b=-0.475)) as level:
        assert brink(ledges(level)) == [(0, 0.1, Kind.FALL), (0.1, 0.9, Kind.FALL), (0.9, 1, Kind.FALL)]


def test_a_thing_that_physics_moves_may_be_gone() -> None:
    with with_box(".5 1.4 -.125 0 0 0", kind=KIND + " move=physics") as level:
        assert [kind for *_, kind in brink(ledges(level))] == [Kind.FALL, Kind.UNKNOWN, Kind.FALL]


def test_without_its_model_the_way_through_its_ball_is_unknown() -> None:
    with with_box(".5 1 -.3 0 0 0", kind=KIND.replace("size=.6", "size=.25"), name="other") as level:
        found = brink(ledges(level))
    half = np.sqrt(0.25**2 - BEYOND**2)
    assert [kind for *_, kind in found] == [Kind.FALL, Kind.UNKNOWN, Kind.FALL]
    assert found[1][:2] == pytest.approx((0.5 - half, 0.5 + half), abs=1e-3)
    with with_box(".5 1 -1 0 0 0", kind=KIND.replace("size=.6", "size=.25"), name="other") as level:
        assert brink(ledges(level)) == [(0, 1, Kind.FALL)], "beneath the pit"


def test_the_edges_of_a_thing_are_edges_of_floors_at_each_of_its_places() -> None:
    with with_box(".5 1.5 -.2 0 0 0", more=FRAMES.format(a=-0.2, b=-0.35).replace("1.4", "1.5")) as level:
        facts = LevelFacts(level)
        found = facts.ledges(facts.bodies[0])
    own = np.flatnonzero(found.carrier_thing == 2)
    assert set(found.carrier_frame[own].tolist()) == {PLACED, 1}, "frame 0 is where it is placed"
    tops = {frame: found.drop_start[own][found.carrier_frame[own] == frame] for frame in (PLACED, 1)}
    assert tops[PLACED] == pytest.approx([0.525] * 4)
    assert tops[1] == pytest.approx([0.375] * 4)
    assert set(found.carrier_face[own].tolist()) == {0}
    assert (found.surface[own] == -1).all()


def test_the_file_names_the_thing_that_an_edge_is_of_and_the_one_come_onto() -> None:
    with with_box(".5 1.4 -.5 0 0 0", (0.4, 0.4, 0.5)) as level:
        compiled = CompiledLevel(compile_level(level))
    held = compiled.ledges
    assert held is not None
    own = held.surface == -1
    assert (np.diff(held.surface) >= 0).all(), "by surface: those of things first"
    assert set(held.carrier[own].tolist()) == {2}
    assert set(held.carrier_frame[own].tolist()) == {-1}
    assert set(held.carrier_face[own].tolist()) == {0}
    assert set(held.carrier[~own].tolist()) == set(held.carrier_face[~own].tolist()) == {-1}
    onto = held.onto == 2
    assert (held.below[onto] == -1).all()
    assert set(held.onto_face[~onto].tolist()) == {-1}
    found = compiled.ledges_at(0, 0, 2)
    assert [Kind(each.kind) for each in found] == [Kind.FALL, Kind.FALL], "the box between them is level"


@pytest.mark.parametrize(
    ("height", "kind", "listed"),
    [
        (0.0, Kind.LEVEL, False), (-0.1, Kind.SEAMLESS, False), (-0.3, Kind.FALL, True), (0.05, Kind.STEP, False),
        (0.065, Kind.LIP, False), (0.1, Kind.JUMP, False), (0.5, Kind.WALL, False),
    ],
)  # fmt: skip
def test_of_a_thing_the_file_lists_what_takes_a_body_off_it_or_drops_it(
    height: float, kind: Kind, listed: bool
) -> None:
    """Two boxes in one model, side by side along x, the second so much higher; both stand high above the pit."""
    two = boxes((-0.4, -0.4, -0.1, 0, 0.4, 0), (0, -0.4, height - 0.8, 0.4, 0.4, height))
    with with_box(".5 1.5 .4 0 0 0", model=two) as level:
        facts = LevelFacts(level)
        found, held = facts.ledges(facts.bodies[0]), CompiledLevel(compile_level(level)).ledges
    across = (found.carrier_face == 0) & (found.onto == 2)
    assert set(found.kind[across].tolist()) == {kind}
    assert held is not None
    first = (held.carrier == 2) & (held.carrier_face == 0)
    assert (held.onto[first] == 2).any() == listed
    assert set(held.kind[first & (held.onto != 2)].tolist()) == {Kind.FALL}, (
        "the three other sides lead down to the pit"
    )
    assert len(set(held.corner[first & (held.onto != 2)].tolist())) == 3


@pytest.mark.parametrize(("top", "ways"), [
    (-0.35, Way(0)),  # 0.35 JKU below the rim
    (-0.33, Way.JUMP), (-0.27, Way.JUMP),
    (-0.25, Way(0)),  # 0.35 above the floor
])  # fmt: skip
def test_a_box_in_a_pit_lets_out_whom_a_jump_takes_onto_it_and_on_to_the_rim(top: float, ways: Way) -> None:
    """The floor is at -0.6, a jump takes up 0.336 JKU. Where it does not help, it hides the basin no more."""
    with with_box(f".5 1.5 {top - 0.125} 0 0 0") as level:
        facts = LevelFacts(level)
        (basin,) = facts.basins(facts.bodies[0])
    assert (basin.left, basin.is_inescapable) == (ways, not ways)
    assert (basin.shallowest, basin.deepest) == pytest.approx((0.6, 0.6))


def test_a_table_is_no_rim() -> None:
    """Nobody gets onto it, so nobody falls from it: a room is no basin for that."""
    player = "walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5"
    table = ["World templates 4", player, KIND, "World things 3", "2: lift crate .5 1.5 .475 0 0 0 1"]
    with level_with_files(*table, "== 3do/box.3do", *box(*FLAT)) as level:
        facts = LevelFacts(level)
        (walker,) = (each for each in facts.bodies if each.hovers)
        assert (facts.ledges(walker).carrier_thing >= 0).any()
        assert facts.basins(walker) == ()


@pytest.mark.parametrize(("top", "helps"), [(-0.55, True), (-0.3, True), (-0.2, False)])
def test_a_lift_lets_out_that_comes_no_higher_than_a_jump(top: float, helps: bool) -> None:
    """The floor is at -0.6, a jump takes up 0.336 JKU; the lift is placed at the rim."""
    frames = FRAMES.format(a=-0.025, b=top - 0.025)
    with with_box(".5 1.4 -.025 0 0 0", (0.4, 0.4, 0.025), frames) as level:
        facts = LevelFacts(level)
        (basin,) = facts.basins(facts.bodies[0])
    assert (basin.left, basin.is_inescapable) == ((Way.MOVER, False) if helps else (Way(0), True))


def test_an_edge_that_sticks_in_a_wall_is_a_wall() -> None:
    """The box reaches half through the wall at x = 1."""
    with with_box("1 1.5 -.4 0 0 0") as level:
        found = ledges(level)
    own = (found.carrier_thing == 2) & (found.kind == Kind.WALL)
    assert found.length[own].sum() == pytest.approx(0.8 + 2 * 0.4, abs=1e-2), "one side, and half of two"


@settings(deadline=None, max_examples=25, phases=(Phase.explicit, Phase.reuse, Phase.generate))
@given(
    st.tuples(st.floats(0.1, 0.9), st.floats(0.7, 1.8), st.floats(-0.7, 0.2)),
    st.tuples(st.floats(-50, 50), st.floats(-180, 180), st.floats(-50, 50)),
    st.tuples(st.floats(0.05, 0.6), st.floats(0.05, 0.6), st.floats(0.02, 0.3)),
)
@example((0.5, 1.0, 0.0), (1.0, 0.0, 0.0), (0.5, 0.5, 0.25))
def test_a_turned_box_against_the_twin_and_the_exact_tier(
    place: tuple[float, ...], angles: tuple[float, ...], size: tuple[float, float, float]
) -> None:
    with with_box(" ".join(f"{x:.3f}" for x in (*place, *angles)), tuple(round(x, 3) for x in size)) as level:  # type: ignore[arg-type]
        edges = EdgeWalker(level, LevelFacts(level).floors.solids())
        found = edges.beyond(GAIT)
        assert compare(level, edges, found, GAIT, 0.02, 300)[1] == []
        assert [piece for piece in differing(edges, found, edges.beyond(GAIT, exact=True)) if piece > BEYOND] == []


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus is not at hand")
@pytest.mark.parametrize("path", ["masspack.gob!jkl/lagoon.jkl", "masspack.gob!jkl/wayrest.jkl"])
def test_real_things_against_the_twin_and_drop(path: str) -> None:
    """Among the edges near things, and of things; `drop` has the same floors by another way."""
    level = load(f"{CORPUS}/gob/{path}")
    facts = LevelFacts.of(level)
    edges, floors = facts.edges, facts.floors
    (placed, rows), *_ = scenes(edges, floors)
    found = edges.beyond(GAIT, edges=rows[edges.solid[rows] >= 0], present=placed.present)
    count, wrong = compare(level, edges, found, GAIT, 0.05, 300, Twin(level))
    assert (count > 200, wrong) == (True, [])
    onto = np.flatnonzero((found.face >= 0) & (found.over == Over.FLOOR) & (found.rise == 0))
    assert len(onto) > 20
    middle = (found.start[onto] + found.end[onto]) / 2
    here, along = edges.here[found.edge[onto]], (edges.there - edges.here)[found.edge[onto]]
    out = np.stack([along[:, 1], -along[:, 0], np.zeros(len(along))], axis=1)
    out /= np.linalg.norm(out[:, :2], axis=1)[:, None]
    points = here + along * middle[:, None] + BEYOND * out + (0, 0, GAIT.hover)
    sectors = facts.mesh.locate(points)
    below = floors.below(facts.mesh, points[sectors >= 0], sectors[sectors >= 0])
    known = below.ending == Ending.FLOOR
    solid = edges.solids.face_solid[found.face[onto[sectors >= 0]]]
    assert (below.thing == floors.thing_of(solid))[known].mean() == 1
    assert known.mean() > 0.9


def test_both_profiles_are_judged() -> None:
    """A gap of 0.1 JKU between the brink and a box, less than two radii: the decompiled engine does not notice it."""
    with with_box(".5 1.5 -.125 0 0 0") as level:
        facts = LevelFacts(level)
        found = facts.ledges(facts.bodies[0], Engine.RESEARCH)
    rows = np.flatnonzero((found.surface == 0) & (found.corner == 2))
    bridged = rows[found.other[rows] == Kind.SEAMLESS]
    assert found.length[bridged].sum() == pytest.approx(0.8, abs=1e-3), "all along the box, not at its middle only"
    assert set(found.kind[bridged].tolist()) == {Kind.FALL}
