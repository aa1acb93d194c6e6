"""Rules on sight, motion, light, particles and colour: what they say, where, and where their limits lie."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from jktools.diagnostics import Diagnostic
from jktools.linter import find_rule, lint
from jktools.session import load
from tests.support.levels import level_with_files, two_rooms
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


@pytest.mark.parametrize(("words", "told"), [
    ("airdrag=5", 0), ("airdrag=5.1", 1), ("surfdrag=20", 0), ("airdrag=20.1", 1),
])  # fmt: skip
def test_water_takes_four_times_the_drag_of_air(words: str, told: int) -> None:
    found = messages("JK720", "Sector 1", "Flags 0x2", "World templates 4", f"{GUARD} {words}")
    assert len(found) == told
    assert all(
        f"takes {4 * float(words.partition('=')[2]) / 10:g} times the speed under water" in each for each in found
    )
    assert (said("JK720", f"{GUARD} {words}") == []) is (float(words.partition("=")[2]) <= 20)


PLACED_GUARD = ("World things 4", "2: guard guard .5 .5 .5 0 0 0 0")


@pytest.mark.parametrize(("template", "line", "marks"), [
    ("surfdrag=3", "surfdrag=25", ["surfdrag=25"]),
    ("surfdrag=25", "surfdrag=3", ["surfdrag=25"]),  # the template's own
    ("surfdrag=25", "surfdrag=26", ["surfdrag=25", "surfdrag=26"]),
    ("surfdrag=25 maxthrust=0", "maxthrust=1", ["maxthrust=1"]),  # it moves after all
    ("surfdrag=25", "maxthrust=1", ["surfdrag=25"]),
    ("surfdrag=25", "maxthrust=0", ["surfdrag=25"]),
    ("surfdrag=3", "health=5", []),
])  # fmt: skip
def test_drag_on_the_line_of_a_thing(template: str, line: str, marks: list[str]) -> None:
    placed = (PLACED_GUARD[0], f"{PLACED_GUARD[1]} {line}")
    assert marked("JK720", "World templates 4", f"{GUARD} {template}", *placed) == marks


@pytest.mark.parametrize("word", ["surfdrag=-5", "airdrag=-1", "staticdrag=-.1"])
def test_the_engine_does_not_take_a_negative_drag(word: str) -> None:
    placed = (PLACED_GUARD[0], f"{PLACED_GUARD[1]} {word}")
    for lines in ((f"{GUARD} {word}", *PLACED_GUARD), (GUARD, *placed)):
        assert marked("JK412", "World templates 4", *lines) == [word]
        assert messages("JK720", "World templates 4", *lines) == []


def gets_away(maxthrust: float, static: float, fps: float, *, stopped_at: bool) -> bool:
    """A hundred frames of an AI that runs: it adds to the speed, then the floor takes what is too slow, then drag.

    In float32, as the engine; `stopped_at` is whether what is exactly as slow as `static` is too slow.
    """
    speed, least = np.float32(0), np.float32(static)
    for _ in range(100):
        speed += np.float32(maxthrust) * np.float32(1 / fps) * np.float32(2)
        slow = speed <= least if stopped_at else speed < least
        speed = np.float32(0) if slow and static else speed * np.float32(1 - 3 / fps)
    return bool(speed > 0)


AT_THE_BOUNDARY = [(12.499999, 0.5), (12.5, 0.5), (12.500001, 0.5), (12.5, 0.49999997), (12.5, 0.50000006)]
"""12.5 x 2 / 50 = 0.5; each neighbour is the next float32."""


@pytest.mark.parametrize(
    ("thrust", "static"),
    [(2, 0.3), (2, 0.081), (2, 0.08), (2, 0.07), (7.4, 0.3), (7.6, 0.3), (5, 0), *AT_THE_BOUNDARY],
)
def test_an_ai_must_push_more_than_static_drag_takes(thrust: float, static: float) -> None:
    line = f"{GUARD} aiclass=a.ai surfdrag=3 maxthrust={thrust} staticdrag={static}"
    research, decompiled = (gets_away(thrust, static, 50, stopped_at=at) for at in (True, False))
    found = said("JK721", line)
    assert (found == []) is (research and decompiled)
    assert all(("by the decompiled engine only what is slower" in each) is decompiled for each in found)


def test_static_drag_at_the_exact_boundary_is_told_by_each_profile() -> None:
    def of(thrust: str, static: str) -> list[str]:
        found = said("JK721", f"{GUARD} aiclass=a.ai surfdrag=3 maxthrust={thrust} staticdrag={static}")
        return [each.partition(" by up to ")[2] for each in found]

    frame = "JKU/s in a frame of 0.02 s (maxthrust x 2 / 50), but its staticdrag stops"
    assert of("12.5", ".5") == [
        f"0.5 {frame} by the research document also what has 0.5 JKU/s before it moves, by the decompiled engine only "
        "what is slower"
    ]
    assert of("12.5", ".50000006") == [f"0.5 {frame} what is slower than 0.5000001 JKU/s before it moves"]
    assert of("12.5", ".49999997") == []


def test_static_drag_matters_at_a_high_frame_rate_only() -> None:
    for at in (True, False):
        assert gets_away(2, 0.3, 10, stopped_at=at)
        assert not gets_away(2, 0.3, 50, stopped_at=at)


STUCK = f"{GUARD} aiclass=a.ai surfdrag=3 staticdrag=.3"


@pytest.mark.parametrize("line", [
    STUCK.replace("type=actor", "type=player"), STUCK.replace("0x4f", "0x200f"), STUCK.replace(" aiclass=a.ai", ""),
    STUCK.replace("surfdrag=3", "surfdrag=0"), STUCK.replace("maxthrust=2", "maxthrust=0"),
])  # fmt: skip
def test_who_static_drag_does_not_hold(line: str) -> None:
    """A player, who thrusts; what sticks to no floor; what no AI moves; without drag; without thrust."""
    assert len(said("JK721", STUCK)) == 1
    assert said("JK721", line) == []


@pytest.mark.parametrize(("instincts", "told"), [("", 0), ("follow 1 2 3\n", 1)])
def test_an_ai_without_instincts_moves_nobody(instincts: str, told: int) -> None:
    ai = ["== misc/ai/a.ai", "maxstep=0.5", *instincts.split("\n")]
    with level_with_files("World templates 4", STUCK, *ai) as level:
        assert len(lint(level, [find_rule("JK721")])) == told


def test_static_drag_names_both_sides() -> None:
    assert said("JK721", STUCK) == [
        "template 3 (guard) is pushed by its AI by up to 0.08 JKU/s in a frame of 0.02 s (maxthrust x 2 / 50), but its "
        "staticdrag stops what is slower than 0.3 JKU/s before it moves"
    ]
    placed = (PLACED_GUARD[0], f"{PLACED_GUARD[1]} staticdrag=.3")
    free = STUCK.replace(" staticdrag=.3", "")
    assert marked("JK721", "World templates 4", free, *placed) == ["staticdrag=.3"]


@pytest.mark.parametrize(("light", "told"), [(".69", 1), (".7", 0)])
def test_a_light_in_the_middle_of_a_room_must_reach_its_corners(light: str, told: int) -> None:
    # The corners are sqrt(3) / 2 away: 0.8 times that is 0.6928.
    found = said("JK730", f"lamp none type=cog light={light}", "World things 4", "2: lamp lamp .5 .5 .5 0 0 0 0")
    assert len(found) == told


def test_a_light_that_ends_just_short_of_a_vertex_is_told_by_figures_that_differ() -> None:
    (told,) = said("JK730", "lamp none type=cog light=.6928203", "World things 4", "2: lamp lamp .5 .5 .5 0 0 0 0")
    reach, nearest = float(np.float32(0.6928203)) / 0.8, 0.75**0.5
    assert f"{reach:.6g}" == f"{nearest:.6g}" == "0.866025"
    read = [float(each) for each in re.findall(r"0\.866\d*", told)]
    assert read == pytest.approx([reach, nearest], abs=5e-9)
    assert read[0] < read[1]


SMOKE = "smoke none type=particle timer=1 material=m.mat range=.1 elementsize=.01 count=9"
PLACED = ("World things 4", "2: smoke smoke .5 .5 .5 0 0 0 0")


@pytest.mark.parametrize(("cut", "lacks"), [(" count=9", "no count"), (" elementsize=.01", "no elementsize")])
def test_particles_need_a_count_and_a_size(cut: str, lacks: str) -> None:
    line = SMOKE.replace(cut, "")
    assert said("JK740", line, *PLACED) == [f"template 3 (smoke) makes particles, but has {lacks}"]
    # What nothing creates can be a base for others.
    assert said("JK740", line) == []


def test_a_count_of_0_is_shown_as_written() -> None:
    line = SMOKE.replace("count=9", "count=0")
    assert said("JK740", line, *PLACED) == ["template 3 (smoke) makes particles, but has count=0"]
    assert marked("JK740", "World templates 4", line, *PLACED) == ["count=0"]


BARE = SMOKE.replace(" count=9", "")


@pytest.mark.parametrize(("template", "line", "told"), [
    (SMOKE, "count=0", ["thing 2 (smoke) makes particles, but has count=0"]),
    (SMOKE, "elementsize=0", ["thing 2 (smoke) makes particles, but has elementsize=0"]),
    (BARE, "count=9", []),  # nobody makes it without
    (BARE, "range=.2", ["template 3 (smoke) makes particles, but has no count"]),
    (BARE, "count=0", ["template 3 (smoke) makes particles, but has no count"]),
    (BARE, "count=9 elementsize=0", ["thing 2 (smoke) makes particles, but has elementsize=0"]),
])  # fmt: skip
def test_particles_on_the_line_of_a_thing(template: str, line: str, told: list[str]) -> None:
    assert said("JK740", template, PLACED[0], f"{PLACED[1]} {line}") == told


def test_a_template_that_one_thing_mends_and_another_does_not() -> None:
    things = ("World things 5", f"{PLACED[1]} count=9", "3: smoke smoke .5 .5 .5 0 0 0 0")
    assert said("JK740", BARE, *things) == ["template 3 (smoke) makes particles, but has no count"]


def test_a_child_only_inherits() -> None:
    both = ("World things 5", PLACED[1], "3: fog fog .5 .5 .5 0 0 0 0")
    assert len(messages("JK740", "World templates 5", BARE, "fog smoke range=.2", *both)) == 1
    alone = ("World things 5", "3: fog fog .5 .5 .5 0 0 0 0")
    assert messages("JK740", "World templates 5", BARE, "fog smoke range=.2", *alone) == [
        "template 4 (fog) makes particles, but has no count"
    ]


@pytest.mark.parametrize("code", ["JK740", "JK743", "JK744"])
def test_a_cloud_from_a_file_has_its_values_from_there(code: str) -> None:
    line = "smoke none type=particle timer=1 particle=ball.par count=-1"
    assert said(code, line, *PLACED) == []


def test_what_a_template_that_is_not_at_hand_may_hold_is_not_missing() -> None:
    line = "smoke +fog type=particle timer=1 minsize=1"
    for code in ("JK740", "JK741", "JK744"):
        assert said(code, line, *PLACED) == []


@pytest.mark.parametrize(("old", "new", "message"), [
    (" material=m.mat", "", "with no material, but the decompiled engine crashes without a material"),
    ("count=9", "count=-9", "with count=-9, but the decompiled engine crashes without a count from 0 to 256"),
    ("count=9", "count=0", None), ("count=9", "count=256", None),
])  # fmt: skip
def test_a_negative_count_and_no_material_are_one_finding(old: str, new: str, message: str | None) -> None:
    lines = ("World templates 4", SMOKE.replace(old, new), *PLACED)
    expected = [] if message is None else [f"template 3 (smoke) makes particles {message}"]
    assert messages("JK744", *lines) == expected
    if message is not None:
        assert [m for code in ("JK740", "JK741", "JK742", "JK743") for m in messages(code, *lines)] == []


def test_minsize_may_equal_range() -> None:
    assert said("JK741", f"{SMOKE} minsize=.1") == []
    assert said("JK741", f"{SMOKE} minsize=.11") == ["template 3 (smoke) has minsize 0.11, but range 0.1"]
    assert said("JK741", f"{SMOKE} minsize=.05", PLACED[0], f"{PLACED[1]} range=.04") == [
        "thing 2 (smoke) has minsize 0.05, but range 0.04"
    ]
    # The sign is the fault, and JK743 tells it.
    assert said("JK741", f"{SMOKE} range=-.1") == []


@pytest.mark.parametrize(("word", "told"), [
    ("yawrange=180", None), ("yawrange=180.5", "from 0 to 180"), ("pitchrange=-1", "from 0 to 180"),
    ("rate=0", None), ("rate=-1", "0 or more"), ("elementsize=-.1", "0 or more"), ("maxthrust=-1", "0 or more"),
])  # fmt: skip
def test_particle_values_have_ranges(word: str, told: str | None) -> None:
    key = word.partition("=")[0]
    held = [] if told is None else [f"has {word}, but a particle's {key} is {told}"]
    assert said("JK743", f"{SMOKE} {word}") == [f"template 3 (smoke) {each}" for each in held]
    assert said("JK743", SMOKE, PLACED[0], f"{PLACED[1]} {word}") == [f"thing 2 (smoke) {each}" for each in held]


@pytest.mark.parametrize(("flags", "told"), [("0x3f", "0x2"), ("0x42", "0x42"), ("0x2d", None)])
def test_idle_particle_flags(flags: str, told: str | None) -> None:
    found = said("JK742", f"{SMOKE} typeflags={flags}")
    assert found == ([] if told is None else [f"template 3 (smoke) has typeflags={flags}, but {told} does nothing"])
    placed = said("JK742", SMOKE, PLACED[0], f"{PLACED[1]} typeflags={flags}")
    assert placed == [each.replace("template 3", "thing 2") for each in found]


def colour(arguments: str) -> list[Diagnostic]:
    cog = f"symbols\nmessage activated\nint fx local\nend\ncode\nactivated:\n fx = NewColorEffect({arguments});\nend"
    with level_with_files("World cogs 1", "0: fx.cog", "== cog/fx.cog", *cog.split("\n")) as level:
        return lint(level, [find_rule("JK750")])


@pytest.mark.parametrize(("arguments", "turns"), [
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0", "black"),
    ("0, 0, 0, 0, 0, 0, 290, 290, 290, 1.0", "white"),
    ("0, 0, 0, 0, 0, 0, 200, 200, 200, 1.0", None),
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1", None),
    ("0, 0, 0, 0, 0, 0, -255, -255, -255, 1.0", "white by the research document, black by the decompiled engine in "
     "software, not by the decompiled engine in hardware"),
    ("0, 0, 0, 0, 0, 0, 247, 247, 247, 1.0", "white by the decompiled engine, not by the research document"),
    ("0, 0, 0, 0, 0, 0, -1, -1, -1, 1.0", "white by the research document, not by the decompiled engine"),
])  # fmt: skip
def test_effects_that_hide_everything(arguments: str, turns: str | None) -> None:
    found = [d.message for d in colour(arguments)]
    says = "cog 0 (fx.cog) makes a colour effect to see by, but it turns all that is seen"
    assert found == ([] if turns is None else [f"{says} {turns}"])


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


SEEN = 'if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) Print("x");'


@pytest.mark.parametrize(("body", "told"), [
    ("created: SetThingTimer(GetSenderRef(), 0.01); return;"
     f"timer: {SEEN} SetThingTimer(GetSenderRef(), 0.01); return;", "0.01"),
    ("created: SetThingTimer(GetSenderRef(), 0.02); return;"
     f"timer: {SEEN} SetThingTimer(GetSenderRef(), 0.02); return;", None),
    (f"created: SetThingTimer(GetSenderRef(), 0.01); return; timer: {SEEN} return;", None),
    (f"created: SetThingPulse(GetSenderRef(), 0.01); return; pulse: {SEEN} return;", "0.01"),
    (f"created: SetThingPulse(GetSenderRef(), 0.01); return; pulse: {SEEN} SetThingPulse(GetSenderRef(), 0); return;",
     None),
    (f"startup: SetPulse(0.01); return; pulse: {SEEN} SetPulse(0); return;", None),
    # Below 0 a thing's pulse comes every frame; a script's is off. SetTimerEx takes 0 for the next frame.
    (f"created: SetThingPulse(GetSenderRef(), -1); return; pulse: {SEEN} return;", "0"),
    (f"startup: SetPulse(-1); return; pulse: {SEEN} return;", None),
    (f"startup: SetTimerEx(0, 1, 0, 0); return; timer: {SEEN} SetTimerEx(0, 1, 0, 0); return;", "0"),
    (f"startup: SetTimerEx(0, 1, 0, 0); return; timer: {SEEN} return;", None),
    (f"startup: SetPulse(Rand()); return; pulse: {SEEN} return;", None),
    (f"startup: while (1) {{ {SEEN} Sleep(0.01); }} return;", "0.01"),
    (f"startup: while (1) {{ {SEEN} Sleep(0.01); Sleep(0.01); }} return;", None),
    (f"startup: while (1) {{ {SEEN} call nap; }} return; nap: Sleep(0.005); Sleep(0.01); return;", "0.015"),
    (f"startup: while (1) {{ {SEEN} Sleep(0); }} return;", None),
    (f"startup: while (1) {{ {SEEN} Sleep(Rand()); }} return;", None),
])  # fmt: skip
def test_looks_in_every_frame(body: str, told: str | None) -> None:
    messages_ = [f"message {name}" for name in ("startup", "created", "pulse", "timer")]
    script = [*LAMP[: LAMP.index("symbols") + 1], *messages_, "end", "code", body, "end"]
    with level_with_files(*script) as level:
        found = lint(level, [find_rule("JK660")])
    expected = f"class cog lamp.cog on 1 thing tests sight every {told} s, but a frame takes 0.02 s"
    assert [d.message for d in found] == ([] if told is None else [expected])


def test_a_costly_loop_that_the_player_starts_is_over_the_budget_only_if_it_never_ends() -> None:
    """Of one that may end, nobody knows how often it turns."""
    rule = find_rule("JK650")

    def found(condition: str) -> list[str]:
        body = f"created: while ({condition}) {{ {SEEN} }} return;"
        with level_with_files(*LAMP[: LAMP.index("code") + 1], body, "end") as level:
            return [d.message for d in lint(level, [rule])]

    assert found("Rand() < 0.5") == []
    assert found("1") == [
        "class cog lamp.cog on 1 thing asks for sight any number of times a second, which tests any number of "
        "surfaces, but the budget is 20000"
    ]


def test_costs_of_scripts_that_the_mod_does_not_bring_are_not_its_fault(tmp_path: Path) -> None:
    script = "\n".join([*LAMP[LAMP.index("symbols") :], ""]).replace("0.1", "0.0001")
    for place in ("mod/jkl", "mod/cog", "game/cog", "game/jkl"):
        (tmp_path / place).mkdir(parents=True)
    (tmp_path / "mod/jkl/rooms.jkl").write_text(two_rooms(*LAMP[: LAMP.index("== cog/lamp.cog")]))
    rule = find_rule("JK660")
    for home, told in (("game", 0), ("mod", 1)):
        (tmp_path / home / "cog/lamp.cog").write_text(script)
        level = load(str(tmp_path / "mod/jkl/rooms.jkl"), base=[str(tmp_path / "game")])
        assert len(lint(level, [rule])) == told


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
