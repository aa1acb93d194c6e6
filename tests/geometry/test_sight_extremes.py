"""Sight stays exact wherever a level lies, however large it is and however its vertices are rounded."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.portal_levels import Cells, Float64, Level, Queries, level_of, queries_of


def check(level: Level, queries: Queries) -> None:
    mesh = level.mesh()
    balanced, exact = mesh.sight(*queries), mesh.sight(*queries, accuracy="exact")
    for name in balanced._fields:
        wrong = np.flatnonzero(getattr(balanced, name) != getattr(exact, name))
        assert not len(wrong), (name, [column[wrong[0]] for column in queries], wrong)


def cut_cells(rng: np.random.Generator, cuts: int, finest: int) -> Cells:
    cells = Cells()
    for _ in range(cuts):
        normal = (0, 0, 0)
        while normal == (0, 0, 0):
            normal = tuple(int(n) for n in rng.integers(-2, 3, 3))
        cell = int(rng.integers(len(cells.cells)))
        inside = np.mean([v for face in cells.cells[cell] for v in face.polygon], axis=0)
        offset = float(np.round(np.dot(normal, inside) * finest) / finest)
        cells.cut(cell, normal, offset)
    return cells


def rotation(*angles: float) -> Float64:
    turn = np.eye(3)
    for axis, angle in enumerate(angles):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        step = np.eye(3)
        step[[i, j], [i, j]] = np.cos(angle)
        step[i, j], step[j, i] = -np.sin(angle), np.sin(angle)
        turn = step @ turn
    return turn


def jitter_ulp(points: Float64, rng: np.random.Generator) -> Float64:
    return np.nextafter(points, points + rng.integers(-1, 2, points.shape))


def jitter(points: Float64, rng: np.random.Generator) -> Float64:
    return points + rng.normal(0, 1e-4, points.shape)


MOVES: dict[str, Callable[[Float64], Float64]] = {
    "as it is": lambda p: p,
    "float32": lambda p: p.astype(np.float32).astype(float),
    **{f"translated {d:g}": (lambda p, d=d: p + np.array([d, -d / 3, d / 7])) for d in (1e3, 1e5, 1e7)},
    **{f"scaled {s:g}": (lambda p, s=s: p * s) for s in (1e-40, 1e-6, 1e-3, 1e3, 1e6, 1e40)},
    "rotated": lambda p: p @ rotation(0.1, 0.7, 2.3).T,
    "rotated by little": lambda p: p @ rotation(1e-8, -1e-9, 1e-7).T,
    "rotated far off": lambda p: (p + 1e4) @ rotation(1.1, 0.2, 0.9).T,
    "TDiR": lambda p: (p * 400 + [2000, -1900, 37]).astype(np.float32).astype(float),
    "needles": lambda p: p * [1, 1e-7, 1e4],
    "slivers": lambda p: p * [1e-9, 1, 1],
}
SHAKES: dict[str, Callable[[Float64, np.random.Generator], Float64]] = {
    "firm": lambda p, rng: p,
    "by an ulp": jitter_ulp,
    "by 1e-4": jitter,
}


@pytest.mark.parametrize("shake", SHAKES)
@pytest.mark.parametrize("move", MOVES)
def test_balanced_equals_exact_at_the_extremes(move: str, shake: str) -> None:
    rng = np.random.default_rng(sum(map(ord, move + shake)))
    for strays in (0.0, 0.2):
        level = level_of(cut_cells(rng, cuts=10, finest=4), rng, walls=0.2, strays=strays)
        queries = queries_of(level, rng, 120)
        shaken = level.moved(SHAKES[shake](MOVES[move](level.positions), rng))
        check(
            shaken,
            queries._replace(origins=MOVES[move](queries.origins), targets=MOVES[move](queries.targets)),
        )


@pytest.mark.parametrize("move", MOVES)
def test_queries_through_the_moved_vertices_themselves(move: str) -> None:
    rng = np.random.default_rng(sum(map(ord, move)))
    level = level_of(cut_cells(rng, cuts=12, finest=2), rng, walls=0.1)
    moved = level.moved(MOVES[move](level.positions))
    check(moved, queries_of(moved, rng, 200))


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
    check(level, queries_of(level, rng, 60))


def test_overlapping_copies_of_a_level() -> None:
    """Two levels in the same place, one shifted by less than a cell, with adjoins from one into the other."""
    rng = np.random.default_rng(7)
    one = level_of(cut_cells(rng, 8, 2), rng, 0.1)
    half = len(one.positions), one.surface_start[-1], len(one.leads_to), len(one.sector_first)
    for shift in (0.0, 1e-9, 0.3):
        level = Level(
            np.concatenate([one.positions, one.positions + shift]),
            one.surface_start + [s + half[1] for s in one.surface_start[1:]],
            one.surface_vertex + [v + half[0] for v in one.surface_vertex],
            [lead + half[3] if lead >= 0 and rng.random() < 0.4 else lead for lead in one.leads_to]
            + [lead if lead < 0 or rng.random() < 0.4 else lead + half[3] for lead in one.leads_to],
            one.sector_first + [f + half[2] for f in one.sector_first],
            one.sector_count * 2,
        )
        check(level, queries_of(level, rng, 250))


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_answers_do_not_depend_on_the_rest_of_the_batch(seed: int, count: int) -> None:
    """Segments in one sector share its planes; alone, in another order or among others they are answered alike."""
    rng = np.random.default_rng(seed)
    level = level_of(cut_cells(rng, cuts=8, finest=4), rng, walls=0.2, strays=0.1)
    mesh, queries = level.mesh(), queries_of(level, rng, count)
    together = np.array(mesh.sight(*queries))
    rows = rng.permutation(len(queries[1]))
    assert np.array_equal(np.array(mesh.sight(*(column[rows] for column in queries))), together[:, rows])
    for row in rows[:20]:
        assert np.array_equal(np.array(mesh.sight(*(column[[row]] for column in queries)))[:, 0], together[:, row])
