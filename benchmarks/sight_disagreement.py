"""How often the tiers of sight disagree, over every level of the corpus: `python -m benchmarks.sight_disagreement`.

`balanced` must equal `exact` in every answer, and the exit status is 1 if it does not. `fast` is counted.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np

from benchmarks.sight_queries import levels
from jktools.geometry.mesh import SectorMesh
from jktools.tradeoff.errors import unlike_rows, wrong_sight
from jktools.tradeoff.passes import KINDS


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--queries", type=int, default=1_000_000, help="over all levels, shared out evenly")
    arguments.add_argument("--threads", type=int, default=0)
    arguments.add_argument("--seed", type=int, default=1997)
    options = arguments.parse_args()
    corpus = list(levels())
    each = -(-options.queries // (len(corpus) * len(KINDS)))
    rng = np.random.default_rng(options.seed)
    totals: dict[str, np.ndarray] = {kind: np.zeros(5, np.int64) for kind in KINDS}
    start = time.perf_counter()
    for name, level in corpus:
        mesh = SectorMesh.from_level(level)
        for kind, make in KINDS.items():
            queries = make(level, each, rng)
            exact, balanced, fast = (
                mesh.sight(*queries, accuracy=tier, threads=options.threads) for tier in ("exact", "balanced", "fast")
            )
            doubts = sum(mesh.doubts(*queries))
            wrong = int(wrong_sight(fast, exact).sum())
            row = (each, int(unlike_rows(balanced, exact).sum()), wrong, int(exact.visible.sum()), doubts)
            totals[kind] += row
            if row[1]:
                print(f"{name} {kind}: balanced differs from exact in {row[1]} of {each}")
    print(f"{'queries':<8} {'number':>9} {'balanced wrong':>14} {'fast wrong':>10} {'visible':>8} {'in doubt':>8}")
    for kind, (count, balanced_wrong, fast_wrong, visible, doubts) in [
        *totals.items(),
        ("all", sum(totals.values())),
    ]:
        print(
            f"{kind:<8} {count:9,} {balanced_wrong:14} {fast_wrong / count:10.3%} {visible / count:8.1%} "
            f"{doubts / count:8.2%}"
        )
    print(f"{len(corpus)} levels, {time.perf_counter() - start:.0f} s")
    sys.exit(int(sum(totals.values())[1] > 0))


if __name__ == "__main__":
    main()
