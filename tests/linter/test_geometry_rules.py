"""The geometric rules at their tolerances, against distances computed by hand."""

from __future__ import annotations

import re

import pytest

from jktools.linter import find_rule, lint
from tests.support.levels import corpus_files, level_of, two_rooms


def messages(code: str, *fragment: str) -> list[str]:
    return [d.message for d in lint(level_of(two_rooms(*fragment)), [find_rule(code)])]


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


def test_a_thing_outside_its_sector() -> None:
    (message,) = messages("JK401", "World things 3", "1: ghost ghost .5 .75 .5 0 0 0 1")
    assert message == "thing 1 (ghost) names sector 1, but lies 0.25 JKU behind its surface 8"
    assert messages("JK401", "World things 3", "1: ghost ghost .5 1 .5 0 0 0 1") == []
    assert messages("JK401", "World things 3", "1: ghost ghost .5 .999995 .5 0 0 0 1") == []
    assert len(messages("JK401", "World things 3", "1: ghost ghost .5 .9999 .5 0 0 0 1")) == 1


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
        boxes = sum(s.collide_box is not None for s in level.sectors)
        assert (boxes, len(lint(level, [find_rule("JK301")]))) == COLLIDE_BOXES[path]


@pytest.mark.parametrize("name", ["azulcity", "desolation", "jmmcjk", "lagoon", "lop_sabers", "project", "wayrest"])
def test_every_level_of_masspack_has_a_box_that_sticks_out(name: str) -> None:
    data = next((data for path, data in corpus_files() if path == f"masspack.gob!jkl/{name}.jkl"), None)
    if data is None:
        pytest.skip("the corpus of real mods is not at hand")
    assert lint(level_of(data), [find_rule("JK301")])
