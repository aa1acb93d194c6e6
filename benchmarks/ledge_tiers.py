"""The tiers of ledges beside each other, over the corpus: `python -m benchmarks.ledge_tiers [--edges N]`.

For each level: seconds of `fast`, `balanced` and `exact`, the rows of the two analytic tiers, and the length of all
floor edges on which a tier says something else than `exact`: in all, and in pieces longer than the way looked at beyond
the edge. The exit status is 1 if `balanced` differs in such a piece.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator

import numpy as np

from benchmarks.ledge_disagreement import GAIT
from benchmarks.sight_queries import levels
from jktools.facts.floors import Floors
from jktools.facts.ledges import SAMPLES
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker, Over
from jktools.tradeoff.overlay import Intervals, overlay

SAME_DROP = 1e-9


def differing(edges: EdgeWalker, found: Beyond, exact: Beyond) -> Iterator[float]:
    """The lengths, JKU, of the pieces of edges on which two answers differ."""
    length = np.linalg.norm((edges.there - edges.here)[:, :2], axis=1)
    pieces = overlay(*(Intervals(each.edge, each.start, each.end) for each in (found, exact)))
    one, other = (_at(each, rows, pieces.middle) for each, rows in ((found, pieces.one), (exact, pieces.other)))
    differs = np.any([a != b for a, b in zip(one[:-1], other[:-1], strict=True)], axis=0)
    # Which of two blocks first, a thing or a wall, is not analysed.
    differs &= ~((one[0] == Over.BLOCKED) & (other[0] == Over.BLOCKED) & (np.maximum(one[2], other[2]) >= 0))
    differs |= np.abs(one[-1] - other[-1]) > SAME_DROP
    yield from ((pieces.end - pieces.start) * length[pieces.edge])[differs].tolist()


def _at(found: Beyond, row: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, ...]:
    """What is met at places of edges, and how deep."""
    part = (place - found.start[row]) / (found.end[row] - found.start[row])
    drop = found.drop_start[row] * (1 - part) + found.drop_end[row] * part
    return found.over[row], found.met[row], found.face[row], found.rise[row], np.nan_to_num(drop, nan=0.0)


def main() -> int:
    """Compare and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--edges", type=int, default=10**9, help="leave out levels with more floor edges")
    arguments = parser.parse_args()
    failed = False
    for name, level in levels():
        floors = Floors.of(level)
        edges = EdgeWalker(level, floors.solids())
        placed = next(iter(floors.scenes())).present
        rows = edges.edges_of(placed)
        if len(rows) > arguments.edges:
            continue
        seconds, found = [], []
        for tier in ({"samples": SAMPLES}, {}, {"exact": True}):
            began = time.perf_counter()
            found.append(edges.beyond(GAIT, edges=rows, present=placed, **tier))  # type: ignore[arg-type]
            seconds.append(time.perf_counter() - began)
        wrong = [list(differing(edges, each, found[2])) for each in found[:2]]
        long = [sum(piece for piece in each if piece > BEYOND) for each in wrong]
        failed |= long[1] > 0
        here, there = edges.ends(rows)
        whole = float(np.linalg.norm(there - here, axis=1).sum())
        print(
            f"{name:40} {whole:9.1f} JKU of edges; s {seconds[0]:.3f} {seconds[1]:.3f} {seconds[2]:.2f}; rows "
            f"{len(found[1].edge)} {len(found[2].edge)}; differ: fast {sum(wrong[0]):.3f} JKU, "
            f"balanced {sum(wrong[1]):.5f} JKU ({long[1]:.5f} in longer pieces)",
            flush=True,
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
