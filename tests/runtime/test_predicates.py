"""The runtime's predicates against rational numbers, on points chosen to be hard."""

from __future__ import annotations

import math
import os
import subprocess
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from tests.runtime.compiler import PLAIN, SANITIZED, built

Rows = npt.NDArray[np.float64]
"""(n, 6, 3): the points of tests/runtime/predicates.cpp."""
Exact = tuple[Fraction, Fraction, Fraction]

UNMET = 9


def grid(rng: np.random.Generator, n: int) -> Rows:
    """Small whole coordinates: most things coincide, and much lies in planes and on lines."""
    return rng.integers(-2, 3, (n, 6, 3)).astype(np.float64)


def flat(rng: np.random.Generator, n: int) -> Rows:
    """Points in one plane, or as near to it as rounding puts them."""
    corner, along, across = rng.uniform(-50, 50, (3, n, 1, 3))
    weights = rng.uniform(-2, 2, (2, n, 6, 1))
    return np.asarray(corner + weights[0] * along + weights[1] * across)


def nudged(rng: np.random.Generator, n: int) -> Rows:
    """The same, some coordinates moved by a last bit."""
    rows = flat(rng, n)
    return np.where(rng.random(rows.shape) < 0.2, np.nextafter(rows, rng.choice([-1e9, 1e9], rows.shape)), rows)


def singles(rng: np.random.Generator, n: int) -> Rows:
    """Vertices as files hold them, on a power-of-two grid far from the origin, and points between them."""
    rows = (rng.integers(-8, 9, (n, 6, 3)) / 8 + 2.0**19).astype(np.float32).astype(np.float64)
    rows[:, 3] = rows[:, 0] + (rows[:, 1] - rows[:, 0]) / 3
    return rows


def touching(rng: np.random.Generator, n: int) -> Rows:
    """Ways through the edge that both triangles share, or its end, beyond it; and straight down through them."""
    rows = rng.integers(-40, 41, (n, 6, 3)) / 8
    met = np.where(rng.random((n, 1)) < 0.5, rows[:, 0], (rows[:, 0] + rows[:, 2]) / 2)
    rows[:, 4] = 2 * met - rows[:, 3]
    rows[::2, 3, :2] = met[::2, :2]
    return rows


def low(rng: np.random.Generator, n: int) -> Rows:
    """Triangles that face up, nearly flat, and points above them: depths that hang on the last bit."""
    rows = np.empty((n, 6, 3))
    rows[:, :, :2] = rng.integers(-4, 5, (n, 6, 2)) * rng.choice([1.0, 1 / 3, 0.1], (n, 1, 1))
    rows[:, :, 2] = rng.choice([1.0, 1 / 3], (n, 1)) + rng.integers(-1, 2, (n, 6)) * 2.0 ** rng.integers(-60, 1, (n, 1))
    weights = rng.dirichlet(np.ones(3), n)
    within = rng.random(n) < 0.7
    rows[within, 3, :2] = (weights[:, :, None] * rows[:, :3, :2]).sum(axis=1)[within]
    rows[:, 3, 2] += rng.choice([0.0, 1.0, 1 / 3, 2.0**40], n)
    rows[:, 4] = rows[:, 3] - [0, 0, 1]
    return rows


def extreme(rng: np.random.Generator, n: int) -> Rows:
    """From the least double to 2^149."""
    rows = rng.choice([-1.0, 0.0, 1.0, 1.5], (n, 6, 3)) * 2.0 ** rng.choice([-1074, -700, -160, -30, 0, 149], (n, 6, 3))
    return np.where(rng.random((n, 1, 1)) < 0.5, rows, np.roll(rows, 1, axis=1) * 0.75)


def tiny(rng: np.random.Generator, n: int) -> Rows:
    """Whole scenes among the subnormal doubles."""
    return grid(rng, n) * 5e-324


def minus(p: Exact, q: Exact) -> Exact:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def cross(p: Exact, q: Exact) -> Exact:
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


