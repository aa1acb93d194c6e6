"""Visibility never denies what a segment sees, wherever a level lies and whatever its shape."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.visibility_missed import missed_through_edges, sample
from jktools.facts import LevelFacts
from jktools.geometry import BLOCKS, SectorMesh, compressed, expanded
from tests.geometry.portal_levels import Level, Queries, level_of, queries_of
from tests.geometry.test_sight_extremes import MOVES, SHAKES, cut_cells
from tests.support.levels import corpus_files
from tests.support.levels import level_of as read_level

Bool = npt.NDArray[np.bool_]
REAL = {name.partition("!")[2]: data for name, data in corpus_files() if name.startswith("masspack")}
needs_corpus = pytest.mark.skipif(not REAL, reason="the corpus of real mods is not at hand")
TIERS = ("fast", "balanced", "exact")

CORNERS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
"""The faces of a box, counter-clockwise seen from inside; corner i has bits x, y, z."""


def boxes(*sizes: tuple[tuple[float, float, float], tuple[float, float, float]]) -> Level:
    """Boxes given by their least and greatest corners; equal faces of two boxes are adjoined."""
    positions: list[tuple[float, ...]] = []
    faces: list[tuple[int, ...]] = []
    for low, high in sizes:
        base = len(positions)
        positions += [tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
        faces += [tuple(base + i for i in face) for face in CORNERS]
    outlines = [frozenset(positions[i] for i in face) for face in faces]
    leads = [
        next((j // 6 for j, other in enumerate(outlines) if j // 6 != i // 6 and other == outline), BLOCKS)
        for i, outline in enumerate(outlines)
    ]
    count = len(sizes)
    start = list(range(0, 24 * count + 1, 4))
    corners = [i for face in faces for i in face]
    return Level(np.array(positions, float), start, corners, leads, list(range(0, 6 * count, 6)), [6] * count)


def walked(mesh: SectorMesh, queries: Queries) -> Bool:
    """Which sectors the segments enter, by the row of the sector that they start in."""
    count = len(mesh.visibility("fast"))
    entered = np.zeros((count, count), np.bool_)
    for origin, sector, target in zip(*queries, strict=True):
        for step in mesh.explain(int(sector), origin, target).steps:
            entered[sector, step.sector] = True
    return entered


def check(level: Level, queries: Queries) -> None:
    mesh = level.mesh()
    fast, balanced, exact = (mesh.visibility(tier) for tier in TIERS)
    assert not (balanced & ~fast).any()
    assert not (exact & ~balanced).any()
    assert not (walked(mesh, queries) & ~exact).any()


def winding_corridor() -> Level:
    """Five boxes, each 1 x 1 x 1: three in a row along x, then two along y."""
    cells = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2)]
    return boxes(*(((x, y, 0.0), (x + 1.0, y + 1.0, 1.0)) for x, y in cells))


@pytest.mark.parametrize("tier", TIERS)
def test_a_corridor_round_a_corner(tier: str) -> None:
    """From box 0 the far wall of box 2 is seen, and of box 3 the part by the corner; box 4 only past box 2's end."""
    level = winding_corridor()
    visible = level.mesh().visibility(tier)
    assert visible.diagonal().all()
    assert visible[0, [1, 2, 3]].all()
    assert visible[1, 3] and visible[3, 1]


@pytest.mark.parametrize("tier", ["balanced", "exact"])
def test_two_corners_hide_what_a_flood_reaches(tier: str) -> None:
    """A line that enters the fifth box through its near side must have a slope that the first box's door forbids.

    Boxes 0 to 4 lie along x, then y, then x again: the ends see each other by a flood, but no line turns twice.
    """
    cells = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (2, 3), (3, 3), (4, 3)]
    mesh = boxes(*(((x, y, 0.0), (x + 1.0, y + 1.0, 1.0)) for x, y in cells)).mesh()
    visible = mesh.visibility(tier)
    assert not visible[0, 5] and not visible[0, 7] and not visible[7, 0]
    assert mesh.visibility("fast")[0, 5]


