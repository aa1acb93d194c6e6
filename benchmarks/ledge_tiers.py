"""The tiers of ledges beside each other, over the corpus: `python -m benchmarks.ledge_tiers [--edges N]`.

For each level: seconds of `fast`, `balanced` and `exact`, the rows of the two analytic tiers, and the length of all
floor edges on which a tier says something else than `exact`: in all, and in pieces longer than the way looked at beyond
the edge. The exit status is 1 if `balanced` differs in such a piece.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from collections.abc import Iterator

import numpy as np

from benchmarks.ledge_disagreement import GAIT
from benchmarks.sight_queries import levels
from jktools.facts.floors import Floors
from jktools.facts.ledges import SAMPLES
from jktools.geometry.ledges import BEYOND, Beyond, EdgeWalker

SAME_DROP = 1e-9


def differing(edges: EdgeWalker, found: Beyond, exact: Beyond) -> Iterator[float]:
    """The lengths, JKU, of the pieces of edges on which two answers differ."""
    length = np.linalg.norm((edges.there - edges.here)[:, :2], axis=1)
    first = [np.searchsorted(each.edge, np.arange(len(length) + 1)) for each in (found, exact)]
    for edge in np.unique(exact.edge).tolist():
        rows = [slice(int(f[edge]), int(f[edge + 1])) for f in first]
        cuts = np.unique(np.concatenate([found.end[rows[0]], exact.end[rows[1]], [0.0]]))
        for start, end in itertools.pairwise(cuts):
            middle = (start + end) / 2
            a, b = (
                _at(each, row.start + int(np.searchsorted(each.end[row], middle)), middle)
                for each, row in zip((found, exact), rows, strict=True)
            )
            if a[0] != b[0] or abs(a[1] - b[1]) > SAME_DROP:
                yield float((end - start) * length[edge])


def _at(found: Beyond, row: int, t: float) -> tuple[tuple[int, ...], float]:
    part = (t - found.start[row]) / (found.end[row] - found.start[row])
    drop = float(found.drop_start[row] * (1 - part) + found.drop_end[row] * part)
    return (int(found.over[row]), int(found.met[row]), int(found.face[row]), int(found.rise[row])), 0.0 if np.isnan(
        drop
    ) else drop


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
