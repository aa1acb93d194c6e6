"""The geometric rules at their tolerances, against distances computed by hand."""

from __future__ import annotations

import math
import re

import pytest

from jktools.facts import LevelFacts
from jktools.linter import find_rule, lint
from tests.support.levels import corpus_files, level_of, two_rooms
from tests.support.lint import findings, marked, messages


def test_a_collide_box_is_measured_from_the_surface_it_leaves() -> None:
    (message,) = messages("JK301", "Sector 0", "CollideBox .1 .1 .1 .9 1.25 .9")
    assert message == (
        "the collide box of sector 0 lies 0.25 JKU behind surface 3 (sector 0, surface 3), but should lie inside the "
        "sector"
    )
    assert messages("JK301", "Sector 0", "CollideBox .1 .1 .1 .9 1.0009 .9") == []
    assert len(messages("JK301", "Sector 0", "CollideBox .1 .1 .1 .9 1.0011 .9")) == 1


def test_convexity_is_judged_at_a_thousandth() -> None:
    # Vertex 2, pushed below the floor of both rooms, is behind the floors' widest triangles by what it was pushed.
    assert messages("JK302", "World vertices 12", "2: 1 1 -.0005") == []
    found = messages("JK302", "World vertices 12", "2: 1 1 -.25")
    assert found
    assert all("JKU behind surface" in m for m in found)


def test_planarity_is_measured_from_the_first_vertex() -> None:
    (first, second) = messages("JK303", "World vertices 12", "2: 1 1 .03")
    # Floor of room 0: the vector area of (0,0,0) (1,0,0) (1,1,h) (0,1,0) is (-h, -h, 2) / 2; the corner farthest from
    # the plane through the origin along it is (1, 0, 0), as far as (0, 1, 0): h / sqrt(4 + 2 h^2).
    distance = float(re.search(r"lies ([\d.]+) JKU", first)[1])  # type: ignore[index]
    assert distance == pytest.approx(0.03 / (4 + 2 * 0.03**2) ** 0.5, rel=1e-5)
    assert "surface 6" in second


def test_a_reflex_corner_is_measured_from_the_line_through_its_neighbours() -> None:
    found = messages("JK304", "World vertices 12", "2: .4 .4 0")
    assert any("corner at vertex 2 is reflex, 0.141421 JKU deep" in m for m in found)


def test_a_long_edge_bent_within_rounding_does_not_hide_a_reflex_corner() -> None:
    # The floor of room 0 with a notch 0.02 deep at vertex 2, between neighbours 0.1 apart: cross product 0.002. At
    # vertex 1 an edge of 2000 JKU is bent inwards by 0.00005, which float32 may do: cross product 0.1.
    found = messages(
        "JK304", "World vertices 12", "0: 0 -1000 0", "3: 2 0 0", "2: 1.98 .05 0", "5: 2 .1 0", "4: 0 1000 0",
        "1: .00005 0 0",
        "World surfaces 12", "0: 0 0x5 0x4 4 3 1 -1 0 6 0,0 3,1 2,2 5,3 4,0 1,1 1 1 1 1 1 1",
    )  # fmt: skip
    assert [m for m in found if m.startswith("surface 0 ") and "vertex 2" in m]


def test_a_thing_outside_its_sector() -> None:
    (message,) = messages("JK401", "World things 3", "1: ghost ghost .5 .75 .5 0 0 0 1")
    assert message == "thing 1 (ghost) names sector 1, but lies 0.25 JKU behind its surface 8"
    assert messages("JK401", "World things 3", "1: ghost ghost .5 1 .5 0 0 0 1") == []
    assert messages("JK401", "World things 3", "1: ghost ghost .5 .999995 .5 0 0 0 1") == []
    assert len(messages("JK401", "World things 3", "1: ghost ghost .5 .9999 .5 0 0 0 1")) == 1


# ---- closed sectors

CEILING = "1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1"


def test_a_missing_corner_opens_the_edges_beside_it() -> None:
    # The ceiling of room 0 as the triangle 4 7 6: the walls' edges 4-5 and 5-6 and its own 6-4, a diagonal, are open.
    (message,) = messages("JK305", "World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1 0 3 4,0 7,1 6,2 1 1 1")
    assert message == (
        "sector 0 is open along the edge from vertex 6 to 4 of surface 1 (sector 0, surface 1), over 1.41421 JKU; "
        "2 more edges are open"
    )


def test_an_extra_vertex_within_an_edge_leaves_a_sector_closed() -> None:
    middle = ("World vertices 13", "12: .5 1 1", "World surfaces 12")
    assert messages("JK305", *middle, "1: 0 0x4 0x4 4 3 1 -1 0 5 4,0 7,1 12,1 6,2 5,3 1 1 1 1 1") == []
    # Two walls may share what one ceiling borders on.
    assert messages("JK305", *middle, "3: 0 0 4 4 3 1 0 0 5 3,0 2,1 6,2 12,2 7,3 1 1 1 1 1") == []


