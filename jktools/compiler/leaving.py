"""Where a straight way leaves a polygon, seen from above. Exact: about the doubles as they are given."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

Point = Sequence[float]
"""x y, and what follows does not count."""

GREATEST = 2.0**150
"""JKU: the queries answer about coordinates below."""
_BOUND = 6 * 2.0**-53
_UNDERFLOW = 2.0**-900


class Exit(NamedTuple):
    """How a way leaves a polygon."""

    starts_inside: bool
    """Or on an edge; of a way that starts elsewhere nothing is said."""
    corner: int
    """Of the edge that it crosses first: from this corner to the next one; -1 where it stays."""
    place: float
    """How far along that edge, 0 .. 1: the nearest double."""
    along: float
    """How far along the way."""


def orient(a: Point, b: Point, p: Point) -> int:
    """1 where a point lies to the left of the way from a to b, -1 to the right, 0 on its line."""
    left, right = (a[0] - p[0]) * (b[1] - p[1]), (a[1] - p[1]) * (b[0] - p[0])
    error = _BOUND * (abs(left) + abs(right)) + _UNDERFLOW
    if abs(left - right) > error:
        return 1 if left > right else -1
    # Each product has a factor that is 0: the usual doubt in levels, which are built on a grid.
    if (a[0] == p[0] or b[1] == p[1]) and (a[1] == p[1] or b[0] == p[0]):
        return 0
    area = _area(*_whole(a, b, p))
    return (area > 0) - (area < 0)


def leaving(corners: Sequence[Point], origin: Point, target: Point) -> Exit:
    """Find the edge by which a way leaves a polygon, its corners counter-clockwise seen from above.

    An edge is crossed where the way starts on its left or on it, ends strictly on its right, and passes between its
    ends or through one. Where it leaves by a corner, the first of both edges counts.
    """
    inside, turns = False, 0
    found: tuple[Fraction, int] | None = None
    for i, a in enumerate(corners):
        b = corners[(i + 1) % len(corners)]
        side = orient(a, b, origin)
        inside = inside or (side == 0 and _between(a, b, origin))
        turns += (side > 0 and a[1] <= origin[1] < b[1]) - (side < 0 and b[1] <= origin[1] < a[1])
        if side < 0 or orient(a, b, target) >= 0:
            continue
        if orient(origin, target, a) > 0 or orient(origin, target, b) < 0:
            continue
        met = (_part(a, b, origin, target), i)
        found = met if found is None else min(found, met)
    if not inside and turns <= 0:
        return Exit(False, -1, 0.0, 1.0)
    if found is None:
        return Exit(True, -1, 0.0, 1.0)
    along, corner = found
    a, b = corners[corner], corners[(corner + 1) % len(corners)]
    return Exit(True, corner, float(_part(target, origin, a, b)), float(along))


def _whole(*points: Point) -> list[tuple[int, int]]:
    """Points in whole numbers of one small part of a JKU: doubles are whole numbers by powers of two."""
    ratios = [(float(p[0]).as_integer_ratio(), float(p[1]).as_integer_ratio()) for p in points]
    parts = max(part for ratio in ratios for _, part in ratio)
    return [(x * (parts // own_x), y * (parts // own_y)) for (x, own_x), (y, own_y) in ratios]


def _area(a: tuple[int, int], b: tuple[int, int], p: tuple[int, int]) -> int:
    """Twice that of a triangle, positive where it turns counter-clockwise."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def _part(a: Point, b: Point, p: Point, q: Point) -> Fraction:
    """Which part of the way from p to q lies on the left of the line from a to b."""
    start, end, here, there = _whole(a, b, p, q)
    first = _area(start, end, here)
    return Fraction(first, first - _area(start, end, there))


def _between(a: Point, b: Point, p: Point) -> bool:
    return all(min(a[k], b[k]) <= p[k] <= max(a[k], b[k]) for k in (0, 1))
