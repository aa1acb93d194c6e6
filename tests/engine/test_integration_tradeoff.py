"""The measurement behind `make bench` and the page's figures of integrators."""

from __future__ import annotations

import math

import pytest

from jktools.engine.integration import Scheme
from tests.engine.test_motion_docs import PAGE
from tools.integration_tradeoff import CASES, Point, front, march, measure

WALK, STOP, FALL = CASES


def test_the_page_states_the_errors_at_50_frames() -> None:
    page = " ".join(PAGE.split())
    error = {scheme: measure(scheme, WALK, 50).error for scheme in Scheme}
    euler, explicit = (f"{error[s]:.1e}".replace("e-0", "e-") for s in (Scheme.ENGINE, Scheme.EXPLICIT_EULER))
    verlet, rk4 = (f"{error[s]:.0e}".replace("e-0", "e-") for s in (Scheme.VELOCITY_VERLET, Scheme.RK4))
    assert f"semi-implicit Euler is off by {euler} JKU at worst, explicit Euler by {explicit}" in page
    assert f"velocity Verlet by {verlet}, RK4 by {rk4}" in page
    assert error[Scheme.EXACT] < 1e-14
    exact, engine = (f"{measure(s, STOP, 50).error:.0e}".replace("e-0", "e-") for s in (Scheme.EXACT, Scheme.ENGINE))
    assert f"is off by {exact} at 50 frames a second, hardly better than Euler's {engine}" in page


@pytest.mark.parametrize("case", [WALK, FALL], ids=lambda case: case.name)
def test_errors_fall_with_the_order(case: object) -> None:
    for scheme, order in ((Scheme.ENGINE, 1), (Scheme.VELOCITY_VERLET, 2), (Scheme.RK4, 4)):
        coarse, fine = (measure(scheme, case, rate).error for rate in (50, 100))  # type: ignore[arg-type]
        assert math.log2(coarse / fine) == pytest.approx(order, abs=0.1)


def test_a_stop_ends_where_the_threshold_says() -> None:
    """(v0 - staticdrag) / surfdrag, by hand 0.1222, to a frame's way."""
    for scheme in Scheme:
        assert march(scheme, STOP, 1000)[-1] == pytest.approx((2 / 3 - 0.3) / 3, abs=0.3 / 1000)


def test_front() -> None:
    a, b, c, d = (Point(Scheme.RK4, 1, *figures) for figures in ((1, 9), (2, 5), (2, 6), (3, 5)))
    assert front([d, c, b, a]) == [a, b]