@pytest.mark.parametrize(("beside", "open_"), [(0.0009, False), (0.0011, True)])
def test_edges_may_lie_a_thousandth_apart(beside: float, open_: bool) -> None:
    fragment = (
        "World vertices 14", f"12: 0 1 {1 + beside}", f"13: 1 1 {1 + beside}",
        "World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 12,1 13,2 5,3 1 1 1 1",
    )  # fmt: skip
    assert bool(messages("JK305", *fragment)) is open_


def test_a_turned_surface_is_one_fault() -> None:
    turned = "1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 7,3 1 1 1 1"
    (message,) = messages("JK309", "World surfaces 12", turned)
    assert message == (
        "the normal of surface 1 (sector 0, surface 1) is 180 degrees off that of its vertices, so that it points out "
        "of the sector"
    )
    assert messages("JK305", "World surfaces 12", turned) == []


# ---- edges and areas


def test_an_edge_counts_as_none_up_to_a_ten_thousandth() -> None:
    five = "1: 0 0x4 0x4 4 3 1 -1 0 5 4,0 7,1 12,1 6,2 5,3 1 1 1 1 1"
    (message,) = messages("JK306", "World vertices 13", "12: .0000999 1 1", "World surfaces 12", five)
    assert re.search(r"from vertex 7 to 12 is 9\.99\d*e-05 JKU long", message)
    assert messages("JK306", "World vertices 13", "12: .000101 1 1", "World surfaces 12", five) == []


def test_the_same_vertex_twice_is_marked_where_it_is_repeated() -> None:
    twice = ("World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1 0 5 4,0 7,1 6,2 5,3 4,0 1 1 1 1 1")
    # The repetition wraps around: the last corner is the first again.
    (found,) = findings("JK306", *twice)
    assert found.message == "surface 1 (sector 0, surface 1) names vertex 4 twice in a row"
    assert found.label.span is not None
    assert found.label.span.text == "4"


def test_a_surface_is_as_wide_as_its_area_over_its_longest_edge() -> None:
    # A triangle over the edge (0,0,0)-(1,0,0), h high: twice its area is h, its longest edge is 1.
    sliver = ("World surfaces 12", "0: 0 0x5 0x4 4 3 1 -1 0 3 0,0 1,1 12,2 1 1 1")
    (message,) = messages("JK307", "World vertices 13", "12: .5 .00009 0", *sliver)
    assert re.fullmatch(r"surface 0 \(sector 0, surface 0\) is 9\.?0*\d*e-05 JKU wide, but a surface .*", message)
    assert messages("JK307", "World vertices 13", "12: .5 .00011 0", *sliver) == []


# ---- normals


@pytest.mark.parametrize(("z", "wrong"), [(1.00009, False), (1.00011, True), (0.99991, False), (0.99989, True)])
def test_the_length_of_a_normal_may_be_off_by_a_ten_thousandth(z: float, wrong: bool) -> None:
    assert bool(messages("JK308", "Normals", f"0: 0 0 {z}")) is wrong


def test_a_normal_must_be_off_by_angle_and_by_distance() -> None:
    # 2 degrees off: the far corners of the unit floor lie sin(2 degrees) off the plane.
    (message,) = messages("JK309", "Normals", "0: 0 .034899 .999391")
    angle, distance = map(float, re.findall(r"is ([\d.]+) degrees .* a corner ([\d.]+) JKU", message)[0])
    assert angle == pytest.approx(2, rel=1e-4)
    assert distance == pytest.approx(math.sin(math.radians(2)), rel=1e-4)
    # 0.99 degrees is too little, though the corner is .017 off.
    assert messages("JK309", "Normals", "0: 0 .017278 .999851") == []


def test_a_bend_is_left_to_the_rule_for_bends() -> None:
    bent = ("World vertices 12", "2: 1 1 .2")
    assert messages("JK303", *bent)
    assert all("surface 0" not in m and "surface 6 " not in m for m in messages("JK309", *bent))


def test_a_missing_or_broken_normal_is_left_to_reading() -> None:
    assert messages("JK308", "Normals", "- 11: -1 0 0") == []
    assert messages("JK309", "Normals", "0: 0 x 1") == []


# ---- adjoined polygons


@pytest.mark.parametrize(("away", "differ"), [(0.00009, False), (0.00011, True)])
def test_adjoined_outlines_may_lie_a_ten_thousandth_apart(away: float, differ: bool) -> None:
    fragment = (
        "World vertices 13", f"12: 1 1 {1 + away}",
        "World surfaces 12", "8: 0 0x0 0x4 4 3 1 1 0 4 3,0 7,1 12,2 2,3 1 1 1 1",
    )  # fmt: skip
    assert bool(messages("JK310", *fragment)) is differ


def test_half_an_adjoined_wall_is_measured() -> None:
    # The window of room 1 as the lower triangle 3 7 2: its mirror's corner 6 lies 1/sqrt(2) off the diagonal.
    (message,) = messages("JK310", "World surfaces 12", "8: 0 0 4 4 3 1 1 0 3 3,0 7,1 2,3 1 1 1")
    assert message == (
        "surface 3 (sector 0, surface 3) is adjoined to surface 8 (sector 1, surface 2), but their outlines lie "
        "0.707107 JKU apart"
    )


