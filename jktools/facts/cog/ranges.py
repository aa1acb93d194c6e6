"""What a value can be: kinds and an interval, and how the engine's operators carry them.

A range stands for every value of its kinds whose number lies in `[low, high]`; vectors and strings have no number.
An interval that is open on both sides holds NaN too. Each operator here holds every result that
`jktools.model.cog.values` can give, which gives the exact result where its operands are single numbers.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from jktools.model.cog import values
from jktools.model.cog.values import Value, flex, to_int
from jktools.model.cog.verbs import REFERENCES, Verb

INT, FLEX, VECTOR, STRING = 1, 2, 4, 8
NUMBER = INT | FLEX
ANY_KIND = INT | FLEX | VECTOR | STRING
INF = math.inf
INT_MIN, INT_MAX = -(2**31), 2**31 - 1
MOST_INDEX = 32767
"""Greatest index of a thing or another object that a script can meet."""


class Range(NamedTuple):
    """`kinds` as bits; `low` and `high` hold the numbers, and are infinities where nothing bounds them."""

    kinds: int
    low: float
    high: float

    @property
    def number(self) -> float | None:
        """The one number that it can be, else None."""
        return self.low if self.low == self.high and not self.kinds & ~NUMBER else None

    @property
    def is_vector(self) -> bool:
        """Whether it can be nothing but a vector."""
        return self.kinds == VECTOR

    @property
    def is_string(self) -> bool:
        """Whether it can be nothing but a string."""
        return self.kinds == STRING

    @property
    def is_known(self) -> bool:
        """Whether an end of the interval is known."""
        return self.low > -INF or self.high < INF


ANY = Range(ANY_KIND, -INF, INF)
ANY_INT = Range(INT, INT_MIN, INT_MAX)
ANY_FLEX = Range(FLEX, -INF, INF)
ANY_NUMBER = Range(NUMBER, -INF, INF)
A_VECTOR = Range(VECTOR, INF, -INF)
A_STRING = Range(STRING, INF, -INF)
BOOL = Range(INT, 0, 1)
FALSE = Range(INT, 0, 0)
TRUE = Range(INT, 1, 1)
ZERO = Range(FLEX, 0.0, 0.0)
"""What an implicit variable starts as."""
INDEX = Range(INT, -1, MOST_INDEX)
PRESENT = Range(INT, 0, MOST_INDEX)

_SPECIAL = {
    "rand": Range(FLEX, 0.0, 1.0),
    "getlocalplayerthing": PRESENT,
    "jkgetlocalplayer": PRESENT,
    "getselfcog": PRESENT,
    "getthingtype": Range(INT, -1, 32),
    "getdifficulty": Range(INT, 0, 2),
    "isserver": BOOL,
    "ismulti": BOOL,
    "isthingmoving": Range(INT, -1, 1),
    "ismoving": Range(INT, -1, 1),
    "haslos": Range(INT, -1, 1),
    "getgametime": Range(INT, 0, INT_MAX),
    "getflexgametime": Range(FLEX, 0.0, INF),
    "getleveltime": Range(FLEX, 0.0, INF),
    "bittest": BOOL,
    "setmaterialcel": Range(INT, -1, -1),
    "vectorlen": Range(FLEX, 0.0, INF),
    "vectordist": Range(FLEX, 0.0, INF),
}


def of_value(value: Value) -> Range:
    """The range of one value."""
    if isinstance(value, int):
        return Range(INT, value, value)
    if isinstance(value, float):
        return ANY_FLEX if math.isnan(value) else Range(FLEX, value, value)
    return A_VECTOR if isinstance(value, values.Vector) else A_STRING


def of_result(verb: Verb) -> Range:
    """What a verb can leave on the stack; nothing is known where it may leave nothing."""
    if verb.pushes == "maybe":
        return ANY
    special = _SPECIAL.get(verb.name)
    if special is not None:
        return special
    if verb.returns in REFERENCES:
        return INDEX
    return {"int": ANY_INT, "flex": ANY_FLEX, "vector": A_VECTOR, "string": A_STRING}.get(verb.returns, ANY)


def join(a: Range, b: Range) -> Range:
    """What holds both."""
    if a == b:
        return a
    return Range(a.kinds | b.kinds, min(a.low, b.low), max(a.high, b.high))


def widen(old: Range, new: Range) -> Range:
    """What holds both, with ends that can move only a few times more."""
    low = old.low if new.low >= old.low else next((t for t in (0.0, -1.0) if new.low >= t), -INF)
    high = old.high if new.high <= old.high else next((t for t in (0.0, 1.0, MOST_INDEX) if new.high <= t), INF)
    return Range(old.kinds | new.kinds, low, high)


def as_flex(a: Range) -> tuple[float, float]:
    """The interval of what arithmetic takes it as: a vector or a string is 0."""
    low, high = a.low, a.high
    if a.kinds & ~NUMBER:
        low, high = min(low, 0.0), max(high, 0.0)
    if a.kinds & INT:  # an int beyond 2^24 is rounded
        low, high = flex(low), flex(high)
    return low, high


def as_int(a: Range) -> tuple[int, int]:
    """The interval of what conditions and int arguments take it as: a vector or a string is -1."""
    if a.low > a.high:
        return -1, -1
    if a.low == -INF and a.high == INF:
        return INT_MIN, INT_MAX
    low, high = _int(a.low, INT_MIN), _int(a.high, INT_MAX)
    if a.kinds & FLEX and (a.high >= 2147483648.0 or a.low < INT_MIN):
        low = INT_MIN  # what no int can hold becomes the least one
    if a.kinds & ~NUMBER:
        low, high = min(low, -1), max(high, -1)
    return low, high


def _int(bound: float, beyond: int) -> int:
    return beyond if math.isinf(bound) or not INT_MIN <= bound <= INT_MAX else int(bound)


def truth(a: Range) -> bool | None:
    """Whether a condition holds; None where it can be both."""
    low, high = as_int(a)
    if low == high == 0:
        return False
    return True if low > 0 or high < 0 else None


def binary(operator: str, a: Range, b: Range) -> Range:
    """The range of an operator's result."""
    if operator in values.ARITHMETIC:
        return _arithmetic(operator, as_flex(a), as_flex(b))
    if operator in values.COMPARES_FLEX:
        return _compare(operator, as_flex(a), as_flex(b))
    return _on_int(operator, as_int(a), as_int(b))


