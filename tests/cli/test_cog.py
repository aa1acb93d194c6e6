"""`jktools cog`, and scripts in `jktools lint`, as a user sees them."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

import jktools
from jktools.cli import main
from jktools.facts.hotspots import CostSummary, frequency, mean_work
from tests.support.levels import ROOT, gob_of, two_rooms
from tests.support.scripts import corpus_scripts

DOOR = b"""# a door
flags=0x240
symbols
message startup
message activate
message pulse
message timer
thing door linkid=2 mask=0x404
flex wait=0.5
template spark=+spark local
end

code
startup:
    SetPulse(0.25);
    call opened;
activate:
    if (HasLOS(door, door) || HasLOS(door, door))
        NoSuchVerb(i);
    return;
pulse:
    Sleep(1);
    return;
opened:
    if (wait > 1) goto pulse;
    return;
end
"""
BROKEN = b"symbols\nend\ncode\nx = 1\ny = 2;\nend\n"

SHOWN = """p.gob!cog/door.cog: script for game jk, flags 0x240 (local, no sync)
  symbols (3):
    thing     door (linked, id 2, mask 0x404)
    flex      wait = 0.5
    template  spark = +spark (local)
  messages (4):
    startup: line 14
      sent once
    activate: line 17
      sent by the level or the player
    pulse: line 21, at most 241 times a minute by what the script does
      pulse of this script every 0.25 s, line 15 from startup
    timer: runs nothing
  labels (4): startup, activate, pulse, opened
  calls (3):
    startup falls into activate
    startup -> opened (call)
    opened -> pulse (goto)
  verbs (4):
    setpulse: 1 call, line 15
    haslos: 2 calls, line 18, 18; sight (ray): at most 2 a run of startup, 2 a run of activate
    nosuchverb: 1 call, line 19; no verb of this game
    sleep: 1 call, line 22; sleeps
p.gob!cog/broken.cog: script for game jk, flags 0x0
  refused by the engine; this is what could be read:
    line 5: the engine refuses this script: it stops reading at line 5
    line 4: expected a semicolon behind "1", but found "y"
  symbols (0):
  messages (0):
  labels (0)
  calls (0):
  verbs (0):
