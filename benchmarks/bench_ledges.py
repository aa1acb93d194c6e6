"""Ledges and basins of the player over the corpus: `python -m benchmarks.bench_ledges`.

For each level: floor edges, intervals, seconds, and the share of the edges' length of each kind; `unknown` is what
things that can be stood on leave open. Levels whose player's hover height is not known are named.
"""

from __future__ import annotations

import time

import numpy as np

from benchmarks.sight_queries import levels
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind

SHOWN = (Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.LIP, Kind.JUMP, Kind.WALL, Kind.FALL, Kind.WATER, Kind.NONE, Kind.UNKNOWN)  # noqa: E501  # fmt: skip


def main() -> None:
    """Measure and print."""
    total, unknown, seconds = 0.0, 0.0, 0.0
    print(f"{'':32}{'edges':>6}{'rows':>7}{'s':>7}{'basins':>7}" + "".join(f"{k.name.lower():>9}" for k in SHOWN))
    for name, level in levels():
        facts = LevelFacts(level)
        players = [body for body in facts.bodies if body.body.player]
        if not any(body.hovers for body in players):
            print(f"{name[-31:]:32}no player whose hover height is known")
            continue
        _ = facts.edges, facts.floors, facts.touched
        began = time.perf_counter()
        (found, *_more) = facts.player_ledges
        basins = facts.basins(found.walker)
        took = time.perf_counter() - began
        length = np.bincount(found.kind, weights=found.length, minlength=len(Kind))
        whole = max(float(length.sum()), 1e-9)
        total, unknown, seconds = total + whole, unknown + float(length[Kind.UNKNOWN]), seconds + took
        print(
            f"{name[-31:]:32}{len(facts.edges.surface):6}{len(found):7}{took:7.3f}{len(basins):7}"
            + "".join(f"{100 * length[kind] / whole:8.1f}%" for kind in SHOWN)
        )
    print(f"all: {seconds:.2f} s, {100 * unknown / total:.2f} % of {total:.0f} JKU of floor edges unknown")


if __name__ == "__main__":
    main()