def unary(operator: str, a: Range) -> Range:
    """The range of the result of `-` or `!`."""
    if operator == "-":
        low, high = as_flex(a)
        return Range(FLEX, -high, -low)
    holds = truth(a)
    return BOOL if holds is None else FALSE if holds else TRUE


def _arithmetic(operator: str, a: tuple[float, float], b: tuple[float, float]) -> Range:
    (a0, a1), (b0, b1) = a, b
    if a0 == a1 and b0 == b1:
        return of_value(values.binary(operator, a0, b0))
    if (a0 == -INF and a1 == INF) or (b0 == -INF and b1 == INF):  # NaN among them
        return ANY_FLEX
    if operator == "+":
        ends = [a0 + b0, a1 + b1]
    elif operator == "-":
        ends = [a0 - b1, a1 - b0]
    elif operator == "*":
        ends = [a0 * b0, a0 * b1, a1 * b0, a1 * b1]
    elif operator == "/":
        if b0 <= 0 <= b1:
            return ANY_FLEX
        ends = [a0 / b0, a0 / b1, a1 / b0, a1 / b1]
    else:
        return _remainder(a, b)
    if any(map(math.isnan, ends)):
        return ANY_FLEX
    return Range(FLEX, flex(min(ends)), flex(max(ends)))


def _remainder(a: tuple[float, float], b: tuple[float, float]) -> Range:
    """The remainder has the left side's sign and is smaller than the right side."""
    if b[0] <= 0 <= b[1] or math.isinf(a[0]) or math.isinf(a[1]):
        return ANY_FLEX
    most = max(abs(b[0]), abs(b[1]))
    return Range(FLEX, max(-most, min(a[0], 0.0)), min(most, max(a[1], 0.0)))


