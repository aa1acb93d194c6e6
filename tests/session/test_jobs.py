"""Levels compiled in several processes: the same files and the same messages in the same order."""

from __future__ import annotations

from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

import pytest

import jktools.session.jobs
from jktools.compiler import CompileSettings
from jktools.session import Settings, build_all
from jktools.source import InputError
from tests.support.levels import TWO_ROOMS, gob_of, two_rooms
from tests.support.packs import write


def test_any_number_of_jobs_gives_the_same(tmp_path: Path) -> None:
    deep = two_rooms(
        "World templates 3", "walkplayer none type=player move=physics size=.065 height=.12 physflags=0x40"
    )
    static = b"Section: MODELS\nWorld models 0\nend\n"
    files = [
        ("jkl\\a.jkl", TWO_ROOMS.encode()), ("jkl\\b.jkl", b"no level"), ("jkl\\c.jkl", deep.encode()),
        ("jkl\\static.jkl", static), ("jkl\\d.jkl", TWO_ROOMS.replace("World adjoins 2", "World adjoins 1").encode()),
    ]  # fmt: skip
    write(tmp_path / "mod.gob", gob_of(files))
    runs = []
    for jobs in (1, 2, 3):
        out = tmp_path / "out"
        told: list[str] = []
        built = build_all(
            [str(tmp_path / "mod.gob"), str(tmp_path / "none.gob")], out, Settings(),
            lambda done, total, path, told=told: told.append(f"{done}/{total} {path.partition(':')[0]}"),  # type: ignore[misc]
            CompileSettings(skip=frozenset({"cogs"})), jobs,
        )  # fmt: skip
        data = {path.name: path.read_bytes() for path in sorted(out.iterdir())}
        for path in out.iterdir():
            path.unlink()
        runs.append((built, data, list(dict.fromkeys(told))))
    assert runs[0] == runs[1] == runs[2]
    built, data, told = runs[0]
    assert sorted(data) == [Path(target).name for _, target, *_ in built.written]
    assert len(built.written) >= 2
    assert len(built.skipped) >= 1
    assert built.problems
    assert not built.bugs


def test_what_cannot_be_written_is_told_by_any_number_of_jobs(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"{name}.jkl").write_text(TWO_ROOMS)
    blocked = tmp_path / "out"
    blocked.write_text("a file")
    messages = []
    for jobs in (1, 2):
        try:
            messages.append(build_all([str(tmp_path)], blocked, jobs=jobs).problems)
        except InputError as error:
            messages.append([str(error)])
    assert messages[0] == messages[1] != []


class BreakingPool:
    """In place of a pool of processes, in this one: what is `deadly` ends it, and all that waits with it."""

    deadly = ("b",)

    def __init__(self, jobs: int, context: object, initializer: Any, arguments: tuple[Any, ...]) -> None:
        self.broken = False
        initializer(*arguments)

    def shutdown(self) -> None:
        pass

    def submit(self, work: Any, number: int, target: Path) -> Future[Any]:
        future: Future[Any] = Future()
        self.broken |= target.stem in self.deadly
        if self.broken:
            future.set_exception(BrokenProcessPool())
        else:
            future.set_result(work(number, target))
        return future


def test_a_process_that_ends_loses_no_other_level(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in "abcd":
        (tmp_path / f"{name}.jkl").write_text(TWO_ROOMS)
    monkeypatch.setattr(jktools.session.jobs, "ProcessPoolExecutor", BreakingPool)
    built = build_all([str(tmp_path)], tmp_path / "out", jobs=2)
    assert [Path(target).stem for _, target, *_ in built.written] == ["a", "c", "d"]
    (bug,) = built.bugs
    assert "b.jkl: the process that compiles it ended" in bug
