"""A target seen in its own sector, with and without the potentially visible sectors asked first."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.geometry import SectorMesh
from tests.geometry.portal_levels import Level, Queries, level_of, queries_of
from tests.geometry.test_sight_extremes import MOVES, cut_cells

Bool = npt.NDArray[np.bool_]
Int32 = npt.NDArray[np.int32]


def walked(mesh: SectorMesh, queries: Queries, aims: Int32) -> Bool:
    """The answer by the complete search of each query, sector by sector."""
    found = np.zeros(len(aims), np.bool_)
    for row, (origin, sector, target) in enumerate(zip(*queries, strict=True)):
        way = mesh.explain(int(sector), origin, target)
        found[row] = way.visible and any(step.sector == aims[row] for step in way.steps)
    return found


def check(level: Level, rng: np.random.Generator, count: int) -> Bool:
    mesh, queries = level.mesh(), queries_of(level, rng, count)
    aims = mesh.locate(queries[2])
    strays = rng.random(len(aims)) < 0.2
    aims[strays] = rng.integers(-1, len(level.sector_first), int(strays.sum()))
    expected = walked(mesh, queries, aims)
    for visible in (None, *(mesh.visible_sectors(tier) for tier in ("fast", "balanced"))):
        assert np.array_equal(mesh.sees(*queries, aims, visible), expected)
    assert not (expected & ~mesh.sight(*queries).visible).any()
    return expected


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.2]))
def test_what_is_asked_first_changes_no_answer(seed: int, strays: float) -> None:
    rng = np.random.default_rng(seed)
    check(level_of(cut_cells(rng, cuts=10, finest=4), rng, walls=0.2, strays=strays), rng, 60)


@pytest.mark.parametrize("move", MOVES)
def test_at_the_extremes(move: str) -> None:
    rng = np.random.default_rng(sum(map(ord, move)))
    level = level_of(cut_cells(rng, cuts=10, finest=4), rng, walls=0.2, strays=0.1)
    check(level.moved(MOVES[move](level.positions)), rng, 60)


def test_a_target_in_another_sector_than_its_own_is_not_seen_there() -> None:
    rng = np.random.default_rng(5)
    level = level_of(cut_cells(rng, cuts=6, finest=4), rng, walls=0.0, strays=0.0)
    mesh, queries = level.mesh(), queries_of(level, rng, 100)
    aims = mesh.locate(queries[2])
    assert mesh.sees(*queries, aims).any()
    assert not mesh.sees(*queries, np.full(len(aims), -1, np.int32)).any()


def test_wrong_arguments_are_named() -> None:
    rng = np.random.default_rng(5)
    level = level_of(cut_cells(rng, cuts=2, finest=4), rng, walls=0.0, strays=0.0)
    mesh, queries = level.mesh(), queries_of(level, rng, 3)
    count = len(level.sector_first)
    with pytest.raises(ValueError, match=rf"sector of target 1 .*{count}"):
        mesh.sees(*queries, np.array([0, count, 0]))
    with pytest.raises(ValueError, match=r"target_sectors must have shape"):
        mesh.sees(*queries, np.array([0]))
    visible = mesh.visible_sectors()
    with pytest.raises(ValueError, match="not those of this mesh"):
        mesh.sees(*queries, np.zeros(3), visible._replace(rows=visible.rows[:-1]))
