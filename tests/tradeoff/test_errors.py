"""Errors of answers that are wrong in known ways."""

from __future__ import annotations

import math

import numpy as np
import pytest

from jktools.facts.ledges import Kind
from jktools.geometry import Drop, Ending, VisibleSectors
from jktools.geometry.mesh import Location, Sight
from jktools.tradeoff import errors
from jktools.tradeoff.answers import Hollow, Stop, Viewed, Walked
from jktools.tradeoff.overlay import Intervals, overlay


def intervals(*rows: tuple[int, float, float]) -> Intervals:
    edge, start, end = zip(*rows, strict=True) if rows else ((), (), ())
    return Intervals(np.array(edge, np.int32), np.array(start, np.float64), np.array(end, np.float64))


def test_overlay_cuts_each_at_the_ends_of_the_other() -> None:
    one = intervals((0, 0, 0.5), (0, 0.5, 1), (2, 0, 1))
    other = intervals((0, 0, 0.25), (0, 0.25, 1), (1, 0, 1), (2, 0, 1))
    found = overlay(one, other)
    rows = list(zip(*(column.tolist() for column in found), strict=True))
    assert rows == [
        (0, 0, 0.25, 0, 0), (0, 0.25, 0.5, 0, 1), (0, 0.5, 1, 1, 1), (1, 0, 1, -1, 2), (2, 0, 1, 2, 3),
    ]  # fmt: skip
    assert [row[3] for row in zip(*(c.tolist() for c in overlay(intervals(), other)), strict=True)] == [-1] * 4


def test_overlay_of_ends_that_differ_in_the_last_bit() -> None:
    """On an edge of a great number sums lose these bits, but no piece may fall to the wrong interval."""
    edge = 100_000
    cut = 1 / 3
    one = intervals((edge, 0, cut), (edge, cut, 1))
    other = intervals((edge, 0, math.nextafter(cut, 1)), (edge, math.nextafter(cut, 1), 1))
    found = overlay(one, other)
    assert found.one.tolist()[0] == 0
    assert found.one.tolist()[-1] == 1
    assert found.other.tolist()[0] == 0
    assert found.other.tolist()[-1] == 1
    assert float(np.diff([found.start, found.end], axis=0).sum()) == pytest.approx(1)


def sight(visible: str, blocker: str) -> Sight:
    count = np.ones(len(visible), np.int32)
    return Sight(np.array([v == "y" for v in visible]), count, np.array([int(b) for b in blocker], np.int32))


def test_wrong_verdicts_are_counted_apart_at_edges() -> None:
    exact = {"things": sight("yyny", "1111"), "edges": sight("yn", "11")}
    found = {"things": sight("yyyy", "1112"), "edges": sight("ny", "21")}
    error = errors.sight_error(found, exact)
    assert error.worst == 0.25
    assert error.measures == {"asked": 4, "wrong": 1, "asked_at_edges": 2, "wrong_at_edges": 2, "unlike": 1}
    assert error.text == "1 of 4 wrong, at edges 2 of 2, 1 right by another way"
    assert errors.sight_error(exact, exact).text == "none"


def test_a_point_in_another_sector_is_wrong_and_one_that_touches_more_is_not() -> None:
    def located(*rows: tuple[int, int, int]) -> Location:
        return Location(*(np.array(column, np.int32) for column in zip(*rows, strict=True)))

    exact, found = located((0, 1, 0), (1, 0, 2), (-1, 0, 0)), located((0, 1, 0), (1, 0, 1), (3, 1, 0))
    assert errors.location_error({"things": found}, {"things": exact}).measures == {
        "asked": 3, "wrong": 1, "asked_at_edges": 0, "wrong_at_edges": 0, "unlike": 1,
    }  # fmt: skip


def test_depth_counts_where_falls_end_alike() -> None:
    def dropped(*rows: tuple[int, float, Ending]) -> Drop:
        surface, distance, ending = zip(*rows, strict=True)
        found = np.array(surface, np.int32)
        return Drop(found, np.array(distance), np.array(ending, np.uint8), found, np.zeros(len(rows), np.int32))

    exact = dropped((1, 2.0, Ending.FLOOR), (2, 1.0, Ending.FLOOR), (-1, np.inf, Ending.NOTHING))
    found = dropped((1, 2.5, Ending.FLOOR), (3, 1.25, Ending.FLOOR), (7, 9.0, Ending.FLOOR))
    error = errors.drop_error({"random": found}, {"random": exact})
    assert (error.measures["wrong"], error.measures["depth_most"]) == (2, 0.5)
    assert errors.drop_error({"random": exact}, {"random": exact}).measures["depth_most"] == 0


