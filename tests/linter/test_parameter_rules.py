"""The rules about parameters of templates and things: what they say, where they point, and what they leave be."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.emit import template as template_format
from jktools.linter import find_rule, lint, rules
from jktools.model import Level
from jktools.session import load
from jktools.source import Source
from jktools.syntax.jkl import read_library
from jktools.syntax.template.parameters import PARAMETERS
from tests.support.levels import TWO_ROOMS
from tests.support.lint import findings, marked, messages


def said(code: str, line: str) -> list[str]:
    return messages(code, "World templates 4", line)


@pytest.mark.parametrize(("word", "cure"), [
    ("thingflags0x400", 'write "thingflags=0x400" if you mean that'),
    ("pup=x.pup", 'did you mean "puppet"?'),
    ("thingflage=0x4", 'did you mean "thingflags"?'),
    ("Bouyancy=1", 'did you mean "buoyancy"?'),
    ("zzz=1", "remove it; docs/parameters.md lists those that there are"),
])  # fmt: skip
def test_an_unknown_key_gets_the_nearest(word: str, cure: str) -> None:
    found = findings("JK410", "World templates 4", f"lamp none type=cog {word}")
    assert [(d.message, d.help) for d in found] == [
        (f"template 3 (lamp) has {word}, but the engine knows no such parameter", cure)
    ]
    assert found[0].label.span is not None
    assert found[0].label.span.text == word


def test_a_parameter_of_other_types_says_which() -> None:
    assert said("JK411", "+bolt none type=weapon health=25") == [
        "template 3 (+bolt) has health=25, but that is for type actor or player, and this is of type weapon with move "
        "none"
    ]
    assert said("JK411", "+bolt none type=weapon attach=1") == [
        "template 3 (+bolt) has attach=1, but the engine does nothing with it"
    ]
    assert said("JK411", "rancor none type=actor treesize=1") == [
        "template 3 (rancor) has treesize=1, but only Mysteries of the Sith knows it"
    ]
    assert findings("JK411", "World templates 4", "rancor none type=actor treesize=1", game="mots") == []
    # A parent that the level does not define may have the type.
    assert said("JK411", "+bolt +unknown health=25") == []
    # What a later word would let take effect is left to JK413.
    assert said("JK411", "+bolt none damage=2 type=weapon") == []


def test_order_matters_only_where_a_later_word_would_serve() -> None:
    early = "+bolt none damage=2 mass=1 type=weapon move=physics"
    assert marked("JK413", "World templates 4", early) == ["damage=2", "mass=1"]
    assert said("JK413", "+bolt none health=2 type=weapon") == []
    child = ("World templates 5", "+bolt none type=weapon", "+fast +bolt damage=2 type=weapon")
    assert messages("JK413", *child) == []


@pytest.mark.parametrize(("word", "wanted"), [
    ("size=-.1", "0 or more"), ("collide=4", "0 to 3"), ("collide=-1", "0 to 3"),
    ("move=fast", "one of none, physics, path"),
    ("orient=(1/2)", "three numbers, (x/y/z)"), ("thingflags=solid", "a hexadecimal number"),
])  # fmt: skip
def test_a_rejected_value_says_what_is_taken(word: str, wanted: str) -> None:
    assert said("JK412", f"lamp none type=cog {word}") == [
        f"template 3 (lamp) has {word}, but the engine takes {wanted}"
    ]


@pytest.mark.parametrize(("word", "read"), [
    ("size=big", "0"), ("size=1.5.2", "1.5"), ("collide=0x1", "0"), ("collide=o", "0"), ("orient=(1/2/3", "1/2/3"),
    ("thingflags=0x4g", "4"), ("collide", "0"),
])  # fmt: skip
def test_a_loose_value_says_what_is_read(word: str, read: str) -> None:
    key = word.partition("=")[0]
    assert said("JK414", f"lamp none type=cog {word}") == [
        f"template 3 (lamp) has {word}, but the engine reads {key} as {read}"
    ]


@pytest.mark.parametrize("word", ["size=.5", "collide=1", "thingflags=400", "orient=(0/-.5/1e2)", "model3d=a+b.3do"])
def test_a_clean_value_is_let_be(word: str) -> None:
    assert said("JK414", f"lamp none type=cog {word}") == []


@pytest.mark.parametrize(("value", "told"), [("1", False), ("-1", False), ("1.01", True), ("-45", True)])
def test_a_fov_is_a_cosine(value: str, told: bool) -> None:
    assert bool(said("JK416", f"guard none type=actor fov={value}")) is told


@pytest.mark.parametrize(
    ("flags", "told"), [("0x7000", 1), ("0x3000", 0), ("0x18000", 1), ("0x1F000", 2), ("0x8000", 0)]
)
def test_flags_that_exclude_everywhere(flags: str, told: int) -> None:
    line = f"1: ghost ghost .5 1.5 .5 0 90 0 1 thingflags={flags}"
    assert len(messages("JK417", "World things 3", line)) == told


def test_flags_of_the_template_exclude_unless_the_line_replaces_them() -> None:
    gone = ("World templates 4", "gone none type=cog thingflags=0x7000", "World things 3")
    assert len(messages("JK417", *gone, "1: gone gone .5 1.5 .5 0 90 0 1")) == 1
    assert messages("JK417", *gone, "1: gone gone .5 1.5 .5 0 90 0 1 thingflags=0x4") == []


def test_a_movesize_that_is_the_size_does_no_harm() -> None:
    assert said("JK418", "giant none type=actor size=.2 movesize=.2") == []
    assert said("JK418", "giant none type=actor size=.1 movesize=.2") == [
        "template 3 (giant) has movesize=.2, but moves with 0.1 JKU"
    ]
    assert said("JK418", "giant none type=cog size=.1 movesize=.2") == []


def test_memory_is_shared_only_between_types_that_use_it() -> None:
    def told(child: str) -> int:
        return len(messages("JK424", "World templates 5", "+bolt none type=weapon damage=1", f"x +bolt {child}"))

    assert (told("type=explosion"), told("type=cog"), told("type=weapon"), told("move=physics")) == (1, 0, 0, 0)


def test_a_reference_to_itself_is_told_as_such() -> None:
    assert said("JK106", "+boom none type=explosion debris=+boom") == [
        "template 3 (+boom) has debris=+boom, but is that itself, and knows only what stands above"
    ]


def test_a_template_of_the_game_shadows_one_that_differs(tmp_path: Path) -> None:
    static = "\n".join(
        [
            "SECTION: TEMPLATES",
            "World templates 2",
            "crate none type=cog collide=1 size=.1",
            "ghost none type=cog",
            "end",
        ]
    )
    (tmp_path / "base/jkl").mkdir(parents=True)
    (tmp_path / "base/jkl/static.jkl").write_text(static)
    (tmp_path / "rooms.jkl").write_text(TWO_ROOMS)
    level = load(str(tmp_path / "rooms.jkl"), base=[str(tmp_path / "base")])
    found = lint(level, [find_rule("JK120")])
    assert [d.message.split(",")[0].replace(str(tmp_path), "") for d in found] == [
        "template 1 (ghost) differs from the template of that name in /base/jkl/static.jkl"
    ]
    assert [held.dropped is None for held in level.resolved_templates.entries] == [True, False, False]
    # Things take what the engine keeps.
    assert level.things[1].resolved.type == "cog"


@pytest.mark.parametrize(("x", "depth"), [(".03", True), (".05", False), (".065", False), (".5", False)])
def test_a_body_may_touch_a_wall_but_not_reach_through(x: str, depth: bool) -> None:
    line = f"0: walkplayer walkplayer {x} .5 .2 0 0 0 0"
    assert bool(messages("JK419", "World things 3", line)) is depth


def test_the_floor_and_a_passable_adjoin_hold_nobody() -> None:
    assert messages("JK419", "World things 3", "0: walkplayer walkplayer .5 .5 .01 0 0 0 0") == []
    assert messages("JK419", "World things 3", "0: walkplayer walkplayer .5 .99 .2 0 0 0 0") == []
    shut = ("World adjoins 2", "0: 0x5 1 1", "1: 0x5 0 1", "World things 3")
    assert len(messages("JK419", *shut, "0: walkplayer walkplayer .5 .99 .2 0 0 0 0")) == 1


def test_a_start_needs_a_floor_unless_it_swims_or_is_carried() -> None:
    bare = ("World surfaces 12", "0: 0 0x4 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1")
    assert messages("JK420", *bare) == [
        "thing 0 (walkplayer) starts a player, but surface 0 (sector 0, surface 0) below has no floor flag (0x1)"
    ]
    assert messages("JK420", *bare, "Sector 0", "Flags 0x2") == []
    carried = ("World templates 4", "bridge none type=cog collide=3 size=.3 thingflags=0x40", "World things 4")
    assert messages("JK420", *bare, *carried, "2: bridge bridge .6 .5 .1 0 0 0 0") == []
    assert len(messages("JK420", *bare, *carried, "2: bridge bridge .6 1.5 .1 0 0 0 1")) == 1


@pytest.mark.parametrize(
    ("place", "told"),
    [
        (".5 .5 0", 0),  # on the floor
        (".5 .5 -.000005", 0),
        (".5 .5 -.00002", 1),
        (".5 1.2 .5", 0),  # in the room next to the one that it names
        ("5 5 5", 1),
        ("1e99 5 5", 0),
    ],
)
def test_a_start_stands_on_the_floor_of_the_sector_that_it_lies_in(place: str, told: int) -> None:
    assert len(messages("JK420", "World things 3", f"0: walkplayer walkplayer {place} 0 0 0 0")) == told


def test_frames_are_looked_for_where_they_lie() -> None:
    line = "1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=2 frame=({first}:0/0/0) frame=({last}:0/0/0)"
    assert marked("JK421", "World things 3", line.format(first=".5/.5/.5", last=".5/.5/1.5")) == [
        "frame=(.5/.5/1.5:0/0/0)"
    ]
    assert messages("JK422", "World things 3", line.format(first=".5/.5/.501", last=".5/.5/.5")) == []
    assert messages("JK422", "World things 3", line.format(first=".5/.5/.502", last=".5/.5/.5")) == [
        "thing 1 (crate) is placed 0.002 JKU away from its frame 0"
    ]
    # The frames of a template lie relative to where its things are placed.
    lift = ("World templates 4", "lift none type=cog move=path numframes=1 frame=(0/0/9:0/0/0)", "World things 3")
    placed = "1: lift lift .5 .5 .5 0 0 0 0"
    assert messages("JK421", *lift, placed) == messages("JK422", *lift, placed) == []


def test_a_path_is_blocked_by_walls() -> None:
    line = "1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=2 frame=(.5/.5/.5:0/0/0) frame=(.5/1.5/.5:0/0/0)"
    assert messages("JK423", "World things 3", line) == []
    (message,) = messages("JK423", "World things 3", line, "World adjoins 2", "0: 0x6 1 1", "1: 0x6 0 1")
    assert message == "thing 1 (crate) goes from frame 0 to frame 1, but surface 3 (sector 0, surface 3) stands between"


KEYS = [*PARAMETERS, "pup", "=", "type=weapon", "type=explosion", "move=path", "numframes=3", "none", "a", "#"]
VALUES = ["", "=", "=(1/2/3)", "=(1/2/3:4/5/6)", "=-1", "=1e999", "=x", "=none"]
WORDS = st.tuples(st.sampled_from(KEYS), st.sampled_from(VALUES)).map("".join)


@settings(max_examples=150, deadline=None)
@given(st.lists(st.lists(WORDS, max_size=6).map(" ".join), max_size=6))
def test_no_library_makes_a_rule_fail(lines: list[str]) -> None:
    level = Level(read_library(Source("x.tpl", "\n".join(lines).encode())))
    chosen = [rule for rule in rules() if Level in rule.looks_at]
    assert not [d for d in lint(level, chosen) if d.code.id.startswith("JK9")]
    for template in level.templates:
        assert list(template_format.text(template.resolved))
        json.loads(template_format.json(template.resolved))
