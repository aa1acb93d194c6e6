"""How the engine computes: dynamic types, conversions and operators (sithCogExec of the decompiled engine).

A value is an `int` (32 bits, signed), a `float` (a flex, always one of float32), a `Vector` or a `String`. Names of
verbs evaluate to some nonzero int. Nothing here raises: what makes no sense gives what the engine gives.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias


class Vector(NamedTuple):
    """Three flexes."""

    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True)
class String:
    """A literal of the script; only these are strings."""

    text: str


Value: TypeAlias = int | float | Vector | String

NO_INT = -1
"""What a vector, a string or nothing at all is as an int: true."""
ZERO_VECTOR = Vector(0.0, 0.0, 0.0)
_NO_CONVERSION = -(2**31)
"""What x86 makes of a flex that no int can hold."""

_flex = struct.Struct("<f")


def flex(number: float) -> float:
    """The nearest float32; infinite beyond it."""
    try:
        result: float = _flex.unpack(_flex.pack(number))[0]
    except OverflowError:
        return math.copysign(math.inf, number)
    return result


def int32(number: int) -> int:
    """The low 32 bits as a signed number."""
    return ((number + 2**31) & 0xFFFFFFFF) - 2**31


def to_int(value: Value | None) -> int:
    """As a condition, an index or an int argument takes it: truncated toward zero; -1 for what is no number."""
    if isinstance(value, int):
        return value
    if isinstance(value, float):
        if not -2147483649.0 < value < 2147483648.0:  # NaN too
            return _NO_CONVERSION
        return int(value)
    return NO_INT


def to_flex(value: Value | None) -> float:
    """As arithmetic and flex arguments take it; 0 for what is no number."""
    if isinstance(value, float):
        return value
    if isinstance(value, int):
        return flex(value)
    return 0.0


def to_vector(value: Value | None) -> Vector:
    """As a vector argument takes it; the zero vector for anything else."""
    return value if isinstance(value, Vector) else ZERO_VECTOR


def is_true(value: Value | None) -> bool:
    """Whether a condition holds: 0.5 does not, -1 does."""
    return to_int(value) != 0


def divide(a: float, b: float) -> float:
    """`/`: 0 for a division by 0 (the decompiled engine; not confirmed for the original)."""
    return flex(a / b) if b != 0 else 0.0


def modulo(a: float, b: float) -> float:
    """`%`: the remainder with the sign of the left side; NaN for 0."""
    if b == 0 or math.isinf(a) or math.isnan(a) or math.isnan(b):
        return math.nan
    return flex(math.fmod(a, b))


_ON_FLEX: Mapping[str, Callable[[float, float], float | int]] = {
    "+": lambda a, b: flex(a + b),
    "-": lambda a, b: flex(a - b),
    "*": lambda a, b: flex(a * b),
    "/": divide,
    "%": modulo,
    "<": lambda a, b: int(a < b),
    ">": lambda a, b: int(a > b),
    "<=": lambda a, b: int(a <= b),
    ">=": lambda a, b: int(a >= b),
    "==": lambda a, b: int(a == b),
}
_ON_INT: Mapping[str, Callable[[int, int], int]] = {
    "!=": lambda a, b: int(a != b),
    "&&": lambda a, b: int(a != 0 and b != 0),
    "||": lambda a, b: int(a != 0 or b != 0),
    "&": lambda a, b: a & b,
    "|": lambda a, b: a | b,
    "^": lambda a, b: a ^ b,
}
ARITHMETIC = frozenset("+-*/%")
COMPARES_FLEX = frozenset({"<", ">", "<=", ">=", "=="})
ON_INT = frozenset(_ON_INT)


def binary(operator: str, left: Value | None, right: Value | None) -> Value:
    """What a binary operator leaves on the stack."""
    on_flex = _ON_FLEX.get(operator)
    if on_flex is not None:
        return on_flex(to_flex(left), to_flex(right))
    return _ON_INT[operator](to_int(left), to_int(right))


def unary(operator: str, operand: Value | None) -> Value:
    """What `-` or `!` leaves on the stack: `-` a flex, 0 for a vector; `!` 1 for anything that truncates to 0."""
    if operator == "-":
        return -to_flex(operand)
    return int(not is_true(operand))
