"""What each rule costs on the seven levels of masspack.gob, reading apart.

Facts are worked out by the first rule that asks for them, so that the order of the rules decides who pays; medians of
5 runs, each from nothing.
"""

from __future__ import annotations

import statistics
import time
from pathlib import Path

import pytest

from jktools.facts import LevelFacts
from jktools.linter import lint, rules
from jktools.model import Level
from jktools.session import Settings
from jktools.session.levels import discover, read_level

PACK = Path(__file__).resolve().parents[2] / "shared/corpus/gob/masspack.gob"
RUNS = 5
SHOWN = 12


def test_rules() -> None:
    if not PACK.exists():
        pytest.skip("the corpus of real mods is not at hand")
    started = time.perf_counter()
    documents = [read_level(member, Settings()).document for member in discover(str(PACK))]
    reading = time.perf_counter() - started
    times: dict[str, list[float]] = {rule.code.id: [] for rule in rules()}
    for _ in range(RUNS):
        for taken in times.values():
            taken.append(0.0)
        for document in documents:
            level = Level(document)
            facts = LevelFacts(level)
            for rule in (r for r in rules() if Level in r.looks_at):
                started = time.perf_counter()
                lint(level, [rule], facts)
                times[rule.code.id][-1] += time.perf_counter() - started
    medians = {code: statistics.median(taken) for code, taken in times.items()}
    print(f"\nreading {len(documents)} levels {reading:.2f} s, all {len(medians)} rules {sum(medians.values()):.3f} s")
    for code, median in sorted(medians.items(), key=lambda item: -item[1])[:SHOWN]:
        print(f"{code}{1000 * median:>9.1f} ms")
