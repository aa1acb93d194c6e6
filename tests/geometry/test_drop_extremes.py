"""Drop stays exact wherever a level lies, however large it is and however its vertices are rounded."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.geometry import ABSENT, CARRIES, STOPS, Ending, SectorMesh
from jktools.model import Level as RealLevel
from jktools.source import Source
from jktools.syntax.jkl import read
from tests.geometry.portal_levels import Level, level_of, queries_of
from tests.geometry.test_sight_extremes import MOVES, SHAKES, cut_cells
from tests.support.levels import CORPUS, corpus_files


def mesh_of(level: Level, rng: np.random.Generator) -> SectorMesh:
    """The mesh, with all kinds of ground among the surfaces that lead nowhere, and some water."""
    leads = np.array(level.leads_to)
    kinds = rng.choice([CARRIES, CARRIES, STOPS, ABSENT], len(leads))
    return SectorMesh.from_arrays(
        *level, passes_to=np.where(leads < 0, kinds, leads), under_water=rng.random(len(level.sector_first)) < 0.1
    )


def check(mesh: SectorMesh, points: npt.ArrayLike, sectors: npt.ArrayLike, limits: npt.ArrayLike = np.inf) -> set[int]:
    balanced = mesh.drop(points, sectors, limits)
    exact = mesh.drop(points, sectors, limits, accuracy="exact")
    for name in balanced._fields:
        wrong = np.flatnonzero(getattr(balanced, name) != getattr(exact, name))
        assert not len(wrong), (name, wrong, np.asarray(points)[wrong[0]], np.asarray(sectors)[wrong[0]])
    return set(balanced.ending.tolist())


@pytest.mark.parametrize("shake", SHAKES)
@pytest.mark.parametrize("move", MOVES)
def test_balanced_equals_exact_at_the_extremes(move: str, shake: str) -> None:
    rng = np.random.default_rng(sum(map(ord, move + shake)))
    for strays in (0.0, 0.2):
        level = level_of(cut_cells(rng, cuts=10, finest=4), rng, walls=0.2, strays=strays)
        queries = queries_of(level, rng, 150)
        shaken = level.moved(SHAKES[shake](MOVES[move](level.positions), rng))
        points = MOVES[move](queries.origins)
        reach = float(np.ptp(shaken.positions[:, 2]))
        check(mesh_of(shaken, rng), points, queries.sectors, rng.choice([np.inf, 0.5 * reach, 0.1 * reach], 150))


@pytest.mark.parametrize("move", MOVES)
def test_points_straight_above_the_moved_vertices_and_edges(move: str) -> None:
    rng = np.random.default_rng(sum(map(ord, move)))
    level = level_of(cut_cells(rng, cuts=12, finest=2), rng, walls=0.1, strays=0.1)
    moved = level.moved(MOVES[move](level.positions))
    sectors = rng.integers(len(level.sector_first), size=300).astype(np.int32)
    surfaces = np.array(level.sector_first)[sectors] + rng.integers(np.array(level.sector_count)[sectors])
    points = moved.positions[np.array(level.surface_vertex)[np.array(level.surface_start)[surfaces]]]
    points[:, 2] += np.abs(rng.choice([0.0, 0.5, 1.0], 300) * np.ptp(moved.positions[:, 2]))
    found = check(moved.mesh(), points, sectors)
    assert Ending.FLOOR in found


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    cuts=st.integers(0, 20),
    finest=st.sampled_from([1, 2, 8, 1 << 20]),
    walls=st.sampled_from([0.0, 0.1, 0.5]),
    strays=st.sampled_from([0.0, 0.1, 0.5]),
)
def test_balanced_equals_exact_on_generated_levels(
    seed: int, cuts: int, finest: int, walls: float, strays: float
) -> None:
    rng = np.random.default_rng(seed)
    level = level_of(cut_cells(rng, cuts, finest), rng, walls, strays)
    queries = queries_of(level, rng, 80)
    check(mesh_of(level, rng), queries.origins, queries.sectors, rng.choice([np.inf, 1.0, 0.25], 80))


def test_the_generated_falls_end_in_every_way() -> None:
    rng = np.random.default_rng(11)
    level = level_of(cut_cells(rng, 12, 4), rng, walls=0.2)
    queries = queries_of(level, rng, 400)
    endings = check(mesh_of(level, rng), queries.origins, queries.sectors, rng.choice([np.inf, 0.25], 400))
    assert endings == {Ending.FLOOR, Ending.SOLID, Ending.WATER, Ending.FAR, Ending.NOTHING}


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
def test_balanced_equals_exact_on_real_levels() -> None:
    """Points of each level's vertices, lifted, and of its things; `make fuzz` asks a million."""
    rng = np.random.default_rng(12)
    for name, data in corpus_files():
        level = RealLevel(read(Source(name, data)))
        if not level.has_geometry or len(level.sectors) < 2:
            continue
        table = level.document.sectors
        entries = rng.integers(len(table.vertex), size=300)
        sectors = (np.searchsorted(table.vertex_start, entries, side="right") - 1).astype(np.int32)
        points = level.vertices[table.vertex[entries]].astype(np.float64)
        centers = table.center[sectors].astype(np.float64)
        check(
            SectorMesh.from_level(level), points + rng.choice([0, 0, 0.5, 0.9], (300, 1)) * (centers - points), sectors
        )
