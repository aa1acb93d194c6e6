"""Figures in messages: two that a rule tells from each other read differently."""

from __future__ import annotations

MOST_DIGITS = 17
"""With so many, no two different doubles read the same."""


def told_apart(one: float, other: float, digits: int = 6) -> tuple[str, str]:
    """Write two figures with so many significant digits, or with as many more as tell them apart."""
    for count in range(digits, MOST_DIGITS + 1):
        first, second = f"{one:.{count}g}", f"{other:.{count}g}"
        if first != second:
            return first, second
    return f"{one:.{digits}g}", f"{other:.{digits}g}"
