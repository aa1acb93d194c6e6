"""Ledges: pits as the research document measured them, real levels against a brute-force twin, and the extremes."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.ledge_disagreement import GAIT, compare
from benchmarks.ledge_tiers import differing
from jktools._native_geometry import Strides  # noqa: TID251 (its own test)
from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.ground import Tread
from jktools.engine.profile import Engine
from jktools.engine.simulation import Phase, Simulation, simulate
from jktools.engine.thrust import Keys
from jktools.facts import LevelFacts
from jktools.facts.bodies import Walker
from jktools.facts.ledges import Kind, Ledges
from jktools.geometry.components import components
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker, Over
from jktools.model import Level
from tests.support import terraces as support
from tests.support.levels import CORPUS, corpus_files, level_of, two_rooms
from tests.support.terraces import rounded, terraces

PLAYER = Walker(WALKPLAYER, hovers=True, gravity=4.0, names=("walkplayer",))


def walker(**parameters: float) -> Walker:
    return dataclasses.replace(PLAYER, body=dataclasses.replace(WALKPLAYER, **parameters))  # type: ignore[arg-type]


def pit(depth: float, width: float = 4.0) -> Level:
    return terraces(rounded((-4.0, 0.0), (0.0, -depth), (width, 0.0)).treads)


def across(
    level: Level, body: Walker = PLAYER, engine: Engine = Engine.RESEARCH
) -> list[tuple[int, Kind, Kind, float]]:
    """What the edges between the treads are: sector, kind, kind by the other profile, drop."""
    found = LevelFacts(level).ledges(body, engine)
    there = found.kind != Kind.WALL
    return [
        (int(level.surface_sector[found.surface[row]]), Kind(found.kind[row]), Kind(found.other[row]), round(drop, 6))
        for row, drop in zip(np.flatnonzero(there), found.drop_start[there].tolist(), strict=True)
    ]


@pytest.mark.parametrize(
    ("depth", "down", "up"),
    [
        (0.05, Kind.SEAMLESS, Kind.STEP),
        (0.07, Kind.SEAMLESS, Kind.LIP),
        (0.11, Kind.SEAMLESS, Kind.JUMP),
        (0.112, Kind.SEAMLESS, Kind.JUMP),
        (0.185, Kind.SEAMLESS, Kind.JUMP),
        (0.1852, Kind.FALL, Kind.JUMP),
        (0.2, Kind.FALL, Kind.JUMP),
        (0.3, Kind.FALL, Kind.JUMP),
        (0.4, Kind.FALL, Kind.WALL),
    ],
)
def test_pits_as_the_document_measured_them(depth: float, down: Kind, up: Kind) -> None:
    """Detachment at a depth of 0.2, none at 0.11 and 0.112, the changeover at 0.1851 to 0.1852; a jump of 0.28.

    The lips are simulated.
    """
    found = across(pit(depth))
    rim = [kind for sector, kind, _, drop in found if sector != 1 and drop > 0]
    assert rim == [down, down]
    assert [kind for sector, kind, _, _ in found if sector == 1] == ([up, up] if up is not Kind.WALL else [])


@pytest.mark.parametrize("insert", [0.01, 0.06, 0.120114, 0.2, 0.4])
@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize("beside", [-0.002, 0.002])
def test_a_pit_is_a_fall_where_the_simulated_body_lets_go(insert: float, engine: Engine, beside: float) -> None:
    body = walker(insert_offset_z=insert)
    depth = body.reattach(engine) + beside
    steps = rounded((-4.0, 0.0), (0.0, -depth))
    simulated = Simulation(body.body, steps, engine=engine, position=np.array([0.0, -0.05, body.hover(engine)]))
    simulated.rest_on_ground()
    history = simulate(simulated, [Phase(0.0, Keys(forward=0.2))], 3.0, 0.02)
    lets_go = any(incident.event is Event.DETACHES for incident in history.incidents)
    (kind,) = [kind for sector, kind, _, _ in across(terraces(steps.treads), body, engine) if sector == 0]
    assert (kind is Kind.FALL) == lets_go == (beside > 0)


def test_the_profiles_differ_between_their_limits() -> None:
    """Insert offset 0.06: the changeover was read as 0.13 to 0.135; each profile has one end of it."""
    found = across(pit(0.1325), walker(insert_offset_z=0.06))
    assert [(k, other) for sector, k, other, _ in found if sector != 1] == [(Kind.FALL, Kind.SEAMLESS)] * 2


@pytest.mark.parametrize(("width", "other"), [(0.1, Kind.SEAMLESS), (0.2, Kind.FALL)])
def test_a_gap_under_two_radii_goes_unnoticed_by_the_decompiled_engine(width: float, other: Kind) -> None:
    found = [row for row in across(pit(1.0, width)) if row[0] != 1]
    assert [(kind, by_other) for _, kind, by_other, _ in found] == [(Kind.FALL, other)] * 2


SLOPE = (
    "World vertices 14", "12: 0 1 0", "13: 1 1 -.4", "8: 1 2 -.4", "9: 0 2 0", "World surfaces 13",
    "6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1", "12: 0 0x4 0x4 4 3 1 -1 0 3 3,0 2,1 13,2 1 1 1",
    "11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1", "Normals", "12: 0 1 0", "Sector 1", "Surfaces 6 7",
)  # fmt: skip


def ledges_of_first_floor(level: Level) -> Ledges:
    return LevelFacts(level).ledges(PLAYER)


def test_a_sloping_drop_is_cut_where_it_passes_a_limit() -> None:
    """Along the edge y = 1 of room 0, from x = 1 to 0, the floor beyond rises from -0.4 to 0."""
    found = ledges_of_first_floor(level_of(two_rooms(*SLOPE)))
    rows = np.flatnonzero((found.surface == 0) & (found.corner == 2))
    assert [Kind(k) for k in found.kind[rows]] == [Kind.FALL, Kind.SEAMLESS]
    assert found.end[rows[0]] == pytest.approx(1 - 0.185114 / 0.4, abs=1e-6)
    assert found.drop_start[rows].tolist() == pytest.approx([0.4, 0.185114], abs=1e-7)
    assert found.drop_end[rows[-1]] == pytest.approx(0, abs=1e-7)
    assert found.end[rows[:-1]].tolist() == found.start[rows[1:]].tolist()


def test_water_below_and_floor_under_water() -> None:
    found = ledges_of_first_floor(level_of(two_rooms("Sector 1", "Flags 0x2")))
    kinds = {(int(s), int(c)): Kind(k) for s, c, k in zip(found.surface, found.corner, found.kind, strict=True)}
    assert kinds[0, 2] is Kind.WATER
    assert kinds[6, 1] is Kind.WALL


def test_an_opening_above_a_wall_is_a_jump_and_a_high_one_a_wall() -> None:
    """Two terraces with a parapet between them: a room as thin as the wall, its floor on top."""
    for height, kind in ((0.25, Kind.JUMP), (0.5, Kind.WALL)):
        found = across(terraces(rounded((-4.0, 0.0), (0.0, height), (0.05, 0.0)).treads))
        assert [k for sector, k, _, _ in found if sector == 0] == ([kind] if kind is Kind.JUMP else [])


def test_fast_covers_each_edge_and_ends_within_its_step() -> None:
    level = level_of(two_rooms(*SLOPE))
    fast = LevelFacts(level).ledges(PLAYER, accuracy="fast")
    rows = np.flatnonzero((fast.surface == 0) & (fast.corner == 2))
    assert (fast.start[rows[0]], fast.end[rows[-1]]) == (0, 1)
    assert fast.end[rows[0]] == pytest.approx(1 - 0.185114 / 0.4, abs=1 / 8)


@pytest.mark.parametrize("shift", [0.0, 1024.0, -65536.0])
def test_far_from_the_origin_the_verdict_is_the_same(shift: float) -> None:
    """Powers of two keep the float32 numbers of this level exact."""
    treads = rounded((-4.0, 0.0), (0.0, -0.25), (4.0, 0.0)).treads
    moved = tuple(Tread(t.start + shift, t.height + shift / 8, t.surface) for t in treads)
    kinds = [(sector, kind) for sector, kind, _, _ in across(_lifted(moved, shift / 8))]
    assert kinds == [(0, Kind.FALL), (1, Kind.JUMP), (1, Kind.JUMP), (2, Kind.FALL)]


def _lifted(treads: tuple[Tread, ...], by: float) -> Level:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(support, "TOP", support.TOP + by)
        return terraces(treads)


def test_edges_are_asked_about_by_floor_and_corner() -> None:
    edges = EdgeWalker(level_of(two_rooms()))
    assert edges.surface.tolist() == [0] * 4 + [6] * 4
    assert edges.corner.tolist() == [0, 1, 2, 3] * 2
    assert edges.ends([2])[0].tolist() == [[1, 1, 0]]


def test_a_row_that_is_no_floor_is_refused() -> None:
    edges = EdgeWalker(level_of(two_rooms()))
    for surface, corner, message in ((1, 0, "surface of edge 0 is no floor"), (0, 4, "corner of edge 0 is out")):
        with pytest.raises(ValueError, match=message):
            row = [np.array([each], np.int32) for each in (surface, -1, corner)]
            edges._native.ledges(*row, np.zeros(0, np.uint8), 0.1, 0.06, 0.06, 2, 0.0, 0, 1)


def corpus_levels() -> Iterator[tuple[str, Level]]:
    for name, data in corpus_files():
        level = level_of(data, name)
        if level.has_geometry and len(level.sectors) > 1:
            yield name, level


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus is not at hand")
def test_the_corpus_agrees_with_the_brute_force_twin() -> None:
    asked = 0
    for name, level in corpus_levels():
        edges = EdgeWalker(level)
        found = edges.beyond(GAIT)
        count, wrong = compare(level, edges, found, GAIT, 0.02, 150)
        asked += count
        assert wrong == [], name
    assert asked > 3000


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus is not at hand")
def test_intervals_of_real_levels_cover_each_edge_for_any_number_of_threads() -> None:
    for name, level in corpus_levels():
        edges = EdgeWalker(level)
        one, two = edges.beyond(GAIT, threads=1), edges.beyond(GAIT, threads=2)
        assert all(a.tobytes() == b.tobytes() for a, b in zip(one, two, strict=True)), name
        if not len(one.edge):
            continue
        first = np.append(True, one.edge[1:] != one.edge[:-1])
        assert (one.start[first] == 0).all()
        assert (one.start[~first] == one.end[np.flatnonzero(~first) - 1]).all()
        assert (one.end[np.append(first[1:], True)] == 1).all()
        assert (one.start < one.end).all()


@settings(deadline=None)
@given(st.integers(1, 8), st.data())
def test_components_are_what_reaches_each_other(count: int, data: st.DataObject) -> None:
    node = st.integers(0, count - 1)
    pairs = data.draw(st.lists(st.tuples(node, node), max_size=20))
    reach = np.eye(count, dtype=bool)
    for tail, head in pairs:
        reach[tail, head] = True
    for middle in range(count):
        reach |= reach[:, [middle]] & reach[[middle], :]
    found = components(count, [p[0] for p in pairs], [p[1] for p in pairs])
    assert found.tolist() == [int(np.flatnonzero(reach[i] & reach[:, i])[0]) for i in range(count)]


def test_a_long_chain_needs_no_recursion() -> None:
    count = 50_000
    assert components(count, np.arange(count), (np.arange(count) + 1) % count).tolist() == [0] * count


def test_a_body_without_height_or_model_is_unknown() -> None:
    level = level_of(
        two_rooms("World templates 3", "walkplayer none type=player move=physics size=.065 physflags=0x40")
    )
    assert [body.hovers for body in LevelFacts(level).bodies] == [False]


def test_bodies_differ_by_what_floors_feel() -> None:
    templates = (
        "walkplayer none type=player move=physics size=.065 height=.12 physflags=0x40",
        "ghost none type=ghost",
        "guard none type=actor move=physics size=.065 height=.12 physflags=0x40 maxthrust=1",
        "twin guard health=5",
        "bird guard physflags=0x2000",
        "giant guard size=.2",
    )
    found = LevelFacts(level_of(two_rooms("World templates 7", *templates))).bodies
    assert [body.names for body in found] == [("walkplayer",), ("guard", "twin"), ("giant",)]
    assert isinstance(found[0].body, Body)


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus is not at hand")
def test_balanced_says_what_exact_says() -> None:
    """Apart from pieces of edges shorter than the way looked at beyond them."""
    compared = 0.0
    for name, level in corpus_levels():
        edges = EdgeWalker(level)
        if len(edges.surface) > 100:
            continue
        balanced, exact = edges.beyond(GAIT), edges.beyond(GAIT, exact=True)
        assert [piece for piece in differing(edges, balanced, exact) if piece > BEYOND] == [], name
        compared += len(exact.edge)
    assert compared > 200


def hollow() -> tuple[Strides, list[int]]:
    """A room with floors from x = 0 to 1 and 2 to 3, and a hollow between them that is no deeper than its slopes."""
    places = itertools.product((0, 1, 1.5, 2, 3), (0, 1), (-0.02, 0, 1))
    ends = {place: i for i, place in enumerate(places)}

    def flat(left: float, right: float, z: float) -> list[int]:
        return [ends[p] for p in ((left, 0, z), (right, 0, z), (right, 1, z), (left, 1, z))]

    rings = [
        (flat(0, 1, 0), -1), (flat(1, 2, 0), 1), (flat(2, 3, 0), -1), (flat(0, 3, 1)[::-1], -2),
        ([ends[p] for p in ((0, 0, 0), (0, 0, 1), (3, 0, 1), (3, 0, 0))], -2),
        ([ends[p] for p in ((3, 1, 0), (3, 1, 1), (0, 1, 1), (0, 1, 0))], -2),
        ([ends[p] for p in ((0, 1, 0), (0, 1, 1), (0, 0, 1), (0, 0, 0))], -2),
        ([ends[p] for p in ((3, 0, 0), (3, 0, 1), (3, 1, 1), (3, 1, 0))], -2),
        (flat(1, 2, 0)[::-1], 0),
        ([ends[p] for p in ((1, 0, 0), (1.5, 0, -0.02), (1.5, 1, -0.02), (1, 1, 0))], -1),
        ([ends[p] for p in ((1.5, 0, -0.02), (2, 0, 0), (2, 1, 0), (1.5, 1, -0.02))], -1),
        ([ends[p] for p in ((1, 0, 0), (2, 0, 0), (1.5, 0, -0.02))], -2),
        ([ends[p] for p in ((2, 1, 0), (1, 1, 0), (1.5, 1, -0.02))], -2),
    ]  # fmt: skip
    numbers = np.cumsum([0, *(len(ring) for ring, _ in rings)]).astype(np.int32)
    corners = np.concatenate([ring for ring, _ in rings]).astype(np.int32)
    none = np.zeros(0, np.int32)
    strides = Strides(
        np.array(list(ends), np.float64).ravel(), numbers, corners, np.array([leads for _, leads in rings], np.int32),
        np.zeros(2, np.uint8), np.array([0, 8], np.int32), np.array([8, 5], np.int32),
        np.zeros(0), np.zeros(1, np.int32), none, none, np.zeros(0, np.uint8),
    )  # fmt: skip
    return strides, [9, 10]


def test_from_the_rim_of_a_hollow_the_floor_around_it_is_level() -> None:
    """At its rim the hollow's sector has no height: the way up leaves it before it goes anywhere."""
    strides, slopes = hollow()
    edge = [np.array(column, np.int32) for column in (slopes, [-1, -1], [3, 1])]
    for found in (
        strides.ledges(*edge, np.zeros(0, np.uint8), *GAIT, 0, 1),
        strides.exact_ledges(*edge, np.zeros(0, np.uint8), *GAIT, 1),
    ):
        beyond = Beyond(*found)
        assert beyond.over.tolist() == [Over.FLOOR] * 2
        assert beyond.met.tolist() == [0, 2]
        assert beyond.drop_start.tolist() == beyond.drop_end.tolist() == [0, 0]


def test_exact_measures_pits_and_slopes() -> None:
    level = level_of(two_rooms(*SLOPE))
    found = LevelFacts(level).ledges(PLAYER, accuracy="exact")
    rows = np.flatnonzero((found.surface == 0) & (found.corner == 2))
    assert [Kind(k) for k in found.kind[rows]] == [Kind.FALL, Kind.SEAMLESS]
    assert found.drop_start[rows[0]] == float(np.float32(0.4))


@pytest.mark.parametrize("corner", ["2: 1e30 1 0", "2: 1 1e30 -1e30", "3: -1e30 1 1e28", "8: 1e30 2e30 3e29"])
def test_a_vast_bent_floor_ends(corner: str) -> None:
    """Where a place is closed in on, doubles may have nothing between two places while they are still far apart."""
    edges = EdgeWalker(level_of(two_rooms("World vertices 12", corner)))
    assert len(edges.beyond(GAIT).edge) >= len(edges.surface) > 0
