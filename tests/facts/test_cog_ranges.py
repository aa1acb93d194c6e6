"""A range must hold what the engine computes from any of its values; the engine's arithmetic is tested by itself."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jktools.facts.cog import ranges
from jktools.facts.cog.ranges import Range
from jktools.model.cog import values
from jktools.model.cog.values import Value
from tests.support.cog_bounds import holds

INTS = st.one_of(st.integers(-5, 5), st.integers(-(2**31), 2**31 - 1), st.sampled_from([2**24, 2**24 + 1, -1]))
FLEXES = st.one_of(
    st.floats(-4, 4, width=32),
    st.floats(width=32),
    st.sampled_from([0.0, -0.0, 0.5, -1.0, 1.0, 2.0**31, math.inf, -math.inf, math.nan]),
)
VALUES: st.SearchStrategy[Value] = st.one_of(
    INTS, FLEXES, st.just(values.Vector(1.0, 2.0, 3.0)), st.just(values.String("x"))
)
OPERATORS = sorted(values.ARITHMETIC | values.COMPARES_FLEX | values.ON_INT)


@st.composite
def ranges_with_a_value(draw: st.DrawFn) -> tuple[Range, Value]:
    """A range that some values span, and one of them."""
    several = draw(st.lists(VALUES, min_size=1, max_size=4))
    spanned = ranges.of_value(several[0])
    for each in several[1:]:
        spanned = ranges.join(spanned, ranges.of_value(each))
    return spanned, draw(st.sampled_from(several))


@given(st.sampled_from(OPERATORS), ranges_with_a_value(), ranges_with_a_value())
def test_binary_holds_every_result(operator: str, a: tuple[Range, Value], b: tuple[Range, Value]) -> None:
    assert holds(ranges.binary(operator, a[0], b[0]), values.binary(operator, a[1], b[1]))


@given(st.sampled_from("-!"), ranges_with_a_value())
def test_unary_holds_every_result(operator: str, a: tuple[Range, Value]) -> None:
    assert holds(ranges.unary(operator, a[0]), values.unary(operator, a[1]))


@given(ranges_with_a_value())
def test_conversions_hold_every_result(a: tuple[Range, Value]) -> None:
    low, high = ranges.as_int(a[0])
    assert low <= values.to_int(a[1]) <= high
    bottom, top = ranges.as_flex(a[0])
    number = values.to_flex(a[1])
    assert math.isnan(number) or bottom <= number <= top
    assert ranges.truth(a[0]) in (None, values.is_true(a[1]))


@given(ranges_with_a_value(), ranges_with_a_value())
def test_join_and_widen_hold_both(a: tuple[Range, Value], b: tuple[Range, Value]) -> None:
    for both in (ranges.join(a[0], b[0]), ranges.widen(a[0], b[0])):
        assert holds(both, a[1]) and holds(both, b[1])


@given(st.sampled_from(sorted(ranges.MIRROR)), ranges_with_a_value(), ranges_with_a_value())
def test_what_a_condition_leaves_holds_what_meets_it(
    operator: str, a: tuple[Range, Value], b: tuple[Range, Value]
) -> None:
    outcome = values.is_true(values.binary(operator, a[1], b[1]))
    left = ranges.refine(operator, a[0], b[0], holds=outcome)
    assert left is not None and holds(left, a[1])


@pytest.mark.parametrize(
    ("operator", "a", "b", "result"),
    [
        ("+", Range(ranges.INT, 0, 3), Range(ranges.INT, 1, 1), Range(ranges.FLEX, 1, 4)),
        ("<", Range(ranges.INT, 0, 3), Range(ranges.FLEX, 3.5, 9), ranges.TRUE),
        ("==", Range(ranges.INT, 0, 3), Range(ranges.INT, 5, 5), ranges.FALSE),
        ("!=", Range(ranges.FLEX, 0.1, 0.2), Range(ranges.FLEX, 0.5, 0.9), ranges.FALSE),
        ("&&", Range(ranges.INT, 1, 9), Range(ranges.FLEX, 0.1, 0.9), ranges.FALSE),
        ("%", Range(ranges.INT, 0, 100), Range(ranges.INT, 8, 8), Range(ranges.FLEX, 0, 8)),
        ("&", ranges.ANY_INT, Range(ranges.INT, 6, 6), Range(ranges.INT, 0, 6)),
    ],
)
def test_ranges_are_no_wider_than_they_must(operator: str, a: Range, b: Range, result: Range) -> None:
    assert ranges.binary(operator, a, b) == result


def test_conditions_sharpen_things() -> None:
    minus_one = ranges.of_value(-1.0)
    assert ranges.refine("!=", ranges.INDEX, minus_one, holds=True) == ranges.PRESENT
    assert ranges.refine("==", ranges.INDEX, minus_one, holds=False) == ranges.PRESENT
    assert ranges.refine(">", ranges.INDEX, minus_one, holds=True) == ranges.PRESENT
    assert ranges.refine("<", ranges.PRESENT, ranges.FALSE, holds=True) is None


def test_conditions_that_cut_off_leave_fractions() -> None:
    """`0.5 != 0` does not hold, so that what is left may be 0.5."""
    assert ranges.refine("!=", Range(ranges.FLEX, 0, 1), ranges.FALSE, holds=False) == Range(ranges.FLEX, 0, 1)


def test_great_ints_compare_as_the_flexes_nearest_to_them() -> None:
    """2^24 + 1 is no flex: `16777217 <= 16777216` holds."""
    great = ranges.of_value(2**24 + 1)
    assert ranges.refine("<=", great, ranges.of_value(2**24), holds=True) == great
