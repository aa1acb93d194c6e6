"""The rules about things and templates, at their limits and with what they point at."""

from __future__ import annotations

import pytest

from jktools.linter import lint
from jktools.linter.registry import find_rule
from tests.support.levels import FILE, level_of, level_with_files, two_rooms
from tests.support.lint import findings, marked, messages

GHOST = "{number}: ghost ghost .5 1.5 .5 0 90 0 {sector}"


@pytest.mark.parametrize(("sector", "told"), [("-1", True), ("0", False), ("1", False), ("2", True)])
def test_a_thing_is_in_a_sector_of_the_level(sector: str, told: bool) -> None:
    assert marked("JK402", "World things 3", GHOST.format(number=1, sector=sector)) == ([sector] if told else [])


@pytest.mark.parametrize(("number", "told"), [("-1", True), ("2", False), ("3", True)])
def test_a_number_is_below_what_the_heading_announces(number: str, told: bool) -> None:
    found = findings(
        "JK403", "World things 3", "- 1: ghost ghost .5 1.5 .5 0 90 0 1", GHOST.format(number=number, sector=1)
    )
    assert bool(found) is told
    if told:
        assert (
            found[0].message
            == f"thing {number} (ghost) has number {number}, but the heading announces 3 things, from 0"
        )
        assert found[0].related[0].span is not None
        assert found[0].related[0].span.text == "World things 3"


def test_a_number_belongs_to_one_thing() -> None:
    (message,) = messages("JK404", "World things 3", "00: ghost ghost .5 1.5 .5 0 90 0 1")
    assert message == "thing 0 (ghost) has number 0, but thing 0 (walkplayer) has it already"
    # The engine skips a thing without sector before it looks at the number.
    assert messages("JK404", "World things 3", "00: ghost ghost .5 1.5 .5 0 90 0 7") == []


def test_a_template_that_says_the_same_twice_can_go() -> None:
    (found,) = findings("JK405", "World templates 4", "CRATE,None,type=cog,collide=1,size=.1")
    assert found.message == "template 3 (CRATE) has the name of template 2 above, but only the first of a name counts"
    assert found.help == "delete the line: it says the same"
    (found,) = findings("JK405", "World templates 4", "CRATE,None,type=cog,collide=1,size=.2")
    assert found.help == "rename one of the two, or join them"


def test_types_come_from_the_nearest_parent() -> None:
    level = level_of(two_rooms(
        "World templates 8", "a crate size=1", "b a type=Weapon", "c b size=2", "d nowhere size=1", "e none size=1",
        "World things 4", "1: c c .5 1.5 .5 0 0 0 1", "2: c c .5 1.5 .5 0 0 0 1 type=item", "3: x x 1 1 1 0 0 0 1",
    ))  # fmt: skip
    types = [held.type if held.knows_type else None for held in level.resolved_templates.entries]
    assert types == ["player", "ghost", "cog", "cog", "weapon", "weapon", None, "free"]
    types = [held.type if held.knows_type else None for held in level.resolved_things]
    assert types == ["player", "weapon", "item", None]


@pytest.mark.parametrize(("line", "told"), [
    ("a none size=1", True), ("a none type=free", True), ("a none type=cog", False), ("a crate size=1", False),
    ("a nowhere size=1", False),
])  # fmt: skip
def test_a_template_needs_a_type(line: str, told: bool) -> None:
    assert bool(messages("JK406", "World templates 4", line)) is told


@pytest.mark.parametrize(("parameters", "fault"), [
    ("numframes=1 frame=(0/0/0:0/0/0)", None),
    ("numframes=1 frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)", "has 2 frames, but numframes=1"),
    ("numframes=2 frame=(0/0/0:0/0/0)", None),
    ("numframes=0", "has numframes=0, but a path needs at least 1 frame"),
    ("numframes=x", "has numframes=x, but a path needs at least 1 frame"),
    ("numframes=2 numframes=3", "has numframes=3, but has numframes=2 already, and the first counts"),
    ("frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)", "has a frame, but no numframes makes room for it"),
    ("frame=(0/0/0:0/0/0) numframes=1 frame=(0/0/1:0/0/0)",
     "has a frame before numframes=1, but only that makes room for it"),
])  # fmt: skip
def test_frames_are_counted_behind_their_number(parameters: str, fault: str | None) -> None:
    found = messages("JK407", "World things 3", f"1: crate crate .5 1.5 .5 0 0 0 1 move=path {parameters}")
    assert found == ([] if fault is None else [f"thing 1 (crate) {fault}"])


