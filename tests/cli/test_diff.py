"""`jktools diff`: whole outputs, exit statuses, sources and compiled levels alike."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from jktools.cli import main
from tests.support.levels import ROOT, TWO_ROOMS, two_rooms

EDITED = two_rooms(
    "World templates 3", "crate ghost size=.5 typeflags=0x7",
    "World things 3", "1: ghost watcher .5 1.5 .25 0 90 0 1", "2: crate crate .5 1.5 .75 0 0 0 1",
    "Sector 0", "Ambient Light .25",
)  # fmt: skip


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.jkl").write_text(TWO_ROOMS)
    (tmp_path / "b.jkl").write_text(EDITED)
    (tmp_path / "broken.jkl").write_text(two_rooms("World adjoins 2", "0: 0x7 5 1"))
    return tmp_path


def test_the_whole_text(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diff", "a.jkl", "b.jkl"]) == 1
    assert capsys.readouterr().out == WHOLE


WHOLE = """\
a.jkl and b.jkl differ: 1 sector changed, 1 template changed, 2 things added, 1 thing removed
geometry:
  sector 0: ambient_light 0.5 -> 0.25
templates:
  template 2 (crate):
    parent none -> ghost
    type 7 -> 8
    type cog (by crate) -> ghost (by ghost)
    collide 1 (by crate) -> not set
    size 0.1 (by crate) -> 0.5 (by crate)
    movesize 0.1 (by crate) -> 0.5 (by crate)
    unused () -> (typeflags, 0x7)
things:
  thing 1 (watcher): added
  thing 1 (ghost): removed
  thing 2 (crate): added
"""


def test_compiled_and_sources_alike(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "a.jkl", "-o", "a.jklb", "--accuracy", "exact", "--skip", "cogs", "-q"]) == 0
    assert main(["build", "b.jkl", "-o", "b.jklb", "-q"]) == 0
    (here / "a.jklb").rename(here / "a.bin")
    assert main(["diff", "a.bin", "a.jkl"]) == 0
    assert capsys.readouterr().out == "a.bin and a.jkl: no difference\n"
    assert main(["diff", "a.jkl", "a.bin"]) == 0
    assert main(["diff", "b.jklb", "b.jkl", "--json"]) == 0
    capsys.readouterr()
    assert main(["diff", "a.bin", "b.jklb", "--json"]) == 1
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/diff.schema.json").read_text()))
    assert not report["same"]
    assert report["differences"][0]["kind"] == "settings"
    assert {each["section"] for each in report["differences"]} >= {"settings", "geometry", "things", "cogs", "passes"}


def test_the_other_way_round_the_same_records_differ(capsys: pytest.CaptureFixture[str]) -> None:
    reports = []
    for pair in (["a.jkl", "b.jkl"], ["b.jkl", "a.jkl"]):
        assert main(["diff", *pair, "--json"]) == 1
        reports.append(json.loads(capsys.readouterr().out)["differences"])
    opposite = {"added": "removed", "removed": "added", "changed": "changed"}
    there = {(d["kind"], d["change"], d["before"], d["after"]) for d in reports[0]}
    back = {(d["kind"], opposite[d["change"]], d["after"], d["before"]) for d in reports[1]}
    assert there == back


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("diff a.jkl", "Missing argument 'B'"),
        ("diff a.jkl none.jkl", "cannot read none.jkl"),
        ("diff none.jklb a.jkl", "cannot read none.jklb: no such file or directory"),
        ("diff a.jkl broken.jkl", "cannot compile broken.jkl: geometry.adjoin_mirror 0 is 5"),
        ("diff a.jkl .", "holds 3 levels: name one of"),
        ("diff a.jkl b.jkl --accuracy best", "'best' is not one of"),
    ],
)
def test_bad_usage_is_one_sentence(words: str, told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words.split()) == 2
    shown = capsys.readouterr()
    assert told in shown.err
    assert "Traceback" not in shown.err
    assert shown.out == ""


def test_many_records_are_cut_short_unless_all_are_asked_for(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = TWO_ROOMS.split("\n")
    first = lines.index("World vertices 12") + 1
    for i in range(first, first + 12):
        label, x, y, z = lines[i].split()
        lines[i] = f"{label} {x} {y} {float(z) + 2}"
    (here / "c.jkl").write_text("\n".join(lines))
    assert main(["diff", "a.jkl", "c.jkl"]) == 1
    short = capsys.readouterr().out
    assert main(["diff", "a.jkl", "c.jkl", "--all"]) == 1
    whole = capsys.readouterr().out
    assert "  and 2 more vertices changed\n" in short
    assert whole.count(", 2 JKU\n") == 12
    assert short.count(", 2 JKU\n") == 10