"""


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "p.gob").write_bytes(gob_of([("cog\\door.cog", DOOR), ("cog\\broken.cog", BROKEN)]))
    return tmp_path


def test_the_report_for_people(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cog", "p.gob"]) == 1  # the engine refuses one of them
    assert capsys.readouterr().out == SHOWN


def test_scripts_that_the_engine_takes_are_no_failure(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cog", "p.gob!cog/door.cog"]) == 0


def test_the_report_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cog", "p.gob!cog/door.cog", "p.gob!cog/broken.cog", "--json"]) == 1
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/cog.schema.json").read_text()))
    door, broken = report["scripts"]
    assert (door["rejected"], door["faults"]) == (False, [])
    assert door["messages"][2]["sources"][0]["least_seconds"] == 0.25
    assert [f["code"] for f in broken["faults"]] == ["JK050", "JK052"]


@pytest.mark.skipif(not list(corpus_scripts()), reason="the corpus of real mods is not at hand")
def test_every_real_script_fits_the_schema(corpus: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cog", corpus.as_posix(), "--json", "--config", "none"]) == 0
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/cog.schema.json").read_text()))
    assert len(report["scripts"]) == len(list(corpus_scripts()))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["cog", "no.cog"], "jktools: error: cannot read no.cog: no such file or folder\n"),
        (
            ["cog", "text.txt"],
            "jktools: error: nothing to read in text.txt: expected a .cog script",
        ),
        (["cog"], "Missing argument 'PATH...'"),
    ],
)
def test_wrong_arguments(words: list[str], message: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "text.txt").write_bytes(b"hello")
    assert main(words) == 2
    shown = capsys.readouterr()
    assert message in shown.err
    assert shown.out == ""


# ---- lint

LEVEL = two_rooms("World cogs 2", "0: broken.cog", "1: BROKEN.cog").encode()


def test_scripts_are_linted_once_each_with_the_levels_that_bind_them(here: Path) -> None:
    (here / "m.gob").write_bytes(gob_of([("jkl\\a.jkl", LEVEL), ("jkl\\b.jkl", LEVEL), ("cog\\Broken.cog", BROKEN)]))
    batch = jktools.check(["m.gob"])
    assert batch.files == 3
    refused = [d for d in batch if d.code.id == "JK050"]
    assert [d.path for d in refused] == ["m.gob!cog/Broken.cog"]
    one = jktools.check(["m.gob!jkl/a.jkl"])
    assert (one.files, [d.path for d in one if d.code.id == "JK050"]) == (2, ["m.gob!cog/Broken.cog"])
    found = jktools.lint(jktools.load("m.gob!jkl/a.jkl"))
    assert [d.path for d in found if d.code.id == "JK050"] == ["m.gob!cog/Broken.cog"]


@pytest.mark.parametrize("binding", [
    ("World templates 4", "lamp none type=cog cog=broken.cog"),
    ("World things 1", "0: crate crate 0 0 0 0 0 0 0 cog=BROKEN.cog"),
], ids=["template", "thing"])  # fmt: skip
def test_scripts_that_things_carry_are_linted_with_their_level(binding: tuple[str, str], here: Path) -> None:
    """A swing lamp's script is no placed one: the level's page and its lint alone tell of it all the same."""
    carrying = two_rooms(*binding).encode()
    (here / "m.gob").write_bytes(gob_of([("jkl\\a.jkl", carrying), ("cog\\broken.cog", BROKEN)]))
    one = jktools.check(["m.gob!jkl/a.jkl"])
    assert (one.files, [d.path for d in one if d.code.id == "JK050"]) == (2, ["m.gob!cog/broken.cog"])
    found = jktools.lint(jktools.load("m.gob!jkl/a.jkl"))
    assert [d.path for d in found if d.code.id == "JK050"] == ["m.gob!cog/broken.cog"]
    assert main(["report", "m.gob", "-o", "page.html"]) == 0
    assert "JK050" in Path("page.html").read_text("utf-8")


@pytest.mark.parametrize(
    ("level", "place"),
    [("mod/jkl/a.jkl", "mod/cog/broken.cog"), ("mod/a.jkl", "mod/cog/Broken.COG"), ("mod/a.jkl", "mod/broken.cog")],
)
def test_a_level_on_disk_finds_its_scripts_beside_it(level: str, place: str, here: Path) -> None:
    for path, data in ((level, LEVEL), (place, BROKEN)):
        (here / path).parent.mkdir(parents=True, exist_ok=True)
        (here / path).write_bytes(data)
    batch = jktools.check([level])
    assert batch.files == 2
    assert [d.path for d in batch if d.code.id == "JK050"] == [place]
    assert jktools.check(["mod"]).files == 2


def test_a_level_whose_scripts_are_the_games_own_is_linted_alone(here: Path) -> None:
    (here / "m.gob").write_bytes(gob_of([("jkl\\a.jkl", LEVEL)]))
    assert jktools.check(["m.gob"]).files == 1


def test_a_loose_script_is_linted_and_loaded(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "broken.cog").write_bytes(BROKEN)
    assert main(["lint", "broken.cog"]) == 1
    assert (
        'error[JK052]: expected a semicolon behind "1", but found "y"\n --> broken.cog:4:5' in capsys.readouterr().out
    )
    script = jktools.load_script("broken.cog")
    assert script.rejected
    assert [d.code.id for d in jktools.lint(script) if d.code.id.startswith("JK05")] == ["JK052", "JK050"]
    with pytest.raises(jktools.InputError, match=r"p.gob holds 2 scripts: name one of p.gob!cog/door.cog"):
        jktools.load_script("p.gob")


def test_comments_hide_findings_in_header_and_code(here: Path) -> None:
    hidden = b"""symbols
# jktools: ignore JK504 -- the level counts them
thing a
thing a # jktools: ignore duplicate-symbol -- both
end
code
// jktools: ignore JK523, JK539
1;
2; # jktools: ignore JK523
Print("// jktools: ignore-file JK523");
3;
end
"""
    (here / "x.cog").write_bytes(hidden)
    found = jktools.check(["x.cog"], jktools.Settings(select=("JK504", "JK523", "JK020", "JK021")))
    assert [(d.code.id, d.label.span.first.line) for d in found if d.label.span] == [("JK020", 2), ("JK523", 11)]


def test_configured_ignores_meet_scripts(here: Path) -> None:
    (here / "jktools.toml").write_text('[[ignore]]\ncode = "JK523"\npath = "cog/*"\nreason = "as ever"\n')
    (here / "x.cog").write_bytes(b"symbols\nend\ncode\n1;\nend\n")
    assert main(["lint", "x.cog", "--select", "JK523"]) == 1
    (here / "cog").mkdir()
    (here / "x.cog").rename(here / "cog/x.cog")
    assert main(["lint", "cog/x.cog", "--select", "JK523"]) == 0


LAMP = b"""symbols
message created
message pulse
end
code
created:
    SetThingPulse(GetSenderRef(), 0.1);
    return;
