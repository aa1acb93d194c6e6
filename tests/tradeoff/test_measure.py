"""Cells in processes of their own: what they give, and what becomes of one that is slow or breaks."""

from __future__ import annotations

import functools
import os
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from jktools.engine.profile import Engine
from jktools.model import Level
from jktools.session import load
from jktools.tradeoff import PASSES, Asked, Plan, Row, measure, memory
from tests.support.levels import CORPUS, two_rooms

ASKED = Asked(Engine.RESEARCH, 200, 7)


def plan(*passes: str, **settings: object) -> Plan:
    return Plan(ASKED, passes or tuple(PASSES), **{"repeat_seconds": 0.1, **settings})  # type: ignore[arg-type]


def reading(tmp_path: Path, *fragment: str) -> functools.partial[Level]:
    path = tmp_path / "rooms.jkl"
    path.write_text(two_rooms(*fragment), "latin-1")
    return functools.partial(load, str(path))


def told(rows: list[Row]) -> dict[tuple[str, str], object]:
    """What must be the same at every run."""
    return {(row.found.name, c.tier): (row.nothing, c.bytes, c.error) for row in rows for c in row.cells}


def test_everything_of_a_small_level(tmp_path: Path) -> None:
    load_rooms = reading(tmp_path)
    rows = measure(load_rooms, plan(repeat_seconds=0.0))
    assert [row.found.name for row in rows] == list(PASSES)
    for row in rows:
        for cell in () if row.nothing else row.cells:
            assert cell.not_measured == "", row.found.name
            assert cell.median > 0
            assert (cell.error is None) == (row.found.name == "build")
            assert cell.tier != "exact" or cell.error is None or cell.error.worst == 0
            assert (cell.bytes is None) == (row.found.name in ("location", "sight", "drop"))
    again = measure(load_rooms, plan("sight", "ledges", "basins"))
    assert told(again).items() <= told(rows).items()


def test_another_seed_asks_otherwise(tmp_path: Path) -> None:
    """A level whose edges fast gets wrong in some queries and not in others."""
    load_rooms = reading(tmp_path)
    first, second = (
        measure(load_rooms, Plan(Asked(Engine.RESEARCH, 4000, seed), ("location",), repeat_seconds=0.1))
        for seed in (1, 2)
    )
    assert told(first) != told(second)


def test_what_the_level_does_not_call_for(tmp_path: Path) -> None:
    (row,) = measure(reading(tmp_path, "World templates 3", "walkplayer none type=ghost"), plan("motion"))
    assert row.nothing == "no template that the level can reach is an actor or player"


def test_without_exact_the_error_is_not_known(tmp_path: Path) -> None:
    (row,) = measure(reading(tmp_path), plan("sight", tiers=("fast", "balanced")))
    assert [(cell.tier, cell.error, cell.no_error) for cell in row.cells] == [
        ("fast", None, "exact was not asked for"), ("balanced", None, "exact was not asked for"),
    ]  # fmt: skip


def slow_at_exact(path: str) -> Level:
    """Sleep in the process of each tier, the longer the later it was started."""
    time.sleep(60)
    return load(path)


def ends(path: str) -> Level:
    os._exit(3)


def raises(path: str) -> Level:
    raise ValueError("no such thing")


def test_a_cell_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    began = time.monotonic()
    (row,) = measure(
        functools.partial(slow_at_exact, reading(tmp_path).args[0]), plan("sight", tiers=("balanced",), time_limit=0.5)
    )
    assert time.monotonic() - began < 30
    (cell,) = row.cells
    assert (cell.not_measured, cell.seconds, cell.is_bug) == ("takes longer than 0.5 s", [], False)


def test_what_needs_it_is_not_measured_either(tmp_path: Path) -> None:
    rows = measure(
        functools.partial(slow_at_exact, reading(tmp_path).args[0]),
        plan("ledges", "basins", tiers=("exact",), time_limit=0.5),
    )
    assert [row.cells[0].not_measured for row in rows] == [
        "takes longer than 0.5 s",
        "needs ledges, which is not measured",
    ]


def test_a_process_that_ends_costs_its_cell_alone(tmp_path: Path) -> None:
    path = reading(tmp_path).args[0]
    (row,) = measure(functools.partial(ends, path), plan("sight", tiers=("fast",)))
    assert row.cells[0].not_measured == "its process ended with status 3"
    (row,) = measure(functools.partial(raises, path), plan("sight", tiers=("fast",)))
    assert (row.cells[0].not_measured, row.cells[0].is_bug) == ("ValueError: no such thing", True)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells")
def test_memory_is_that_of_one_computation() -> None:
    """Filled once and let go, 64 MB count for the computation that held them and not for the next."""
    held = memory.start()
    block = np.ones(8 << 20)
    assert memory.peak() - held > 60 << 20  # type: ignore[operator]
    del block
    held = memory.start()
    assert memory.peak() - held < 8 << 20  # type: ignore[operator]


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
def test_a_real_level() -> None:
    """Balanced has no error where it is exact, and no segment sees a pair of sectors that a tier denies."""
    load_camera = functools.partial(load, str(CORPUS / "gob/canyon_camera.gob"))
    asked = Asked(Engine.RESEARCH, 2000, 1997)
    rows = measure(load_camera, Plan(asked, ("location", "sight", "drop", "visibility"), repeat_seconds=0.1))
    cells = {(row.found.name, cell.tier): cell for row in rows for cell in row.cells}
    for name in ("location", "sight", "drop"):
        found, rough = cells[name, "balanced"].error, cells[name, "fast"].error
        assert found is not None
        assert (found.measures["wrong"], found.measures["wrong_at_edges"], found.measures["unlike"]) == (0, 0, 0)
        assert rough is not None
        assert rough.measures["wrong_at_edges"] > 0
    for tier in ("fast", "balanced", "exact"):
        error = cells["visibility", tier].error
        assert error is not None
        assert (error.measures["missed"], error.measures["refuted"]) == (0, 0)
        assert error.measures["segments"] > 300
    assert cells["visibility", "fast"].error.worst > cells["visibility", "balanced"].error.worst  # type: ignore[union-attr]
