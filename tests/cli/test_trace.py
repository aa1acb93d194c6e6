"""`jktools trace` as a user meets it."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.cli import main

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


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("run walk.txt -o a.gif", "a.gif names no format"),
        ("run none.txt", "does not exist"),
        ("run walk.txt --set speed=1", "speed is none of airdrag"),
        ("run walk.txt --set mass=heavy", "'heavy' is no value for mass"),
        ("run walk.txt --fps 0", "0.0 is not in the range"),
        ("run bad.txt", "bad.txt: line 1: hop is no action"),
        ("run deep.txt", "deep.txt: the research document's factors for deep water are illegible"),
        ("run long.txt", "long.txt: 1e+30 s at 0.02 s a tick are more than 10000000 ticks"),
        ("run raw.bin", "raw.bin: 'utf-8' codec can't decode"),
        ("fit raw.bin", "raw.bin: 3 bytes are no whole number of records"),
        ("fit walk.txt", "walk.txt: the header has no time"),
    ],
)
def test_mistakes_are_told(here: Path, words: str, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "bad.txt").write_text("0 hop\n1 end")
    (here / "deep.txt").write_text("0 surface deep-water\n0 walk forward\n1 end")
    (here / "long.txt").write_text("1e30 end")
    (here / "raw.bin").write_bytes(b"\xff\xfe\x00")
    assert main(["trace", *words.split()]) == 2
    assert said in " ".join(capsys.readouterr().err.replace("│", "").split())