pulse:
    if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) SetThingLight(GetSenderRef(), 1.0, 0.1);
    return;
end
"""


def lamp_level(folder: Path) -> tuple[Path, Path]:
    text = two_rooms(
        "World templates 4", "lamp none type=cog cog=lamp.cog", "World things 4", "2: lamp lamp .5 .5 .5 0 0 0 0"
    )
    for name, data in (("cog/lamp.cog", LAMP), ("jkl/rooms.jkl", text.encode())):
        (folder / name).parent.mkdir()
        (folder / name).write_bytes(data)
    return folder / "cog/lamp.cog", folder / "jkl/rooms.jkl"


def test_a_level_brings_the_costs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script, level = lamp_level(tmp_path)
    assert main(["cog", str(script), "--level", str(level)]) == 0
    shown = capsys.readouterr()
    assert shown.err == (
        f"jktools: note: {level}: what these may send is not counted, since they are not at hand (--base): "
        "door.cog, items.dat, static.jkl\n"
    )
    # 10 pulses a second; the player is in the lamp's room (6 surfaces) or in the other (12 on the way).
    assert shown.out.splitlines()[-3:] == [
        "  costs of sight (1):",
        "    haslos, line 10, class cog lamp.cog on 1 thing: at most 10 times a second; "
        "9 surfaces in 1.5 sectors on the mean, 12 in 2 at most",
        "      test less often, or test the distance first",
    ]


@pytest.mark.parametrize(("calls", "more", "causes", "words"), [
    (4.0, False, (), "at most 4 times a second"),
    (1.0, False, (), "at most 1 time a second"),
    (None, False, (), "any number of times a second"),
    (0.0, False, (), "not after the start"),
    (0.0, True, (), "how often is not known"),
    (2.5, True, (), "at most 2.5 times a second, more often by what is not known"),
    (0.0, False, ("touched",), "after each touched"),
    (3.0, False, ("a", "b", "c", "d", "e"), "at most 3 times a second, after each a, b, c and 2 more"),
])  # fmt: skip
def test_how_often_is_said_as_a_bound(calls: float | None, more: bool, causes: tuple[str, ...], words: str) -> None:
    assert frequency(calls, more, causes) == words


def test_a_loop_that_sleeps_is_told_by_the_second(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script = tmp_path / "x.cog"
    loop = 'while (1) { if (HasLOS(0, 1) == 1) Print("x"); Sleep(0.25); }'
    script.write_text(f"symbols\nmessage startup\nend\ncode\nstartup: {loop} return;\nend\n")
    assert main(["cog", str(script)]) == 0
    assert "sight (ray): at most 1 a run of startup and 4 a second" in capsys.readouterr().out


def test_the_costs_as_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script, level = lamp_level(tmp_path)
    assert main(["cog", str(script), "--level", str(level), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    jsonschema.validate(told, json.loads((ROOT / "docs/cog.schema.json").read_text()))
    (cost,) = told["scripts"][0]["costs"]
    assert (cost["mean_surfaces"], cost["verdict"], cost["level"]) == (9, "varies", str(level))


def test_a_level_that_cannot_be_read_is_bad_usage(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script, _ = lamp_level(tmp_path)
    assert main(["cog", str(script), "--level", str(tmp_path / "none.jkl")]) == 2
    assert "none.jkl" in capsys.readouterr().err


def test_what_nothing_bounds_is_not_told_as_a_bound(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (
        b"symbols\nmessage startup\nmessage touched\nthing a\nend\ncode\n"
        b"startup:\n  while (1) HasLOS(a, a);\n  return;\ntouched:\n  HasLOS(a, a);\n  return;\nend\n"
    )
    (tmp_path / "x.cog").write_bytes(text)
    main(["cog", str(tmp_path / "x.cog")])
    shown = capsys.readouterr().out
    assert "at most 1 a run of touched, any number of times a run of startup" in shown


@pytest.mark.parametrize(("sectors", "surfaces", "words"), [
    (1.0, 6.0, "6 surfaces in 1 sector on the mean"),
    (1.5, 9.0, "9 surfaces in 1.5 sectors on the mean"),
    (1.0, 1.0, "1 surface in 1 sector on the mean"),
])  # fmt: skip
def test_work_counts_in_words(sectors: float, surfaces: float, words: str) -> None:
    cost = CostSummary(
        "x.jkl", "cog 1 (x.cog)", "haslos", 1, 1.0, False, (), sectors, surfaces, 1, 6, 1, "varies", {}, None, ""
    )
    assert mean_work(cost) == words
