"""What blocks sight by profile, and what an AI sees."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine import ai_sight, sight
from jktools.engine.ai_sight import Look, Verdict
from jktools.engine.profile import Engine
from jktools.engine.sight import ThingType, Through

# surface flags, adjoin flags, has an adjoin: blocks in research, in openjkdf2, a blast in openjkdf2
SURFACES = [
    (0x4, 0x0, False, True, True, True),
    (0x0, 0x0, False, True, False, False),
    (0x0, 0x3, False, True, False, False),
    (0x4, 0x1, True, False, False, True),
    (0x0, 0x2, True, True, True, False),
    (0x4, 0x7, True, False, False, False),
    (0x0, 0x0, True, True, True, True),
]


def test_surfaces() -> None:
    flags, adjoins, has, research, openjkdf2, blast = (list(column) for column in zip(*SURFACES, strict=True))
    assert sight.surface_blocks(flags, adjoins, has).tolist() == research
    assert sight.surface_blocks(flags, adjoins, has, Engine.OPENJKDF2).tolist() == openjkdf2
    assert sight.surface_blocks(flags, adjoins, has, Engine.OPENJKDF2, Through.BLAST).tolist() == blast


# is cog, collide, thing flags, is one of the two: blocks in research, in openjkdf2
THINGS = [
    (True, 1, 0x0, False, True, True),
    (True, 3, 0x40, False, True, True),
    (False, 1, 0x0, False, True, False),
    (True, 0, 0x0, False, False, False),
    (True, 3, 0x80000, False, False, False),
    (True, 3, 0x2, False, False, False),
    (True, 3, 0x10, False, True, True),  # invisible, but solid
    (True, 3, 0x0, True, False, False),
]


def test_things() -> None:
    cog, collide, flags, end, research, openjkdf2 = (list(column) for column in zip(*THINGS, strict=True))
    assert sight.thing_blocks(cog, collide, flags, end).tolist() == research
    assert sight.thing_blocks(cog, collide, flags, end, Engine.OPENJKDF2).tolist() == openjkdf2


def test_the_ends_of_a_ray() -> None:
    assert [sight.end_on_face_blocks(engine) for engine in Engine] == [False, True]
    assert sight.face_is_seen([-1.0, -2e-5, -1e-5, 0.0, 1.0], Engine.OPENJKDF2).tolist() == [
        False,
        False,
        True,
        True,
        True,
    ]
    assert sight.face_is_seen([-1.0, 1.0]).tolist() == [True, True]


def test_a_collide_box_that_holds_the_end_hides_its_sector() -> None:
    low, high = [[0.0, 0.0, 0.0], [np.nan] * 3], [[1.0, 1.0, 1.0], [np.nan] * 3]
    assert sight.sector_is_skipped(low, high, [0.5, 0.5, 0.5], Engine.OPENJKDF2).tolist() == [True, False]
    assert sight.sector_is_skipped(low, high, [0.5, 0.5, 1.0], Engine.OPENJKDF2).tolist() == [False, False]
    assert sight.sector_is_skipped(low, high, [0.5, 0.5, 0.5]).tolist() == [False, False]


def look(target: list[float], size: float = 0.0, **water: bool) -> Look:
    """One looker at the origin, facing north (y), and one target."""
    return Look([[0.0] * 3], [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]], [target], [size], **water)


def at(degrees: float, up: float = 0.0) -> list[float]:
    """A target 2 JKU away, so many degrees to the right of straight ahead."""
    return [2 * np.sin(np.radians(degrees)), 2 * np.cos(np.radians(degrees)), up]


def judged(view: Look, **named: float) -> Verdict:
    return Verdict(int(ai_sight.verdicts(view, **named)[0]))


# The half angles that the rule gives: asin(1 - fov) in front; below 0 it is blind behind, to asin(fov + 1).
FOVS = [(0.0, 89.9, 90.1), (0.5, 29.9, 30.1), (0.29, 45.2, 45.3), (1.0, 0.0, 0.1), (-0.5, 149.9, 150.1)]


@pytest.mark.parametrize(("fov", "inside", "outside"), FOVS)
def test_field_of_view(fov: float, inside: float, outside: float) -> None:
    for side in (-1, 1):
        assert judged(look(at(side * inside)), fov=fov) is Verdict.SEEN
        assert judged(look(at(side * outside)), fov=fov) is Verdict.OUT_OF_VIEW


def test_an_ai_that_looks_everywhere() -> None:
    for fov in (-1.0, -5.0):
        assert judged(look(at(180.0)), fov=fov) is Verdict.SEEN
    assert judged(look([0.0, 0.0, 0.0]), fov=1.0) is Verdict.SEEN
    assert judged(look([0.0, 0.0, 9.0]), fov=0.9) is Verdict.SEEN  # straight up: no side component


def test_range_less_the_size_of_the_target_twice() -> None:
    for distance, size, seen in ((5.0, 0.0, True), (5.1, 0.0, False), (5.9, 0.5, True), (6.1, 0.5, False)):
        verdict = judged(look([0.0, distance, 0.0], size), sight_range=5.0)
        assert verdict is (Verdict.SEEN if seen else Verdict.TOO_FAR)
    assert ai_sight.distance_to_target(look([0.0, 3.0, 4.0], 0.5)).tolist() == [4.5]
    assert ai_sight.distance_to_target(look([0.0, 0.1, 0.0], 0.5)).tolist() == [0.0]
    # A range below 0 still sees what its own size reaches past.
    assert judged(look([0.0, 0.2, 0.0], 0.5), sight_range=-0.4) is Verdict.SEEN
    assert judged(look([0.0, 0.2, 0.0], 0.5), sight_range=-0.6) is Verdict.TOO_FAR


# looker in water, target in water, target floats: hidden
WATER = [
    (False, False, False, False), (True, True, False, False), (True, True, True, False),
    (False, True, True, False), (False, True, False, True), (True, False, False, True),
    (True, False, True, True),
]  # fmt: skip


@pytest.mark.parametrize(("looker", "target", "floats", "hidden"), WATER)
def test_water(looker: bool, target: bool, floats: bool, hidden: bool) -> None:
    view = look([0.0, 1.0, 0.0], looker_in_water=looker, target_in_water=target, target_on_water=floats)
    assert judged(view) is (Verdict.HIDDEN if hidden else Verdict.SEEN)


def test_the_order_of_the_verdicts() -> None:
    """Water comes before range, range before the field of view."""
    behind_far_under = look([0.0, -99.0, 0.0], target_in_water=True)
    assert judged(behind_far_under, fov=0.5) is Verdict.HIDDEN
    assert judged(look([0.0, -99.0, 0.0]), fov=0.5) is Verdict.TOO_FAR


def test_what_hides_a_target_from_an_ai() -> None:
    assert [kind for kind in ThingType if ai_sight.thing_hides(kind)] == [ThingType.ACTOR, ThingType.COG]
