"""`jktools template`: the whole text, the JSON against its schema, and what cannot be found."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from jktools.cli import main
from tests.support.levels import ROOT, two_rooms

LIBRARY = """# a library
base none type=weapon move=physics size=.1 damage=5
bolt base damage=9,light=1 thingflags=0x4 health=3 explode=boom fov=1
lamp bolt type=cog
mine bolt type=explosion
"""


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x.tpl").write_text(LIBRARY)
    level = two_rooms("World things 4", "2: crate crate .5 .5 .5 0 45 0 0 size=.3 damage=1")
    (tmp_path / "rooms.jkl").write_text(level)
    return tmp_path


def out(capsys: pytest.CaptureFixture[str], *words: str, status: int = 0) -> str:
    assert main(["template", *words]) == status
    captured = capsys.readouterr()
    return captured.err if status else captured.out


EXPLAINED = """bolt, template 1 of x.tpl
  bolt <- base <- none

  base  2:11  type        weapon
  base  2:23  move        physics
  base  2:36  size        .1              JKU
  bolt  3:28  thingflags  0x4
  bolt  3:20  light       1
  base  2:36  movesize    .1              JKU; by size=.1
  bolt  3:52  explode     boom (nothing)
  bolt  3:11  damage      9               was 5 from base

  nothing comes of:
  bolt  3:43  health=3      it is for type actor or player, but this is type weapon, move physics
  bolt  3:52  explode=boom  no template of that name stands above
  bolt  3:65  fov=1         it is for type actor or player, but this is type weapon, move physics
"""


def test_a_template_is_explained(capsys: pytest.CaptureFixture[str]) -> None:
    assert out(capsys, "x.tpl", "BOLT") == EXPLAINED


def test_memory_that_changes_hands_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert "in memory, but unused:\n  bolt  3:11  damage=9      it is for type weapon" in out(capsys, "x.tpl", "lamp")
    text = out(capsys, "x.tpl", "mine")
    assert "lost on the way:\n  bolt  3:11  damage=9      type=explosion gives its memory away" in text


def test_a_thing_shows_what_its_line_changes(capsys: pytest.CaptureFixture[str]) -> None:
    text = out(capsys, "rooms.jkl", "2")
    assert text.startswith("thing 2 (crate) of rooms.jkl\n  thing 2 <- crate <- none\n")
    assert "size      .3        JKU; was .1 from crate\n" in text
    assert "orient    (0/45/0)  degrees\n" in text
    assert "damage=1  it is for type weapon or type explosion, but this is type cog, move none\n" in text


@pytest.mark.parametrize(
    ("path", "name"), [("x.tpl", "bolt"), ("x.tpl", "mine"), ("rooms.jkl", "2"), ("x.tpl", "lamp")]
)
def test_the_json_fits_its_schema(capsys: pytest.CaptureFixture[str], path: str, name: str) -> None:
    report = json.loads(out(capsys, path, name, "--json"))
    jsonschema.validate(report, json.loads((ROOT / "docs/template.schema.json").read_text()))
    assert report["path"] == path
    if name == "bolt":
        (damage,) = (p for p in report["parameters"] if p["key"] == "damage")
        assert (damage["value"], damage["before"], damage["origins"][0]["line"]) == (9, "5", 3)
        assert [i["reason"] for i in report["ignored"]] == ["not_for_this", "unresolved", "not_for_this"]


def test_whether_the_level_reaches_it_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert "\n  reached: thing 2 (crate) is placed\n" in out(capsys, "rooms.jkl", "crate")
    assert json.loads(out(capsys, "rooms.jkl", "crate", "--json"))["reached"] == "thing 2 (crate) is placed"
    assert json.loads(out(capsys, "rooms.jkl", "2", "--json"))["reached"] is None


def test_a_long_line_of_ancestors_is_cut(capsys: pytest.CaptureFixture[str], here: Path) -> None:
    (here / "deep.tpl").write_text("t0 none type=cog\n" + "".join(f"t{i} t{i - 1}\n" for i in range(1, 3000)))
    line = out(capsys, "deep.tpl", "t2999").splitlines()[1]
    assert line.startswith("  t2999 <- t2998 <-")
    assert " <- ... (3000) <- " in line
    assert line.endswith(" <- t0 <- none")
    assert len(line) < 300


def test_without_a_name_the_templates_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert out(capsys, "x.tpl").splitlines() == [
        "0  base  <- none  weapon", "1  bolt  <- base  weapon", "2  lamp  <- bolt  cog", "3  mine  <- bolt  explosion",
    ]  # fmt: skip


@pytest.mark.parametrize(("words", "told"), [
    (("x.tpl", "bolts"), 'x.tpl has no template bolts; did you mean "bolt"?'),
    (("x.tpl", "zzz"), "x.tpl has no template zzz; `jktools template LEVEL` lists them"),
    (("rooms.jkl", "77"), "rooms.jkl places no thing with number 77"),
    (("no.jkl", "bolt"), "no.jkl"),
    (("x.tpl", "--json"), "--json needs the NAME"),
])  # fmt: skip
def test_what_is_not_there_is_told(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], told: str) -> None:
    assert told in out(capsys, *words, status=2)


def test_a_level_without_templates_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    empty = tmp_path / "empty.tpl"
    empty.write_text("# nothing yet\n")
    assert main(["template", str(empty)]) == 0
    assert capsys.readouterr().out == f"{empty} has no templates\n"
