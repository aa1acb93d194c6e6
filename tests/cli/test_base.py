"""`--base` and `base` of a configuration."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from jktools.cli import main
from jktools.session import load_config
from tests.support.levels import ROOT, TWO_ROOMS, gob_of, two_rooms
from tests.support.packs import write


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "mod.gob", gob_of([("jkl\\x.jkl", TWO_ROOMS.encode())]))
    write(tmp_path / "game/res.gob", gob_of([("mat\\a.mat", b"a")]))
    return tmp_path


@pytest.mark.parametrize(
    "words",
    [
        ["lint", "mod.gob"],
        ["build", "mod.gob", "-o", "out"],
        ["sight", "mod.gob", "0", "1"],
        ["trace", "run", "keys.txt", "--level", "mod.gob", "--at", "0"],
    ],
)
def test_a_base_that_cannot_be_opened_is_told(words: list[str], here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(here / "keys.txt", b"0 walk forward\n0.1 end\n")
    assert main([*words, "--base", "nowhere"]) == 2
    assert capsys.readouterr().err == "jktools: error: cannot read nowhere: no such file or folder\n"
    assert main([*words, "--base", "mod.gob", "--base", "game"]) in (0, 1)


def test_a_configuration_names_bases_from_its_own_folder(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    config = write(here / "site/jktools.toml", b'base = ["../game", "pack.zip!inner.gob"]\n')
    assert [Path(b).as_posix() for b in load_config(config).settings.base] == [
        (here / "site/../game").as_posix(),
        (here / "site/pack.zip!inner.gob").as_posix(),
    ]
    write(here / "jktools.toml", b'base = ["nowhere"]\n')
    assert main(["lint", "mod.gob"]) == 2
    assert "nowhere: no such file" in capsys.readouterr().err
    assert main(["lint", "mod.gob", "--base", "game"]) in (0, 1)


TABLE = """\
kind              own     base  missing   unused
material            0        1        2        0
sound               0        0        1        0
colormap            0        0        1        0
cog                 0        0        1        0
"""


def test_stats(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(here / "game/res.gob", gob_of([("mat\\floor.mat", b"a")]))
    level = two_rooms("World materials 3", "0: floor.mat 1 1", "1: WALL.mat 1 1", "2: gone.mat 1 1")
    write(here / "mod.gob", gob_of([("jkl\\x.jkl", level.encode())]))
    main(["lint", "mod.gob", "--stats", "--select", "JK201", "--base", "game"])
    assert capsys.readouterr().out == TABLE + "\nno findings in 1 file\n"
    main(["lint", "mod.gob", "--stats", "--select", "JK201", "--base", "game", "--format", "json"])
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/lint.schema.json").read_text()))
    assert report["stats"][0] == {"kind": "material", "own": 0, "base": 1, "missing": 2, "unused": 0}
    main(["lint", "mod.gob", "--format", "json"])
    assert "stats" not in json.loads(capsys.readouterr().out)
