"""`jktools trace` as a user meets it."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.cli import main
from tests.support.levels import TWO_ROOMS

SCRIPT = "0 walk forward\n2 release\n2.5 jump\n4 end\n"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "walk.txt").write_text(SCRIPT)
    return tmp_path


def test_run_then_fit(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["trace", "run", "walk.txt", "--fps", "50", "-o", "walk.csv"]) == 0
    out = capsys.readouterr()
    assert out.out == "" and out.err.splitlines()[0] == "2.520 s: leaves the ground"
    assert main(["trace", "fit", "walk.csv", "--to", "2.4", "--drag", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "semi-implicit-euler, engine, verlet" in lines[-2]
    assert lines[3].split(", ")[0] == "explicit-euler" and "3 (3 .. 3)" in lines[3] and "1 (1 .. 1)" in lines[3]
    assert lines[-1].startswith("static threshold: at least 0.29")


def test_csv_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["trace", "run", "walk.txt", "--fps", "10", "--scheme", "rk4", "--engine", "openjkdf2"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("time,thrust_x") and len(lines) == 42


def test_a_blow_up_is_noted(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["trace", "run", "walk.txt", "-o", "a.m", "--set", "surfdrag=999"]) == 0
    assert "note: surfdrag: semi-implicit-euler blows up" in capsys.readouterr().err


def test_runs_in_a_level(here: Path, level_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The two rooms: from the middle of the first through the adjoin to the far wall, y = 2 less the movesize."""
    (here / "run.txt").write_text("0 run forward\n3 end\n")
    assert main(["trace", "run", "run.txt", "--level", level_file.name, "--at", ".5,.5,.1,0"]) == 0
    out = capsys.readouterr()
    header, *_, last = (line.split(",") for line in out.out.splitlines())
    row = dict(zip(header, last, strict=True))
    place = [float(row[f"position_{axis}"]) for axis in "xyz"]
    assert place == pytest.approx([0.5, 1.935, 0.120114], abs=1e-9) and out.err == ""


def test_runs_with_the_body_of_a_template(here: Path, level_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A wider body stops earlier, and hovers at its own height."""
    text = level_file.read_text("latin-1")
    line = "walkplayer none type=player"
    assert line in text
    wide = "wide none type=actor move=physics size=.25 height=.5 maxthrust=2 surfdrag=3 physflags=0x42"
    level_file.write_text(
        text.replace("World templates 3", "World templates 4").replace(line, f"{wide}\n{line}"), "latin-1"
    )
    (here / "run.txt").write_text("0 run forward\n4 end\n")
    assert main(["trace", "run", "run.txt", "--level", level_file.name, "--at", ".5,.5,.5,0", "--body", "Wide"]) == 0
    header, *_, last = (line.split(",") for line in capsys.readouterr().out.splitlines())
    row = dict(zip(header, last, strict=True))
    assert [float(row[f"position_{axis}"]) for axis in "xyz"] == pytest.approx([0.5, 1.75, 0.5], abs=1e-9)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("run walk.txt --body walkplayer", "--body names a template of --level"),
        ("run walk.txt --level rooms.jkl --at 0 --body nobody", "rooms.jkl: the level has no template nobody"),
        ("run walk.txt --level rooms.jkl --at 0 --body ghost", "template ghost does not move by physics"),
        ("run walk.txt --level rooms.jkl", "--level and --at go together"),
        ("run walk.txt --at 0", "--level and --at go together"),
        ("run walk.txt --level none.jkl --at 0", "cannot read none.jkl"),
        ("run walk.txt --level rooms.jkl --at 7", "rooms.jkl: the level has no thing 7"),
        ("run walk.txt --level rooms.jkl --at 0,0,0,2", "rooms.jkl: sector 2 is none of the level's 2"),
        ("run icy.txt --level rooms.jkl --at .5,.5,.1,0", "icy.txt: a script for a level has no floor"),
        ("run walk.txt -o a.gif", "a.gif names no format"),
        ("run none.txt", "cannot read none.txt: no such file or directory"),
        ("run walk.txt -o no/such/a.csv", "there is no folder no/such to write a.csv into"),
        ("run walk.txt --set speed=1", "speed is none of airdrag"),
        ("run walk.txt --set mass=heavy", "'heavy' is no value for mass"),
        ("run walk.txt --set mass=nan", "'nan' is no value for mass"),
        ("run walk.txt --fps nan", "nan is not finite"),
        ("run walk.txt --fps 0", "0.0 is not in the range"),
        ("run bad.txt", "bad.txt: line 1: hop is no action"),
        ("run deep.txt", "deep.txt: the research document's factors for deep water are illegible"),
        ("run long.txt", "long.txt: 1e+30 s at 0.02 s a tick are more than 10000000 ticks"),
        ("run raw.bin", "cannot read raw.bin: it is no text in UTF-8, its byte 0 is 0xff"),
        ("fit raw.bin", "raw.bin: 3 bytes are no whole number of records"),
        ("fit walk.txt", "walk.txt: the header has no time"),
    ],
)
def test_mistakes_are_told(here: Path, words: str, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "icy.txt").write_text("0 surface icy\n1 end")
    (here / "rooms.jkl").write_text(TWO_ROOMS, "ascii")
    (here / "bad.txt").write_text("0 hop\n1 end")
    (here / "deep.txt").write_text("0 surface deep-water\n0 walk forward\n1 end")
    (here / "long.txt").write_text("1e30 end")
    (here / "raw.bin").write_bytes(b"\xff\xfe\x00")
    assert main(["trace", *words.split()]) == 2
    assert said in " ".join(capsys.readouterr().err.replace("│", "").split())