# ---- what a sector says of its extent


def test_boxes_radii_and_centres_at_their_tolerances() -> None:
    assert messages("JK312", "Sector 0", "BoundBox 0 0 0 1 1.0019 1") == []
    (message,) = messages("JK312", "Sector 0", "BoundBox 0 0 -.25 1 1 1")
    assert message == "the bound box of sector 0 is 0.25 JKU off the box of its vertices"
    assert messages("JK313", "Sector 0", "Radius .868") == []  # the corner is sqrt(3) / 2 = 0.866025 away
    (message,) = messages("JK313", "Sector 0", "Radius .8")
    assert message == "sector 0 has radius 0.8, but its farthest vertex lies 0.866025 JKU from its centre"
    assert messages("JK314", "Sector 0", "Center .5 1.0009 .5") == []
    (message,) = messages("JK314", "Sector 0", "Center .5 1.25 .5")
    assert message == "the centre of sector 0 lies 0.25 JKU behind its surface 3, but should lie inside"


def test_a_corner_that_the_sector_does_not_list_counts_for_its_extent() -> None:
    """JK216 tells of the list; a box that is right must not be called wrong, nor the radius cut down to the list."""
    short = ("Sector 1", "Vertices 4", "- 4: 7", "- 5: 11", "- 6: 10", "- 7: 6")
    assert messages("JK312", *short) == []
    assert messages("JK313", *short) == []
    assert messages("JK216", *short) != []


def test_an_inverted_box_names_its_axis() -> None:
    (message,) = messages("JK311", "Sector 1", "CollideBox .1 1.1 .9 .9 1.9 .1")
    assert message == "the collide box of sector 1 reaches along z from 0.9 down to 0.1, but must reach up"
    assert marked("JK311", "Sector 1", "CollideBox .1 1.1 .9 .9 1.9 .1") == ["CollideBox .1 1.1 .9 .9 1.9 .1"]
    assert messages("JK311", "Sector 1", "CollideBox .1 1.1 .5 .9 1.9 .5") == []


def test_broken_records_are_left_to_the_rules_that_report_them() -> None:
    level = level_of(
        two_rooms("World vertices 12", "2: 1 x 0", "World surfaces 12", "7: 0 0 0 4 3 1 -1 0 3 7,0 11,1 99,2 1 1 1")
    )
    assert {d.code.id for d in lint(level)} == {"JK001", "JK204"}


COLLIDE_BOXES = {"namek.jkl": (391, 72)}
"""Boxes and how many stick out by more than 0.001 JKU, counted by another program (facts/level_checks.md, D1)."""


def test_as_many_boxes_stick_out_as_another_program_counted() -> None:
    files = {path: data for path, data in corpus_files() if path in COLLIDE_BOXES}
    if not files:
        pytest.skip("the corpus of real mods is not at hand")
    for path, data in files.items():
        level = level_of(data)
        boxes = [s.collide_box for s in level.sectors if s.collide_box is not None]
        _, outside = LevelFacts(level).collide_boxes
        assert (len(boxes), (outside.distance > 1e-3).sum()) == COLLIDE_BOXES[path]
        # The other program also counts boxes that are inverted as well, which are a finding of their own.
        inverted = {d.subject for d in lint(level, [find_rule("JK311")])}
        sticking = {d.subject for d in lint(level, [find_rule("JK301")])}
        assert inverted
        assert not inverted & sticking
        assert COLLIDE_BOXES[path][1] - len(inverted) <= len(sticking) < COLLIDE_BOXES[path][1]


@pytest.mark.parametrize("name", ["azulcity", "desolation", "jmmcjk", "lagoon", "lop_sabers", "project", "wayrest"])
def test_every_level_of_masspack_has_a_box_that_sticks_out(name: str) -> None:
    data = next((data for path, data in corpus_files() if path == f"masspack.gob!jkl/{name}.jkl"), None)
    if data is None:
        pytest.skip("the corpus of real mods is not at hand")
    assert lint(level_of(data), [find_rule("JK301")])


def test_as_many_surfaces_have_edges_of_no_length_as_another_program_counted() -> None:
    data = next((data for path, data in corpus_files() if path == "masspack.gob!jkl/desolation.jkl"), None)
    if data is None:
        pytest.skip("the corpus of real mods is not at hand")
    found = lint(level_of(data), [find_rule("JK306")])
    assert len({d.label.span.first.line for d in found if d.label.span}) == 38  # facts/level_checks.md, A30


def test_a_normal_that_is_off_bends_no_sector() -> None:
    # Behind the plane of a normal tilted by 2 degrees lie other vertices of the room, but not behind its polygon.
    tilted = ("Normals", "0: 0 .034899 .999391")
    assert len(messages("JK309", *tilted)) == 1
    assert messages("JK302", *tilted) == []
