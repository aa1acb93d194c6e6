"""`lint --write-baseline` and `--baseline`: only what is new is told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from jktools.cli import main
from tests.support.levels import gob_of, two_rooms

MISMATCH = ("World adjoins 2", "1: 0x7 1 1")
OPEN_BOX = ("Sector 0", "CollideBox .1 .1 .1 .9 1.25 .9")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rooms.jkl").write_text(two_rooms(*MISMATCH))
    return tmp_path


def lint(*words: str) -> int:
    return main(["lint", *words])


def test_only_what_is_new_is_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert lint("rooms.jkl", "--write-baseline", "known.json") == 0
    shown = capsys.readouterr()
    assert (shown.out, shown.err) == ("", "jktools: note: 1 finding written to the baseline known.json\n")
    assert lint("rooms.jkl", "--baseline", "known.json") == 0
    shown = capsys.readouterr()
    assert shown.out == "no findings in 1 file\n"
    assert shown.err == "jktools: note: 1 finding in the baseline known.json left out\n"
    (here / "rooms.jkl").write_text("# moved\n" + two_rooms(*MISMATCH, *OPEN_BOX))
    assert lint("rooms.jkl", "--baseline", "known.json") == 1
    out = capsys.readouterr().out
    assert "JK301" in out and "JK201" not in out


def test_a_finding_that_is_there_once_more_is_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two adjoins read alike; the baseline holds one of them."""
    lint("rooms.jkl", "--write-baseline", "known.json", "--select", "JK201")
    baseline = json.loads((here / "known.json").read_text())
    assert [entry["times"] for entry in baseline["findings"]] == [1]
    (here / "rooms.jkl").write_text(two_rooms("World adjoins 2", "0: 0x7 0 1\n1: 0x7 1 1"))
    capsys.readouterr()
    assert lint("rooms.jkl", "--baseline", "known.json", "--select", "JK201") == 1


def test_what_is_gone_is_said(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lint("rooms.jkl", "--write-baseline", "known.json")
    (here / "rooms.jkl").write_text(two_rooms())
    capsys.readouterr()
    assert lint("rooms.jkl", "--baseline", "known.json") == 0
    assert "1 finding in the baseline known.json no longer there" in capsys.readouterr().err
    lint("rooms.jkl", "--baseline", "known.json", "--select", "JK3")
    assert "no longer there" not in capsys.readouterr().err  # the rule did not run
    (here / "other.jkl").write_text(two_rooms())
    lint("other.jkl", "--baseline", "known.json")
    assert "no longer there" not in capsys.readouterr().err  # the file was not read


def test_paths_hold_from_another_folder(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (here / "mod.gob").write_bytes(gob_of([("jkl/rooms.jkl", two_rooms(*MISMATCH).encode("latin-1"))]))
    (here / "ci").mkdir()
    lint("rooms.jkl", "mod.gob", "--write-baseline", "ci/known.json")
    assert lint("rooms.jkl", "mod.gob") == 1
    assert lint("./rooms.jkl", str(here / "mod.gob"), "--baseline", "ci/known.json") == 0
    monkeypatch.chdir(here / "ci")
    assert lint("..", "--baseline", "known.json") == 0


def test_a_configuration_names_one(here: Path) -> None:
    lint("rooms.jkl", "--write-baseline", "known.json")
    (here / "jktools.toml").write_text('[lint]\nbaseline = "known.json"\n')
    assert lint("rooms.jkl") == 0
    assert lint("rooms.jkl", "--config", "none") == 1


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "cannot read the baseline known.json: no such file or directory; --write-baseline makes one"),
        (b"", "cannot read the baseline known.json: "),
        (b"[]", "cannot read the baseline known.json: "),
        (b'{"version": 2, "findings": []}', "cannot read the baseline known.json: Invalid enum value 2"),
        (b'{"version": 1, "findings": [{}]}', "cannot read the baseline known.json: Object missing required"),
        (b"\xff\xfe", "cannot read the baseline known.json: "),
    ],
)
def test_one_that_cannot_be_read(
    content: bytes | None, said: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if content is not None:
        (here / "known.json").write_bytes(content)
    assert lint("rooms.jkl", "--baseline", "known.json") == 2
    assert said in capsys.readouterr().err


def test_a_bug_is_never_known(here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("boom")

    monkeypatch.setattr("jktools.session.checking.read_level", fail)
    assert lint("rooms.jkl", "--write-baseline", "known.json") == 3
    assert json.loads((here / "known.json").read_text())["findings"] == []
    assert lint("rooms.jkl", "--baseline", "known.json") == 3


def test_writing_and_reading_at_once_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert lint("rooms.jkl", "--baseline", "a", "--write-baseline", "b") == 2
    assert "leave --baseline out" in capsys.readouterr().err