def test_what_does_not_see_through_hides_and_what_may_open_shows() -> None:
    level = winding_corridor()
    door = level.leads_to.index(1)  # of box 0
    shut = level._replace(leads_to=[BLOCKS if i == door else lead for i, lead in enumerate(level.leads_to)])
    assert shut.mesh().visibility()[0].tolist() == [True, False, False, False, False]
    assert shut.mesh().visibility()[1, 0], "one way only"
    with pytest.raises(ValueError, match="surface 30 is out of bounds"):
        shut.mesh().visibility(open_surfaces=[30])


@pytest.mark.parametrize("shake", SHAKES)
@pytest.mark.parametrize("move", MOVES)
def test_each_tier_holds_the_next_and_all_hold_what_is_seen(move: str, shake: str) -> None:
    rng = np.random.default_rng(sum(map(ord, move + shake)))
    for strays in (0.0, 0.2):
        level = level_of(cut_cells(rng, cuts=4, finest=4), rng, walls=0.3, strays=strays)
        queries = queries_of(level, rng, 60)
        shaken = level.moved(SHAKES[shake](MOVES[move](level.positions), rng))
        moved = queries._replace(origins=MOVES[move](queries.origins), targets=MOVES[move](queries.targets))
        check(shaken, moved)


@pytest.mark.parametrize("seed", range(6))
def test_one_way_portals_between(seed: int) -> None:
    """A chain through a surface that nothing leads back through cannot be gone backwards: nothing follows from that."""
    rng = np.random.default_rng(seed)
    level = level_of(cut_cells(rng, cuts=9, finest=4), rng, walls=0.3, strays=0.1)
    mesh = level.mesh()
    assert not (walked(mesh, queries_of(level, rng, 400)) & ~mesh.visibility()).any()


def test_overlapping_copies_of_a_level() -> None:
    rng = np.random.default_rng(7)
    one = level_of(cut_cells(rng, 5, 2), rng, 0.1)
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
        mesh = level.mesh()
        assert not (walked(mesh, queries_of(level, rng, 250)) & ~mesh.visibility()).any()


@needs_corpus
def test_the_answer_does_not_depend_on_the_threads() -> None:
    level = read_level(REAL["jkl/lagoon.jkl"])
    mesh = SectorMesh.from_level(level)
    one, four = (mesh.visible_sectors(threads=threads) for threads in (1, 4))
    assert np.array_equal(one.rows, four.rows) and one[1:] == four[1:]


@needs_corpus
def test_progress_is_told_and_may_stop_the_work() -> None:
    level = read_level(REAL["jkl/lop_sabers.jkl"])
    mesh = SectorMesh.from_level(level)
    heard = []

    def listen(done: int, of: int) -> None:
        heard.append((done, of))
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        mesh.visible_sectors(threads=2, progress=listen)
    assert all(0 <= done <= of for done, of in heard)


@needs_corpus
@pytest.mark.parametrize("name", ["azulcity", "lagoon", "wayrest"])
def test_no_sampled_segment_of_a_real_level_is_missed(name: str) -> None:
    """`make fuzz` asks 2,000 a pair; surfaces that COGs may open only add to what is visible."""
    level = read_level(REAL[f"jkl/{name}.jkl"])
    facts = LevelFacts(level)
    visible = facts.mesh.visibility()
    assert not (visible & ~facts.visibility.matrix).any()
    found = sample(level, visible, 4, np.random.default_rng(3))
    assert found.missed == 0
    assert missed_through_edges(level, visible, 3000, np.random.default_rng(4)) == 0
    assert found.seen.sum() > 0.3 * visible.sum(), "the sample sees too little to prove anything"


@given(st.binary(max_size=700) | st.lists(st.sampled_from([0, 0, 0, 0, 7]), max_size=900).map(bytes))
def test_a_compressed_row_expands_to_itself(row: bytes) -> None:
    assert expanded(compressed(row), len(row)) == row


def test_zero_bytes_are_counted() -> None:
    assert compressed(b"\5" + bytes(300) + b"\6") == b"\5\0\xff\0\x2d\6"


@pytest.mark.parametrize("data", [b"", b"\0", b"\0\0", b"\0\4", b"\1\2\3\4", b"\0\1\0\2"])
def test_what_is_no_row_of_three_bytes_is_refused(data: bytes) -> None:
    with pytest.raises(ValueError, match="expand"):
        expanded(data, 3)
