"""Ledges and basins of the player over the corpus: `python -m benchmarks.bench_ledges`.

For each level: floor edges, intervals, seconds, and the share of the edges' length of each kind; `unknown` is what
things that can be stood on leave open. Levels whose player's hover height is not known are named.
"""

from __future__ import annotations

import time

import numpy as np

from benchmarks.ledge_disagreement import GAIT
from benchmarks.sight_queries import levels
from jktools._native_geometry import Strides  # noqa: TID251 (floors without a level)
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind

SHOWN = (Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.LIP, Kind.JUMP, Kind.WALL, Kind.FALL, Kind.WATER, Kind.NONE, Kind.UNKNOWN)  # noqa: E501  # fmt: skip


def one_sector(steps: int) -> tuple[int, float]:
    """Floors of one sector, stairs without risers: how many there are, and the seconds that their edges take."""
    rows = np.arange(steps)
    low, high = rows * 0.3, (rows + 1) * 0.3
    zero, wide, height = np.zeros(steps), np.full(steps, 8.0), rows * -0.1
    corners = [(zero, low), (wide, low), (wide, high), (zero, high)]
    positions = np.stack([np.stack([x, y, height], axis=1) for x, y in corners], axis=1).ravel()
    start, each = np.arange(0, 4 * steps + 1, 4, dtype=np.int32), np.arange(4 * steps, dtype=np.int32)
    none = np.zeros(0, np.int32)
    strides = Strides(
        positions, start, each, np.full(steps, -1, np.int32), np.zeros(1, np.uint8), np.zeros(1, np.int32),
        np.array([steps], np.int32), np.zeros(0), np.zeros(1, np.int32), none, none, np.zeros(0, np.uint8),
    )  # fmt: skip
    surface, corner = np.repeat(np.arange(steps, dtype=np.int32), 4), np.tile(np.arange(4, dtype=np.int32), steps)
    began = time.perf_counter()
    strides.ledges(surface, np.full(4 * steps, -1, np.int32), corner, np.zeros(0, np.uint8), *GAIT, 0, 1)
    return steps, time.perf_counter() - began


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
    for steps, seconds in map(one_sector, (100, 400, 1600, 6400)):
        print(f"{steps} floors in one sector: {seconds:.3f} s, {1e6 * seconds / steps:.0f} us a floor")


if __name__ == "__main__":
    main()
