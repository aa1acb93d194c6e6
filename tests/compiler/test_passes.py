"""Which passes run, what an absent section says, and what becomes of a pass that fails."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from jktools.cli import main
from jktools.compiler import CompiledLevel, CompileSettings, PassError, compilation, compile_level, passes
from jktools.compiler.passes import PASSES, Pass, at
from jktools.compiler.sections import Columns, NotNeeded, Strings
from jktools.facts import LevelFacts
from tests.support.levels import TWO_ROOMS, level_of


def compiled(**settings: object) -> CompiledLevel:
    return CompiledLevel(compile_level(level_of(TWO_ROOMS), CompileSettings(**settings)))  # type: ignore[arg-type]


def test_every_pass_comes_after_those_that_it_needs() -> None:
    names = list(PASSES)
    for name, each in PASSES.items():
        assert [n for n in each.needs if names.index(n) >= names.index(name)] == []


def test_a_pass_left_out_takes_along_those_that_need_it(monkeypatch: pytest.MonkeyPatch) -> None:
    needing = Pass("cogs", PASSES["cogs"].compute, ("things",))
    monkeypatch.setattr(passes, "PASSES", {**PASSES, "cogs": needing})
    level = compiled(skip=frozenset({"things"}))
    assert (level.things, level.cogs) == (None, None)
    assert level.passes["things"] == {"ran": False, "failed": False, "note": "left out by --skip"}
    assert level.passes["cogs"]["note"] == "needs things, which is absent: left out by --skip"
    assert level.passes["templates"]["ran"]


@pytest.mark.parametrize("name", ["geometry", "thing"])
def test_only_what_is_optional_can_be_chosen(name: str) -> None:
    with pytest.raises(ValueError, match=rf"'{name}' is no pass that can be chosen: those are templates, things"):
        compiled(skip=frozenset({name}))


def test_only_brings_what_it_needs() -> None:
    level = compiled(only=frozenset({"things"}))
    assert [name for name, each in level.passes.items() if each["ran"]] == ["resources", "geometry", "things", "files"]
    assert level.passes["cogs"]["note"] == "left out by --only"


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    def compute(facts: LevelFacts, _: Strings, __: CompileSettings) -> Columns | NotNeeded:
        for sector in range(len(facts.level.sectors)):
            with at("sector", sector):
                if sector == 1:
                    raise ZeroDivisionError("nothing to divide by")
        return NotNeeded("never")

    monkeypatch.setattr(passes, "PASSES", {**PASSES, "templates": Pass("templates", compute)})
    yield


SENTENCE = "the pass templates failed on test.jkl at sector 1: ZeroDivisionError: nothing to divide by"


@pytest.mark.usefixtures("broken")
def test_a_pass_that_fails_names_itself_the_level_and_the_object() -> None:
    with pytest.raises(PassError) as raised:
        compile_level(level_of(TWO_ROOMS))
    assert str(raised.value) == SENTENCE


@pytest.mark.usefixtures("broken")
def test_the_rest_compiles_when_kept_going() -> None:
    done = compilation(level_of(TWO_ROOMS), CompileSettings(keep_going=True))
    assert done.failures == (SENTENCE,)
    level = CompiledLevel(done.data)
    assert (level.templates, level.passes["templates"]["note"]) == (None, SENTENCE)
    assert level.cogs is not None


@pytest.mark.usefixtures("broken")
def test_a_failed_pass_is_a_bug_on_the_command_line(
    level_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "out.jklb"
    words = ["build", str(level_file), "-o", str(target)]
    assert main(words) == 3
    told = capsys.readouterr().err
    assert "at sector 1" in told and "--keep-going" in told
    assert not target.exists()
    assert main([*words, "--keep-going"]) == 3
    assert target.exists()


def test_an_unknown_pass_is_bad_usage(level_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", str(level_file), "-o", str(tmp_path / "x.jklb"), "--only", "geometri"]) == 2
    assert "geometri" in capsys.readouterr().err
