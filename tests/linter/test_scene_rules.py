"""Rules on sight, motion, light, particles and colour: what they say, where, and where their limits lie."""

from __future__ import annotations

import pytest

from jktools.diagnostics import Diagnostic
from jktools.linter import find_rule, lint
from tests.support.levels import level_with_files
from tests.support.lint import findings, marked, messages


def said(code: str, line: str, *more: str) -> list[str]:
    return messages(code, "World templates 4", line, *more)


GUARD = "guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2"


@pytest.mark.parametrize(("words", "told"), [
    ("surfdrag=20", 0), ("surfdrag=20.1", 1), ("airdrag=21", 1), ("surfdrag=21 airdrag=21", 2),
    ("surfdrag=1000 maxthrust=0", 0),
])  # fmt: skip
def test_drag_is_unstable_beyond_twice_a_tenth_of_a_second(words: str, told: int) -> None:
    assert len(said("JK720", f"{GUARD} {words}")) == told


def test_unstable_drag_names_both_engines() -> None:
    line = f"{GUARD} surfdrag=25"
    assert said("JK720", line) == [
        "template 3 (guard) has surfdrag=25, which takes 2.5 times the speed in a frame of 0.1 s, but by the research "
        "document's step more than 2 makes it grow, and by the decompiled engine's all of it is lost"
    ]
    assert marked("JK720", "World templates 4", line) == ["surfdrag=25"]
    # The child only inherits it: one fault, one report.
    assert len(messages("JK720", "World templates 5", line, "chief guard health=10")) == 1


@pytest.mark.parametrize(("static", "told"), [(".4", 0), (".5", 1), (".6", 1)])
def test_a_walk_must_be_faster_than_static_drag(static: str, told: int) -> None:
    # 2 / 4 is half a JKU a second.
    assert len(said("JK721", f"{GUARD} surfdrag=4 staticdrag={static}")) == told


@pytest.mark.parametrize(("light", "told"), [(".69", 1), (".7", 0)])
def test_a_light_in_the_middle_of_a_room_must_reach_its_corners(light: str, told: int) -> None:
    # The corners are sqrt(3) / 2 away: 0.8 times that is 0.6928.
    found = said("JK730", f"lamp none type=cog light={light}", "World things 4", "2: lamp lamp .5 .5 .5 0 0 0 0")
    assert len(found) == told


SMOKE = "smoke none type=particle timer=1 material=m.mat range=.1 elementsize=.01 count=9"
PLACED = ("World things 4", "2: smoke smoke .5 .5 .5 0 0 0 0")


@pytest.mark.parametrize(("cut", "lacks"), [
    (" count=9", "no count"), (" elementsize=.01", "no elementsize"), (" material=m.mat", "no material"),
])  # fmt: skip
def test_particles_need_a_count_a_size_and_a_material(cut: str, lacks: str) -> None:
    line = SMOKE.replace(cut, "")
    assert said("JK740", line, *PLACED) == [f"template 3 (smoke) makes particles, but has {lacks}"]
    # What nothing creates can be a base for others.
    assert said("JK740", line) == []


def test_a_count_of_0_is_shown_as_written() -> None:
    line = SMOKE.replace("count=9", "count=0")
    assert said("JK740", line, *PLACED) == ["template 3 (smoke) makes particles, but has count=0"]
    assert marked("JK740", "World templates 4", line, *PLACED) == ["count=0"]


def test_minsize_may_equal_range() -> None:
    assert said("JK741", f"{SMOKE} minsize=.1") == []
    assert said("JK741", f"{SMOKE} minsize=.11") == ["template 3 (smoke) has minsize 0.11, but range 0.1"]


@pytest.mark.parametrize(("word", "told"), [
    ("yawrange=180", None), ("yawrange=180.5", "but it goes from 0 to 180"),
    ("pitchrange=-1", "but it goes from 0 to 180"),
    ("rate=0", None), ("rate=-1", "but it is 0 or more"), ("count=-2", "but it is 0 or more"),
])  # fmt: skip
def test_particle_values_have_ranges(word: str, told: str | None) -> None:
    expected = [] if told is None else [f"template 3 (smoke) has {word}, {told}"]
    assert said("JK743", f"{SMOKE} {word}") == expected


