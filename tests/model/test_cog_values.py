"""The engine's arithmetic, from the facts about its evaluation, not from the code."""

from __future__ import annotations

import math

import pytest

from jktools.model.cog.values import String, Value, Vector, binary, flex, int32, is_true, to_flex, to_int, unary

HERE = Vector(1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ("operator", "left", "right", "result"),
    [
        ("!=", 0.2, 0.7, 0),  # both cut off to 0
        ("==", 0.2, 0.7, 0),
        ("==", 1, 1.0, 1),
        ("&&", 0.5, 1, 0),
        ("||", 0.5, 0.9, 0),
        ("&", 6.9, 3, 2),
        ("^", 5, 1, 4),
        ("|", -1, 2, -1),
        ("<", 0.2, 0.7, 1),
        ("+", 1, 2, 3.0),
        ("/", 7, 2, 3.5),
        ("/", 7, 0, 0.0),
        ("%", 7, 4, 3.0),
        ("%", -7, 4, -3.0),
        ("==", HERE, Vector(9.0, 9.0, 9.0), 1),  # vectors are 0 to ==
        ("!=", HERE, Vector(9.0, 9.0, 9.0), 0),  # and -1 to !=
        ("+", HERE, 4, 4.0),
        ("==", 16777217, 16777216, 1),  # ints compare as float32
        ("!=", 16777217, 16777216, 1),
        ("*", 3e38, 10, math.inf),
    ],
)
def test_operators(operator: str, left: Value, right: Value, result: Value) -> None:
    found = binary(operator, left, right)
    assert (found, type(found)) == (result, type(result))


def test_modulo_by_zero_is_not_a_number() -> None:
    found = binary("%", 5, 0)
    assert isinstance(found, float) and math.isnan(found)


def test_unary_minus_gives_a_flex_and_not_gives_0_or_1() -> None:
    assert (unary("-", 1), type(unary("-", 1))) == (-1.0, float)
    assert unary("-", HERE) == 0.0
    assert (unary("!", 0.5), unary("!", -1), unary("!", HERE)) == (1, 0, 0)


def test_what_is_no_number_is_minus_one_as_int_and_zero_as_flex() -> None:
    for value in (HERE, String("x"), None):
        assert to_int(value) == -1
        assert to_flex(value) == 0.0
        assert is_true(value)


def test_conditions_cut_off() -> None:
    assert not is_true(0.5)
    assert not is_true(-0.9)
    assert is_true(-1)
    assert is_true(-1.5)


def test_flexes_are_float32_and_ints_32_bits() -> None:
    assert flex(0.1) == 0.10000000149011612
    assert flex(1e39) == math.inf
    assert int32(2**31) == -(2**31)
    assert int32(-(2**31) - 1) == 2**31 - 1
    assert to_int(1e10) == to_int(math.nan) == to_int(-math.inf) == -(2**31)
    assert to_int(-2147483648.0) == -(2**31)
