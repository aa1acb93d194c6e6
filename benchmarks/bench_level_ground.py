"""A walk in real levels: what a tick costs, against the same keys on one level floor given by numbers."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

import pytest

from jktools.engine.profile import Engine
from jktools.engine.simulation import History
from jktools.trace import trace
from jktools.trace.in_level import start_at, trace_in_level
from tests.support.levels import CORPUS, corpus_files, level_of

KEYS = "0 run forward\n2 run left\n3 jump\n4 run forward right\n6 run back\n7 jump\n8 run right\n10 end\n"
LEVELS = ("lagoon.jkl", "azulcity.jkl", "desolation.jkl", "hell.jkl", "supremekaiplanet4.jkl")


def microseconds_a_tick(walk: Callable[[], History]) -> float:
    started = time.perf_counter()
    ticks = len(walk().time) - 1
    return (time.perf_counter() - started) / ticks * 1e6


def test_a_walk_in_levels() -> None:
    if not CORPUS.exists():
        pytest.skip("the corpus of real mods is not at hand")
    print(f"\n{'us a tick':<28}" + "".join(f"{engine.value:>12}" for engine in Engine))
    costs = [microseconds_a_tick(partial(trace, KEYS, engine=engine)) for engine in Engine]
    print(f"{'one floor, by numbers':<28}" + "".join(f"{cost:>12.0f}" for cost in costs))
    for path, data in corpus_files():
        if path.rpartition("/")[2] not in LEVELS:
            continue
        level = level_of(data, path)
        player = next(thing for thing in level.things if thing.template_name.lower() == "walkplayer")
        start = start_at(level, str(player.number))
        walks = [partial(trace_in_level, KEYS, level, start, engine=engine) for engine in Engine]
        costs = [microseconds_a_tick(walk) for walk in walks]
        print(f"{path.rpartition('/')[2]:<28}" + "".join(f"{cost:>12.0f}" for cost in costs))