@pytest.mark.parametrize(("flags", "told"), [("0x3f", "0x2"), ("0x42", "0x42"), ("0x2d", None)])
def test_idle_particle_flags(flags: str, told: str | None) -> None:
    found = said("JK742", f"{SMOKE} typeflags={flags}")
    assert found == ([] if told is None else [f"template 3 (smoke) has typeflags={flags}, but {told} does nothing"])


def colour(arguments: str) -> list[Diagnostic]:
    cog = f"symbols\nmessage activated\nint fx local\nend\ncode\nactivated:\n fx = NewColorEffect({arguments});\nend"
    with level_with_files("World cogs 1", "0: fx.cog", "== cog/fx.cog", *cog.split("\n")) as level:
        return lint(level, [find_rule("JK750")])


@pytest.mark.parametrize(("arguments", "turns"), [
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0", "black"),
    ("0, 0, 0, 0, 0, 0, -1, 0, 0, 1.0", None),  # red saturates, and takes the rest with it: red alone
    ("0, 0, 0, 0, 0, 0, 290, 290, 290, 1.0", "white"),
    ("0, 0, 0, 0, 0, 0, 200, 200, 200, 1.0", None),
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1", None),
])  # fmt: skip
def test_effects_that_hide_everything(arguments: str, turns: str | None) -> None:
    found = colour(arguments)
    if arguments.split(", ")[6] == "-1":
        assert [d.message.rpartition(" ")[2] for d in found] == ["colour"]
    else:
        assert [d.message.rpartition(" ")[2] for d in found] == ([] if turns is None else [turns])


LAMP = [
    "World templates 4", "lamp none type=cog cog=lamp.cog", "World things 4", "2: lamp lamp .5 .5 .5 0 0 0 0",
    "== cog/lamp.cog", "symbols", "message created", "message pulse", "end", "code",
    "created: SetThingPulse(GetSenderRef(), 0.1); return;",
    "pulse: if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) Print(\"x\"); return;", "end",
]  # fmt: skip


@pytest.mark.parametrize(("budget", "told"), [(89.0, 1), (91.0, 0)])
def test_the_budget_can_be_set(budget: float, told: int) -> None:
    rule = find_rule("JK650")
    assert rule.options is not None
    with level_with_files(*LAMP) as level:
        # 10 calls of 9 surfaces on the mean.
        found = lint(level, [rule], options={"JK650": rule.options(surfaces=budget)})
    assert len(found) == told
    for each in found:
        assert each.message == (
            "class cog lamp.cog on 1 thing asks for sight up to 10 times a second, which tests some 90 surfaces, but "
            "the budget is 89"
        )


def test_items_out_of_reach_are_named_once_for_each_part() -> None:
    shut = ("World adjoins 2", "0: 0x5 1 1", "1: 0x5 0 1", "World cogs 0", "- 0: door.cog 3 -1 wind.wav")
    shields = ("World templates 4", "shield none type=item", "World things 5")
    placed = ("2: shield shield .5 1.5 .2 0 0 0 1", "3: shield shield .3 1.5 .2 0 0 0 1")
    (found,) = findings("JK226", *shut, *shields, *placed)
    assert found.message == (
        "thing 2 (shield) is an item in sector 1, with one more beside it, but no player start leads to that part of "
        "the level (one sector)"
    )
    assert len(found.related) == 1
    assert findings("JK226", *shields, *placed) == []


@pytest.mark.parametrize(("back", "size"), [
    ("0x5", "one sector"), ("0x7", "one sector, from which ways lead out, but none in"),
])  # fmt: skip
@pytest.mark.parametrize("code", ["JK226", "JK227"])
def test_a_part_that_only_leads_out_is_told_as_one(code: str, back: str, size: str) -> None:
    one_way = ("World adjoins 2", "0: 0x5 1 1", f"1: {back} 0 1", "World cogs 0", "- 0: door.cog 3 -1 wind.wav")
    shield = ("World templates 4", "shield none type=item", "World things 5", "2: shield shield .5 1.5 .2 0 0 0 1")
    (found,) = findings(code, *one_way, *(shield if code == "JK226" else ()))
    assert f"({size})" in found.message
