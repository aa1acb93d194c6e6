"""Ledges by edge, by thing and by a body's way over a floor, worked out by hand."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from jktools.compiler import CompiledLevel, Leave, ThingFace, compile_level
from jktools.compiler.leaving import leaving
from jktools.compiler.walking import Ledge
from jktools.facts.floors import PLACED
from jktools.facts.ledges import Kind
from tests.facts.test_ledges_on_things import FRAMES, with_box
from tests.support.halls import halls
from tests.support.levels import TWO_ROOMS, level_of

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
NOTCHED = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
"""A square of 3 by 2 with a slot from above, between x = 1 and 2 down to y = 1."""
STAYS = (True, -1, 0, 1)
OUTSIDE = (False, -1, 0, 1)
BIT = Fraction(1, 2**52)
BEYOND = float(1 + BIT)
NEARLY = Fraction(1, 2) / (Fraction(1, 2) + BIT)
"""Of the way from 0.5 to BEYOND, the part up to 1."""


@pytest.mark.parametrize(
    ("ring", "origin", "target", "found"),
    [
        (SQUARE, (0.5, 0.5), (0.5, 0.75), STAYS),
        (SQUARE, (0.5, 0.5), (1.5, 0.5), (True, 1, 0.5, 0.5)),
        (SQUARE, (0.25, 0.5), (0.25, -1.5), (True, 0, 0.25, 0.25)),
        (SQUARE, (0.5, 0.5), (1, 0.5), STAYS),  # an end on the edge is still on the floor
        (SQUARE, (1, 0.5), (2, 0.75), (True, 1, 0.5, 0)),
        (SQUARE, (1, 0.5), (1, 0.75), STAYS),
        (SQUARE, (1, 0.5), (1, 2), (True, 2, 0, Fraction(1, 3))),  # along an edge to its end
        (SQUARE, (0.5, 0.5), (2, 2), (True, 1, 1, Fraction(1, 3))),  # by a corner: the first of both edges
        (SQUARE, (0.5, 0.5), (BEYOND, 1), (True, 1, (1 + NEARLY) / 2, NEARLY)),
        (SQUARE, (0.5, 0.5), (1, BEYOND), (True, 2, (1 - NEARLY) / 2, NEARLY)),
        (SQUARE, (1, 1), (2, 2), (True, 1, 1, 0)),
        (SQUARE, (1.5, 0.5), (2, 0.5), OUTSIDE),
        (SQUARE, (1.5, 0.5), (0.5, 0.5), OUTSIDE),
        (SQUARE, (BEYOND, 0.5), (2, 0.5), OUTSIDE),
        (SQUARE, (2, 1), (3, 1), OUTSIDE),  # on the line of an edge, beyond it
        (SQUARE[::-1], (0.5, 0.5), (1.5, 0.5), OUTSIDE),  # faces down
        (NOTCHED, (0.5, 1.5), (2.5, 1.5), (True, 5, 0.5, 0.25)),  # over both parts: leaves the first
        (NOTCHED, (0.5, 1.5), (9, 1.5), (True, 5, 0.5, Fraction(1, 17))),
        (NOTCHED, (0.5, 0.5), (2.5, 0.5), STAYS),
        (NOTCHED, (1.5, 1.5), (0.5, 1.5), OUTSIDE),
        (NOTCHED, (2.5, 1.5), (-1, 1.5), (True, 3, 0.5, Fraction(1, 7))),
        ([(0, 0), (0, 0), (2, 0), (0, 2)], (0.5, 0.5), (0.5, -0.5), (True, 1, 0.25, 0.5)),  # a corner twice
    ],
)
def test_where_a_way_leaves_a_polygon(
    ring: list[tuple[float, float]],
    origin: tuple[float, float],
    target: tuple[float, float],
    found: tuple[bool, int, Fraction, Fraction],
) -> None:
    inside, corner, place, along = found
    assert leaving(ring, origin, target) == (inside, corner, float(place), float(along))


def test_the_places_are_the_nearest_doubles() -> None:
    ring = [(0.0, 0.0), (3.0, 0.0), (0.0, 3.0)]
    found = leaving(ring, (0.1, 0.1), (0.3, -0.6))
    tenth, third, below = Fraction(0.1), Fraction(0.3), Fraction(-0.6)
    along = tenth / (tenth - below)
    assert (found.along, found.place) == (float(along), float((tenth + along * (third - tenth)) / 3))


def test_a_drop_is_the_nearest_double_between_those_of_the_ends() -> None:
    ledge = Ledge(0.25, 0.75, Kind.FALL, Kind.FALL, 7, -1, 1.0, 2.0, 0)
    assert [ledge.drop(place) for place in (0.25, 0.5, 0.75)] == [1, 1.5, 2]
    third = 1 / 3
    assert ledge.drop(third) == float(1 + 2 * (Fraction(third) - Fraction(1, 4)))
    assert math.isnan(ledge.drop(0.76))
    assert math.isnan(ledge._replace(drop_start=math.nan).drop(0.5))
    assert ledge._replace(end=0.25).drop(0.25) == 1


def floor_at(compiled: CompiledLevel, x: float, y: float) -> int:
    surface, _, ending = compiled.mesh.drop([(x, y, 2.5)], [compiled.mesh.locate([(x, y, 2.5)])[0]])[:3]
    assert ending[0] == 0
    return int(surface[0])


def test_a_body_leaves_the_floors_of_the_halls() -> None:
    """Floors at 0 up to x = 4, a pit of 2 JKU to 6, a bank to 8, a step of 1/16 to 8.5, and 0.5 beyond."""
    compiled = CompiledLevel(compile_level(halls()))
    body = compiled.body_of("WalkPlayer")
    hall, pit, bank, step = (floor_at(compiled, x, 2) for x in (2, 5, 7, 8.25))

    def leave(floor: int, origin: tuple[float, float], target: tuple[float, float]) -> Leave:
        return compiled.leave(body, floor, (*origin, 0.18), (*target, 0.18))

    over = leave(hall, (2, 2), (5, 2))
    assert (over.kind, over.along, over.drop, over.ledge.below) == (Kind.FALL, float(Fraction(2, 3)), 2, pit)
    assert over.detaches
    up = leave(bank, (7, 2), (8.25, 2))
    assert (up.kind, up.along, up.drop, up.ledge.below) == (Kind.STEP, 0.8, -0.0625, step)
    assert not up.detaches
    wall = leave(hall, (2, 2), (2, -2))
    assert (wall.kind, wall.along, wall.place) == (Kind.WALL, 0.5, 0.5)
    assert math.isnan(wall.drop)
    inside = leave(hall, (2, 2), (3, 3))
    assert (inside.corner, inside.kind, inside.drop) == (-1, Kind.LEVEL, 0)
    elsewhere = leave(hall, (5, 2), (7, 2))
    assert (elsewhere.corner, elsewhere.kind) == (-1, Kind.UNKNOWN)
    ceiling = int(np.flatnonzero(compiled.surface_flags & 1 == 0)[0])
    for floor in (ceiling, -1, len(compiled.surface_flags)):
        assert leave(floor, (2, 2), (3, 3)).kind == Kind.UNKNOWN
    for bad in (math.nan, math.inf, 2.0**150):
        assert leave(hall, (2, 2), (bad, 2)).kind == Kind.UNKNOWN


def test_a_level_part_of_an_edge_goes_from_ledge_to_ledge() -> None:
    """The box beyond the brink is level with it from x = 0.1 to 0.9."""
    with with_box(".5 1.4 -.5 0 0 0", (0.4, 0.4, 0.5)) as level:
        compiled = CompiledLevel(compile_level(level))
    found = compiled.leave(0, 0, (0.5, 0.5, 0.12), (0.5, 1.5, 0.12))
    assert (found.corner, found.kind, found.drop, found.along, found.place) == (2, Kind.LEVEL, 0, 0.5, 0.5)
    assert (found.ledge.start, found.ledge.end) == pytest.approx((0.1, 0.9), abs=1e-6)
    beside = compiled.leave(0, 0, (0.05, 0.5, 0.12), (0.05, 1.5, 0.12))
    assert (beside.kind, beside.drop) == (Kind.FALL, pytest.approx(0.6))
    assert beside.ledge.start == found.ledge.end
    top = [(x, y, 0.0) for x, y in ((0.1, 1.0), (0.9, 1.0), (0.9, 1.8), (0.1, 1.8))]
    back = compiled.leave(0, ThingFace(2, PLACED, 0, top), (0.5, 1.5, 0.12), (0.5, 0.5, 0.12))
    assert (back.corner, back.kind, back.along, back.place) == (0, Kind.LEVEL, 0.5, 0.5)
    assert math.isnan(back.drop), "the model of the thing tells how its own faces go on"


def test_a_body_leaves_a_thing() -> None:
    """A box of 0.8 JKU in the pit, its top 0.525 JKU over the pit's floor, and 0.375 at its frame 1."""
    frames = FRAMES.format(a=-0.2, b=-0.35).replace("1.4", "1.5")
    with with_box(".5 1.5 -.2 0 0 0", more=frames) as level:
        compiled = CompiledLevel(compile_level(level))
    for frame, top in ((PLACED, -0.075), (1, -0.225)):
        ring = [(x, y, top) for x, y in ((0.1, 1.1), (0.9, 1.1), (0.9, 1.9), (0.1, 1.9))]
        face = ThingFace(2, frame, 0, ring)
        found = compiled.leave(0, face, (0.5, 1.5, 0), (1.3, 1.5, 0))
        assert (found.corner, found.kind, found.along, found.place) == (1, Kind.FALL, 0.5, 0.5)
        assert found.drop == pytest.approx(top + 0.6)
        (edge,) = compiled.ledges_of_thing(0, 2, frame, 0, 1)
        assert edge == found.ledge
        assert compiled.ledges_of_thing(0, 2, frame, 0, 1, 0.5) == [edge]
        assert compiled.leave(0, face, (0.5, 1.5, 0), (0.6, 1.5, 0)).kind == Kind.LEVEL
        nowhere = face._replace(corners=[*ring[:3], (math.nan, 1.9, top)])
        assert compiled.leave(0, nowhere, (0.5, 1.5, 0), (1.3, 1.5, 0)).kind == Kind.UNKNOWN
    for thing, frame in ((2, 0), (2, 2), (1, PLACED), (-1, PLACED)):
        face = ThingFace(thing, frame, 0, ring)
        assert compiled.leave(0, face, (0.5, 1.5, 0), (1.3, 1.5, 0)).kind == Kind.UNKNOWN, "frame 0 counts as PLACED"
        assert compiled.ledges_of_thing(0, thing, frame, 0, 1) == []


