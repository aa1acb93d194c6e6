"""Rules on the meaning of scripts, beyond the examples of their docs."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

from jktools.diagnostics import Diagnostic, Severity
from jktools.linter import find_rule, lint, rules
from jktools.linter.rule import facts_of
from jktools.model.cog.verbs import verb_from
from jktools.session import Settings, check, load
from tests.support.levels import FILE, level_with_files, two_rooms
from tests.support.scripts import corpus_scripts, script_findings, script_of

CORPUS = list(corpus_scripts())
SWITCH = ["symbols", "message startup", "surface panel", "thing lift", "end", "code"]


def level_findings(code: str, *fragment: str) -> list[Diagnostic]:
    with level_with_files(*fragment) as level:
        return lint(level, [find_rule(code)])


def test_names_are_suggested() -> None:
    code = [
        "symbols",
        "message startup",
        "thing elevator",
        "end",
        "code",
        "startup: MoveToFrme(elevater, 1, 2); return;",
    ]
    (name,) = script_findings("JK530", *code, "end")
    assert (name.message, name.help) == (
        'nothing declares or assigns "elevater", so that it is always 0 here', 'did you mean "elevator"?',
    )  # fmt: skip
    (verb,) = script_findings("JK531", *code, "end")
    assert (verb.message, verb.help) == ('there is no verb "movetofrme"', 'did you mean "movetoframe"?')


def test_one_report_a_name_with_its_other_places() -> None:
    (found,) = script_findings("JK531", "startup: Foo(1); Foo(2); Foo(3);")
    assert len(found.related) == 2


def test_names_that_an_array_can_reach_are_not_called_unassigned() -> None:
    code = ["symbols", "message startup", "int a local", "end", "code"]
    assert script_findings("JK530", *code, "startup: a[1] = 5; Print(b); return;", "end") == []
    assert len(script_findings("JK530", *code, "startup: a = 5; Print(b); return;", "end")) == 1


def test_nothing_is_called_missing_where_code_could_not_be_read() -> None:
    broken = ["symbols", "message startup", "message pulse", "end", "code"]
    broken += ["startup: SetPulse(1 2 3; x = y; return;", "end"]
    assert script_of("\n".join([*broken, ""])).rejected
    for code in ("JK530", "JK535", "JK536", "JK537", "JK602", "JK603", "JK604", "JK608", "JK609"):
        assert script_findings(code, *broken) == []


def test_a_verb_of_the_users_own_build_is_known_and_checked() -> None:
    script = script_of("symbols\nmessage startup\nend\ncode\nstartup: jackLogVel(1, 2); return;\nend\n")
    own = {"jacklogvel": verb_from("jacklogvel", ("thing",), "void")}
    assert [d.code.id for d in lint(script, [find_rule("JK531"), find_rule("JK533")])] == ["JK531"]
    found = lint(script, [find_rule("JK531"), find_rule("JK533")], facts_of(script, own))
    assert [d.message for d in found] == ["jacklogvel takes 1 argument, but 2 are given"]


def test_verbs_of_the_configuration_reach_the_rules(tmp_path: Path) -> None:
    (tmp_path / "x.cog").write_text("symbols\nmessage startup\nend\ncode\nstartup: logit(); return;\nend\n")
    path = str(tmp_path / "x.cog")
    assert [d.code.id for d in check([path], Settings(select=("JK531",)))] == ["JK531"]
    settings = Settings(select=("JK531",), verbs={"logit": verb_from("logit", (), "void")})
    assert list(check([path], settings)) == []


@pytest.mark.parametrize(
    ("condition", "told"),
    [
        ("HasLOS(turret, target)", True),
        ("!HasLOS(turret, target)", True),
        ("HasLOS(turret, target) && 1", True),
        ("HasLOS(turret, target) == 1", False),
        ("HasLOS(turret, turret)", False),
        ("HasLOS(turret, GetLocalPlayerThing())", False),
    ],
)
def test_sight_taken_for_true(condition: str, told: bool) -> None:
    found = script_findings(
        "JK606", "symbols", "message pulse", "thing turret", "thing target local", "end", "code",
        f"pulse: target = FirstThingInView(turret, 90, 10, 4); if ({condition}) Print(1); return;", "end",
    )  # fmt: skip
    assert bool(found) is told


@pytest.mark.parametrize("test", ["target != -1", "target > -1", "target >= 0", "!(target == -1)", "-1 != target"])
def test_a_test_against_none_makes_sight_safe(test: str) -> None:
    found = script_findings(
        "JK606", "symbols", "message pulse", "thing turret", "thing target local", "end", "code",
        f"pulse: target = NextThingInView(); if ({test}) if (HasLOS(turret, target)) Print(1); return;", "end",
    )  # fmt: skip
    assert found == []


@pytest.mark.parametrize(("interval", "told"), [("0.02", False), ("0.0199", True), ("0.021", False)])
def test_a_pulse_of_just_a_frame_is_kept(interval: str, told: bool) -> None:
    code = ("startup:", f"SetPulse({interval});", "return;", "pulse:", "return;", "end")
    found = script_findings("JK601", "symbols", "message startup", "message pulse", "end", "code", *code)
    assert bool(found) is told


def test_too_deep_calls_count_to_four() -> None:
    def chain(depth: int) -> list[Diagnostic]:
        subs = [f"s{i}: {f'call s{i + 1};' if i < depth else 'Print(1);'} return;" for i in range(1, depth + 1)]
        return script_findings(
            "JK557", "symbols", "message startup", "end", "code", "startup: call s1; return;", *subs, "end"
        )

    assert chain(4) == []
    assert len(chain(5)) == 1


def test_every_later_cog_is_misled_by_a_refused_script() -> None:
    (found,) = level_findings(
        "JK654", "World cogs 4", "0: ask.cog 3", "1: broken.cog", "2: ask.cog 0", "3: ask.cog 2",
        f"{FILE}cog/broken.cog", "symbols", "end", "code", "end", f"{FILE}cog/ask.cog",
        "symbols", "cog other", "end", "code", ";", "end",
    )  # fmt: skip
    assert found.message == "the engine refuses the script of cog 1 (broken.cog), so that the 2 cogs behind it get " + (
        "numbers one lower"
    )
    assert [r.message.partition(" (")[0] for r in found.related] == ["cog 0", "cog 3"]


def test_values_point_at_their_word() -> None:
    (found,) = level_findings(
        "JK653", "World cogs 1", "0: a.cog 1  77", f"{FILE}cog/a.cog", *SWITCH, "startup: return;", "end"
    )
    assert found.label.span is not None and found.label.span.text == "77"
    assert found.message == "cog 0 (a.cog) gives lift thing 77, but the level has no thing 77"


def test_frames_come_from_the_template_when_the_thing_has_none() -> None:
    def moved(frame: int, template: str) -> list[Diagnostic]:
        return level_findings(
            "JK655", "World templates 4", f"lamp none type=cog {template}", "World things 3",
            "1: lamp lamp .5 1.5 .5 0 0 0 1", "World cogs 1", "0: a.cog 1 1", f"{FILE}cog/a.cog", *SWITCH,
            f"startup: MoveToFrame(lift, {frame}, 2.0); return;", "end",
        )  # fmt: skip

    two = "move=path numframes=2 frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)"
    assert moved(1, two) == []
    assert [d.message for d in moved(2, two)] == [
        "cog 0 (a.cog) moves thing 1 (lamp) to frame 2 with movetoframe, but it has 2 frames, from 0"
    ]
    assert len(moved(0, "")) == 1


def material(cels: int) -> bytes:
    """A MAT of solid colours."""
    head = struct.pack("<4s4I14I", b"MAT ", 0x32, 0, cels, 0, 8, *[0] * 13)
    return head + b"".join(struct.pack("<6I", 0, i, 0, 0, 0, 0) for i in range(cels))


@pytest.mark.parametrize(("cel", "told"), [(0, False), (1, False), (2, True)])
def test_cels_of_the_material_that_the_level_gives(tmp_path: Path, cel: int, told: bool) -> None:
    (tmp_path / "jkl").mkdir()
    (tmp_path / "cog").mkdir()
    (tmp_path / "mat").mkdir()
    (tmp_path / "jkl/test.jkl").write_text(two_rooms("World cogs 1", "0: a.cog 0 1"))
    (tmp_path / "cog/a.cog").write_text("\n".join([*SWITCH, f"startup: SetWallCel(panel, {cel}); return;", "end", ""]))
    level = load(str(tmp_path / "jkl/test.jkl"))
    (tmp_path / "mat" / level.materials[level.surfaces[0].material]).write_bytes(material(2))
    level = load(str(tmp_path / "jkl/test.jkl"))
    assert bool(lint(level, [find_rule("JK656")])) is told


@pytest.mark.skipif(not CORPUS, reason="the corpus is not at hand")
def test_no_rule_fails_on_a_mutilated_corpus_script() -> None:
    """Each script cut off at many places, and with each third line gone."""
    on_scripts = [r for r in rules() if r.code.id.startswith(("JK5", "JK6"))]
    for name, data in CORPUS[:20]:
        lines = data.split(b"\n")
        pieces = [data[: len(data) * k // 7] for k in range(1, 7)]
        pieces += [b"\n".join(line for i, line in enumerate(lines) if i % 3 != k) for k in range(3)]
        for piece in pieces:
            assert [d for d in lint(script_of(piece, name), on_scripts) if d.code.id == "JK901"] == []


def test_a_verb_of_another_game_that_takes_nothing_does_no_harm() -> None:
    found = script_findings("JK532", "startup:", "jkSyncForcePowers();", "WorldFlash(1.0, 0.5);", "return;")
    assert [(d.severity, d.message.partition(" ")[0]) for d in found] == [
        (Severity.WARNING, '"jksyncforcepowers"'), (Severity.ERROR, '"worldflash"'),
    ]  # fmt: skip


@pytest.mark.parametrize(("loop", "told"), [
    (["while (1)", "{", "Sleep(0.5);", "}"], 0),
    (["while (1)", "{", "Sleep(0.5);", "if (x > 10) stop;", "}"], 0),
    (["while (1)", "{", "Sleep(0.5);", "}", "x = 2;"], 0),
    (["while (x < 10)", "{", "Sleep(0.5);", "x = x + Rand();", "}"], 1),
    (["while (x < 10)", "{", "Sleep(0.5);", "x = x + Rand();", "}", "x = 2;"], 1),
])  # fmt: skip
def test_a_loop_without_end_runs_on_into_no_handler(loop: list[str], told: int) -> None:
    script = ["symbols", "message startup", "message activate", "flex x local", "end", "code"]
    code = ["startup:", *loop, "activate:", 'Print("active");', "return;", "end"]
    assert len(script_findings("JK552", *script, *code)) == told
