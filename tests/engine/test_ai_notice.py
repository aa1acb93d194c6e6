"""Whether an AI notices a target that it could see."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jktools.engine.ai_notice import Notice, chance

# Worked out by hand from the rules: the conditions, the chance.
CASES = [
    ({"distance": 1.999, "alert": False, "ambient": 0.0, "crouching": True, "still": True}, 1.0),
    ({"distance": 2.0}, 1.0),
    ({"distance": 4.0}, 0.8),
    ({"distance": 8.0}, 0.4),
    ({"distance": 99.0}, 0.4),
    ({"distance": 99.0, "shining": True, "ambient": 0.0, "crouching": True, "still": True}, 1.0),
    ({"distance": 4.0, "alert": False}, 0.4),
    ({"distance": 4.0, "shining": True, "alert": False}, 0.5),
    ({"distance": 4.0, "ambient": 0.5}, 0.8),
    ({"distance": 4.0, "ambient": 0.49}, 0.552),
    ({"distance": 4.0, "ambient": 0.3}, 0.4),
    ({"distance": 4.0, "ambient": 0.3, "sees_in_dark": True}, 0.8),
    ({"distance": 4.0, "crouching": True}, 0.6),
    ({"distance": 4.0, "still": True}, 0.4),
    ({"distance": 8.0, "still": True, "crouching": True}, 0.15),
    ({"distance": 8.0, "still": True, "crouching": True, "alert": False, "ambient": 0.0}, 0.05),
    ({"distance": 1.0, "invisible": True}, 0.05),
    ({"distance": 1.0, "blind": True}, 0.05),
]


@pytest.mark.parametrize(("named", "expected"), CASES)
def test_chance(named: dict, expected: float) -> None:
    assert float(chance(Notice(**named))) == pytest.approx(expected, abs=1e-12)


def test_many_at_once() -> None:
    """Each pair by itself, the rest shared."""
    together = chance(Notice(distance=[1.0, 4.0, 8.0], ambient=0.3, still=[False, False, True]))
    assert together.tolist() == pytest.approx([1.0, 0.4, 0.1])


wild = st.one_of(st.sampled_from([0.0, -1.0, 1e30, -1e30, float("nan"), 5e-324]), st.floats(-1e30, 1e30))


@given(wild, wild, st.booleans(), st.booleans())
def test_a_chance_is_a_chance(distance: float, ambient: float, alert: bool, still: bool) -> None:
    with np.errstate(all="raise"):
        got = chance(Notice(distance=distance, ambient=ambient, alert=alert, still=still))
    assert 0.05 <= got <= 1.0