def _compare(operator: str, a: tuple[float, float], b: tuple[float, float]) -> Range:
    (a0, a1), (b0, b1) = a, b
    if (a0 == -INF and a1 == INF) or (b0 == -INF and b1 == INF):
        return BOOL
    if operator == "==":
        if a1 < b0 or b1 < a0:
            return FALSE
        return TRUE if a0 == a1 == b0 == b1 else BOOL
    if operator in (">", ">="):
        operator = {">": "<", ">=": "<="}[operator]
        a0, a1, b0, b1 = b0, b1, a0, a1
    if operator == "<":
        return TRUE if a1 < b0 else FALSE if a0 >= b1 else BOOL
    return TRUE if a1 <= b0 else FALSE if a0 > b1 else BOOL


def _on_int(operator: str, a: tuple[int, int], b: tuple[int, int]) -> Range:
    (a0, a1), (b0, b1) = a, b
    if a0 == a1 and b0 == b1:
        return of_value(to_int(values.binary(operator, a0, b0)))
    if operator == "!=":
        return TRUE if a1 < b0 or b1 < a0 else BOOL
    if operator in ("&&", "||"):
        left, right = _sign(a), _sign(b)
        if operator == "&&":
            return FALSE if left is False or right is False else TRUE if left and right else BOOL
        return TRUE if left or right else FALSE if left is False and right is False else BOOL
    if operator == "&" and (a0 >= 0 or b0 >= 0):
        return Range(INT, 0, min(end for start, end in (a, b) if start >= 0))
    if a0 >= 0 and b0 >= 0:  # no bit beyond those of either
        return Range(INT, 0, (1 << max(a1.bit_length(), b1.bit_length())) - 1)
    return ANY_INT


def _sign(a: tuple[int, int]) -> bool | None:
    if a == (0, 0):
        return False
    return True if a[0] > 0 or a[1] < 0 else None


EXACT_INT = 2.0**24
"""Ints below this are flexes too, and no other int rounds to them: comparing as flex compares the ints."""


def refine(operator: str, a: Range, b: Range, *, holds: bool) -> Range | None:
    """What is left of a number where `a operator b` holds, or does not; None when that cannot be."""
    if a.kinds & ~NUMBER or b.kinds & ~NUMBER:
        return a
    if operator == "!=" or not holds:
        # NaN compares as neither less, equal nor greater; and `!=` tells whole numbers apart only.
        if operator in ("==", "!="):
            if a.kinds != INT or b.number is None or b.number != math.floor(b.number):
                return a
        elif (a.low == -INF and a.high == INF) or (b.low == -INF and b.high == INF):
            return a
    if max(abs(b.low), abs(b.high)) >= EXACT_INT:
        return a
    return _narrow(operator if holds else INVERSE[operator], a, b)


def _narrow(operator: str, a: Range, b: Range) -> Range | None:
    low, high, whole = a.low, a.high, a.kinds == INT
    if operator in ("<", "<="):
        if high >= b.high:
            high = b.high if operator == "<=" else math.ceil(b.high) - 1 if whole else _next(b.high, -INF)
    elif operator in (">", ">="):
        if low <= b.low:
            low = b.low if operator == ">=" else math.floor(b.low) + 1 if whole else _next(b.low, INF)
    elif operator == "==":
        low, high = max(low, b.low), min(high, b.high)
    elif whole and b.low == b.high:
        low, high = low + (low == b.low), high - (high == b.low)
    if whole:
        low, high = _up(low), _down(high)
    return Range(a.kinds, low, high) if low <= high else None


def _next(bound: float, towards: float) -> float:
    """The flex beside one: what is less than 3 is 2 when it is cut to an int."""
    return bound if math.isinf(bound) else float(np.nextafter(np.float32(bound), np.float32(towards)))


def _up(bound: float) -> float:
    return bound if math.isinf(bound) else math.ceil(bound)


def _down(bound: float) -> float:
    return bound if math.isinf(bound) else math.floor(bound)


INVERSE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}
MIRROR = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