def test_missed_and_false_pairs_and_segments_that_prove_it() -> None:
    def viewed(rows: list[list[int]], refuted: int = 0) -> Viewed:
        bits = np.packbits(np.array(rows, np.uint8), axis=1, bitorder="little")
        return Viewed(VisibleSectors(bits, 4, 0), 10, refuted, np.eye(3, dtype=np.bool_))

    exact = viewed([[1, 1, 0], [1, 1, 1], [0, 1, 1]])
    found = viewed([[1, 1, 1], [1, 1, 0], [1, 1, 1]], 3)
    error = errors.visibility_error(found, exact)
    assert error.measures == {
        "pairs": 7, "missed": 1, "false": 2, "missed_in_file": 4, "segments": 10, "refuted": 3, "cut_short": 0,
        "cut_short_exact": 0,
    }  # fmt: skip
    assert error.worst == 3 / 7
    assert error.text == "3 segments see a pair denied, 1 pairs missed, 2 false pairs beside 7, 4 missed in the file"


def walked(*rows: tuple[int, float, float, Kind, float, float], lengths: tuple[float, ...] = (2.0, 1.0)) -> Walked:
    edge, start, end, kind, first, last = zip(*rows, strict=True) if rows else ((),) * 6
    return Walked(
        np.array(lengths), intervals(*zip(edge, start, end, strict=True)), np.array(kind, np.uint8),
        np.array(first, np.float64), np.array(last, np.float64),
    )  # fmt: skip


def test_length_classed_wrong_and_ledges_missed() -> None:
    exact = walked(
        (0, 0, 0.5, Kind.LEVEL, 0, 0), (0, 0.5, 0.6, Kind.FALL, 1, 1), (0, 0.6, 1, Kind.FALL, 1, 2),
        (1, 0, 0.5, Kind.LEVEL, 0, 0), (1, 0.5, 1, Kind.WATER, 0.5, 0.5),
    )  # fmt: skip
    found = walked(
        (0, 0, 0.75, Kind.LEVEL, 0, 0), (0, 0.75, 1, Kind.FALL, 2, 2), (1, 0, 0.1, Kind.NONE, np.nan, np.nan),
        (1, 0.1, 1, Kind.LEVEL, 0, 0),
    )  # fmt: skip
    error = errors.ledge_error([found], [exact])
    wrong = 0.25 * 2 + 0.1 + 0.5
    assert error.measures == pytest.approx({
        "length": 3, "wrong_length": wrong, "wrong_longest": 0.5, "ledges": 2, "missed": 1, "false": 1,
        # Alike: 0 .. 0.5 of edge 0, level; 0.75 .. 1 of it, said to be 2 deep and 1.375 to 2; 0.1 .. 0.5 of edge 1.
        "depth_mean": 0.5 * 0.625 / (1 + 0.5 + 0.4), "depth_most": 0.625,
    })  # fmt: skip
    assert error.worst == pytest.approx(wrong / 3)
    assert errors.ledge_error([exact], [exact]).text == "none"


def test_a_body_that_has_no_ledges_at_one_tier_misses_all() -> None:
    exact = walked((0, 0, 1, Kind.FALL, 1, 1), (1, 0, 1, Kind.LEVEL, 0, 0))
    error = errors.ledge_error([walked()], [exact])
    assert (error.measures["wrong_length"], error.measures["missed"], error.measures["false"]) == (3, 1, 0)
    assert errors.ledge_error([], []).worst == 0


def test_basins_are_told_apart_by_their_floors() -> None:
    exact = [
        Hollow(0, frozenset({1, 2}), 1.0, 2.0, 1, 0), Hollow(0, frozenset({5}), 1.0, 1.0, 2, 0),
        Hollow(1, frozenset({1}), 1.0, 1.0, 2, 0),
    ]  # fmt: skip
    found = [
        Hollow(0, frozenset({1, 2}), 1.0, 2.25, 1, 8), Hollow(0, frozenset({7}), 1.0, 1.0, 2, 0),
        Hollow(1, frozenset({1}), 1.0, 1.0, 2, 0),
    ]  # fmt: skip
    error = errors.basin_error(found, exact)
    assert error.measures == {"basins": 3, "missed": 1, "false": 1, "unlike": 1, "depth_most": 0.25}
    assert error.worst == 1
    assert errors.basin_error([], []).worst == 0


def test_ways_to_rest_as_intervals() -> None:
    exact = [Stop("a", "walk", 1.0, 1.5), Stop("a", "run", 2.0, 2.5), Stop("b", "walk", math.inf, math.inf)]
    found = [Stop("a", "walk", 1.25, 1.25), Stop("a", "run", 2.75, 2.75), Stop("b", "walk", 3.0, 3.0)]
    error = errors.motion_error(found, exact)
    assert error.measures == {"stops": 3, "off_most": 0.75, "outside": 1, "unlike": 1, "widest": 0.5}
    assert errors.motion_error(exact, exact).worst == 0


def test_moved_vertices() -> None:
    exact = np.zeros((2, 3))
    error = errors.geometry_error(np.array([[0, 0, 0], [3, 0, 4]], np.float64), exact)
    assert (error.worst, error.measures["moved_mean"]) == (5, 2.5)
    assert error.text == "vertices moved by up to 5 JKU"
    assert errors.geometry_error(np.zeros((0, 3)), np.zeros((0, 3))).worst == 0