def test_edges_of_things_are_not_those_of_surface_minus_one() -> None:
    with with_box(".5 1.5 -.2 0 0 0") as level:
        compiled = CompiledLevel(compile_level(level))
    assert compiled.ledges is not None
    assert (compiled.ledges.surface == -1).any()
    assert [compiled.ledges_at(0, -1, corner) for corner in range(4)] == [[]] * 4


def test_a_body_whose_hover_height_is_not_known_knows_no_edge() -> None:
    compiled = CompiledLevel(compile_level(level_of(TWO_ROOMS)))
    assert compiled.leave(0, 0, (0.5, 0.5, 0), (0.5, 1.5, 0)).kind == Kind.UNKNOWN
    with pytest.raises(IndexError, match="body 1 does not exist: there are 1"):
        compiled.leave(1, 0, (0.5, 0.5, 0), (0.5, 1.5, 0))


def test_a_body_by_the_name_of_a_template() -> None:
    compiled = CompiledLevel(compile_level(halls()))
    assert compiled.body_of("walkplayer") == 0
    with pytest.raises(KeyError, match="no body is of the template 'kyle'"):
        compiled.body_of("kyle")


def test_the_basin_of_a_floor() -> None:
    compiled = CompiledLevel(compile_level(halls()))
    (basin,) = compiled.basins_of(0)
    assert [compiled.basin_at(0, surface) for surface in basin.surfaces] == [basin] * len(basin.surfaces)
    assert compiled.basin_at(0, floor_at(compiled, 2, 2)) is None
    assert compiled.basin_at(1, basin.surfaces[0]) is None