def dot(p: Exact, q: Exact) -> Fraction:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def sign(x: Fraction) -> int:
    return (x > 0) - (x < 0)


def at(normal: Exact, corner: Exact, start: Exact, along: Exact) -> Fraction | None:
    """Where a way from `start` falls through a plane that it starts on or above, or None."""
    above, fall = dot(normal, minus(start, corner)), -dot(normal, along)
    return above / fall if above >= 0 and fall > 0 else None


def order(first: Fraction | None, second: Fraction | None) -> int:
    return UNMET if first is None or second is None else sign(first - second)


def rational(row: Rows) -> list[float]:
    """What predicates.cpp writes for a row."""
    p: list[Exact] = [(Fraction(x), Fraction(y), Fraction(z)) for x, y, z in row.tolist()]
    normal, second = (cross(minus(p[i], p[0]), minus(p[k], p[0])) for i, k in ((1, 2), (2, 5)))
    side = sign(dot(normal, minus(p[3], p[0])))
    ahead, down = minus(p[4], p[3]), (Fraction(0), Fraction(0), Fraction(-1))
    ends = [dot(n, minus(p[4], p[0])) < 0 for n in (normal, second)]
    way = [at(n, p[0], p[3], ahead) if behind else None for n, behind in zip((normal, second), ends, strict=True)]
    fall = [at(n, p[0], p[3], down) for n in (normal, second)]
    within = all(sign(cross(minus(p[k], p[i]), minus(p[3], p[i]))[2]) >= 0 for i, k in ((0, 1), (1, 2), (2, 0)))
    deep = float(UNMET) if fall[0] is None or not within else float(fall[0])
    return [side, sign(normal[2]), normal == (0, 0, 0), order(*way), order(*fall), side, deep]


KINDS = [grid, flat, nudged, singles, touching, low, extreme, tiny]
BUILDS = {"plain": PLAIN}
if os.environ.get("JKTOOLS_FUZZ"):
    BUILDS |= {"contracted": ("-O3", "-march=native", "-ffp-contract=fast"), "sanitized": SANITIZED}
ROWS = 4000 if os.environ.get("JKTOOLS_FUZZ") else 400


@pytest.mark.parametrize("options", BUILDS)
@pytest.mark.parametrize("kind", KINDS)
def test_signs_and_depths_are_those_of_rational_numbers(
    kind: Callable[[np.random.Generator, int], Rows], options: str, programs: Path
) -> None:
    program = built("tests/runtime/predicates.cpp", programs / f"predicates_{options}", BUILDS[options])
    rows = kind(np.random.default_rng(6), ROWS)
    done = subprocess.run([program], input=rows.tobytes(), capture_output=True, check=True)
    found = np.frombuffer(done.stdout, np.float64).reshape(-1, 7)
    wanted = np.array([rational(row) for row in rows])
    assert np.array_equal(found, wanted), np.flatnonzero((found != wanted).any(axis=1))


def test_the_points_are_hard() -> None:
    """Each kind has what plain doubles get wrong or cannot tell: zeros, equal ways, signs lost in rounding."""
    rng = np.random.default_rng(6)
    wanted = {kind.__name__: np.array([rational(row) for row in kind(rng, 400)]) for kind in KINDS}
    zeros = {name: int((rows[:, 0] == 0).sum()) for name, rows in wanted.items()}
    assert min(zeros[name] for name in ("grid", "singles", "extreme", "tiny")) > 5, zeros
    assert int((wanted["touching"][:, 3] == 0).sum()) > 20
    assert min(int((wanted[name][:, 4] == 0).sum()) for name in ("touching", "low")) > 5
    rows = flat(np.random.default_rng(6), 400)
    plain = np.linalg.det(rows[:, :3] - rows[:, 3:4])
    exact = [sign(-Fraction(rational(row)[0])) for row in rows]
    assert (np.sign(plain) != exact).any()
    depths = wanted["low"][:, 6]
    assert len({math.frexp(d)[0] for d in depths}) > 50
