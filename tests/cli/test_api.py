from __future__ import annotations

from pathlib import Path

import pytest

import jktools
from tests.support.levels import TWO_ROOMS, gob_of


def test_the_calls_of_the_readme(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("p.gob").write_bytes(gob_of([("jkl\\rooms.jkl", TWO_ROOMS.encode())]))
    level = jktools.load("p.gob!JKL/Rooms.JKL")
    assert isinstance(level, jktools.Level)
    assert jktools.lint(level) == []
    batch = jktools.check(["p.gob"])
    assert (list(batch), batch.files, batch.problems) == ([], 1, [])
    data = jktools.build(level)
    assert data[4:8] == b"JKLB"
    assert jktools.CompiledLevel(jktools.build(level, accuracy="exact")).settings["accuracy"] == "exact"
    assert jktools.CompiledLevel(jktools.build(level, accuracy="fast")).settings["accuracy"] == "fast"
    with pytest.raises(ValueError, match="accuracy is 'best', but can be fast, balanced, exact"):
        jktools.build(level, accuracy="best")  # type: ignore[arg-type]
    mesh = jktools.mesh(level)
    assert mesh.locate([[0.5, 0.5, 0.5], [0.5, 1.5, 0.5], [9, 9, 9]]).tolist() == [0, 1, -1]


def test_load_names_what_it_needs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("p.gob").write_bytes(gob_of([(f"jkl\\{n}.jkl", TWO_ROOMS.encode()) for n in "ab"]))
    Path("empty.jkl").write_bytes(b"")
    with pytest.raises(jktools.InputError, match=r"p.gob holds 2 levels: name one of p.gob!jkl/a.jkl"):
        jktools.load("p.gob")
    with pytest.raises(jktools.InputError, match="no SECTION: lines, so it is no level"):
        jktools.load("empty.jkl")


def test_a_goo_is_read_as_mysteries_of_the_sith(tmp_path: Path) -> None:
    for name, game in (("p.goo", "mots"), ("p.gob", "jk")):
        (tmp_path / name).write_bytes(gob_of([("jkl\\rooms.jkl", TWO_ROOMS.encode())]))
        assert jktools.load(str(tmp_path / name)).game == game
    assert jktools.load(str(tmp_path / "p.goo"), game="jk").game == "jk"


def test_unknown_names_are_refused() -> None:
    with pytest.raises(AttributeError):
        _ = jktools.nothing  # type: ignore[attr-defined]
    assert "lint" in dir(jktools)