def test_frames_of_a_template_count_too() -> None:
    lift = ("World templates 4", "lift none type=cog move=path numframes=1 frame=(0/0/0:0/0/0)", "World things 3")
    assert messages("JK407", *lift, "1: lift lift .5 1.5 .5 0 0 0 1 frame=(0/0/1:0/0/0)") == [
        "thing 1 (lift) has 2 frames, but numframes=1"
    ]
    assert messages("JK407", *lift, "1: lift lift .5 1.5 .5 0 0 0 1 numframes=2") == [
        "thing 1 (lift) has numframes=2, but has numframes=1 from template 3 (lift), and the first counts"
    ]


def test_a_patrol_in_a_template_is_told_once() -> None:
    patrol = ("World templates 4", "guard none type=actor numframes=1 frame=(.5/.5/.5)")
    assert len(messages("JK425", *patrol)) == 1
    assert messages("JK407", *patrol) == []


def test_a_player_starts_somewhere() -> None:
    without = ("World things 3", "0: ghost ghost .5 .5 .2 0 0 0 0")
    assert messages("JK408", *without) == ["the level has 2 things, but none of type player"]
    assert marked("JK408", *without) == ["SECTION: THINGS"]
    (nobody,) = messages("JK408", "World things 0", "- 0: walkplayer walkplayer .5 .5 .2 0 0 0 0",
                         "- 1: ghost ghost .5 1.5 .5 0 90 0 1")  # fmt: skip
    assert nobody == "the level has no things, but needs one of type player"
    # A child of walkplayer is a player too, and an unknown template may be one.
    child = ("World templates 4", "kyle walkplayer size=.07", *without[:1], "0: kyle kyle .5 .5 .2 0 0 0 0")
    assert messages("JK408", *child) == []
    assert messages("JK408", "World things 3", "0: jedi jedi .5 .5 .2 0 0 0 0") == []


def test_a_flood_of_unknown_parameters_is_cut_off() -> None:
    lines = (f"guard{i} none type=actor no{i}=1" for i in range(1500))
    found = messages("JK410", "World templates 1503", *lines)
    assert len(found) == 1000
    assert found[0].endswith("has no0=1, but the engine knows no such parameter")
    assert found[-1].endswith("has no999=1, but the engine knows no such parameter; the file has 500 more of them")


PANE = """section: header
3DO 2.1
section: modelresource
materials 0
section: geometrydef
radius 1.0
insert offset 0 0 0
geosets 1
geoset 0
meshes 1
mesh 0
name pane
radius 1.0
geometrymode 4
lightingmode 3
texturemode 1
vertices 3
0: -0.2 0 0 0
1: 0.2 0 0 0
2: 0 0.2 0 0
texture vertices 0
vertex normals
0: 0 0 1
1: 0 0 1
2: 0 0 1
faces 1
0: -1 0x0 4 3 1 0 3 0,0 1,0 2,0
face normals
0: 0 0 1
section: hierarchydef
hierarchy nodes 1
0: 0x0 0x0 0 -1 -1 -1 0 0 0 0 0 0 0 0 0 0 0 pane"""


@pytest.mark.parametrize(("y", "reach"), [(0.7, None), (0.84, None), (0.9, "0.1")])
def test_a_model_that_reaches_into_the_next_sector(y: float, reach: str | None) -> None:
    lines = [
        "World templates 4",
        "pane none type=cog model3d=pane.3do",
        "World things 3",
        f"1: pane pane .5 {y} .5 0 0 0 0",
    ]
    with level_with_files(*lines, f"{FILE}3do/pane.3do", *PANE.splitlines()) as level:
        found = [d.message for d in lint(level, [find_rule("JK426")])]
    assert len(found) == (reach is not None)
    if reach:
        assert found[0].startswith(f"the model of thing 1 (pane) reaches {reach} JKU through the adjoin of surface 3 ")
