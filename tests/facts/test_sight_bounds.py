"""What is said of the calls of random levels against a small game that runs them.

`make fuzz` runs 2,000 levels. Each outside message comes once at most to a handler, and once for each thing to a class
COG: that is what the bounds count.
"""

from __future__ import annotations

import os
from collections import Counter

import pytest

from jktools.facts import LevelFacts
from tests.support.cog_levels import LevelWriter
from tests.support.cog_world import told
from tests.support.levels import level_with_files

LEVELS = 2000 if os.environ.get("JKTOOLS_FUZZ") else 200
SECONDS = 10.0


@pytest.fixture(scope="module")
def simulated() -> tuple[list[str], Counter[str]]:
    faults: list[str] = []
    seen: Counter[str] = Counter()
    for seed in range(LEVELS):
        with level_with_files(*LevelWriter(seed).fragment()) as level:
            found, counted = told(tuple(LevelFacts(level).running), seed, SECONDS)
        faults += [f"level {seed}: {fault}" for fault in found]
        seen += counted
    return faults, seen


def test_no_script_calls_or_runs_more_often_than_is_said(simulated: tuple[list[str], Counter[str]]) -> None:
    assert simulated[0] == []


def test_the_levels_look_often_enough_and_the_bounds_are_near(simulated: tuple[list[str], Counter[str]]) -> None:
    """Or the test above proves nothing: most levels run, most looks are bounded, and many come near their bound."""
    seen = simulated[1]
    assert seen["hung"] < LEVELS / 4
    assert seen["looks that last"] > 4 * LEVELS
    assert seen["looks without a bound"] < seen["looks"] / 3
    assert seen["looks that are met"] > seen["looks"] / 5
