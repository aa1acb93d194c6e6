"""How often the tiers of drop disagree, over every level of the corpus: `python -m benchmarks.drop_disagreement`.

`balanced` must equal `exact` in every answer, the distance to the last bit, and the exit status is 1 if it does not.
`fast` is counted.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np

from benchmarks.sight_queries import levels, points, things, through_edges
from jktools.geometry import Ending, SectorMesh
from jktools.tradeoff.errors import unlike_rows, wrong_drop
from jktools.tradeoff.passes import LIMITS

KINDS = {"things": things, "random": points, "edges": through_edges}


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
    totals = {kind: np.zeros(4, np.int64) for kind in KINDS}
    start = time.perf_counter()
    for name, level in corpus:
        mesh = SectorMesh.from_level(level)
        for kind, make in KINDS.items():
            queries = make(level, each, rng)
            limits = np.resize(LIMITS, each)
            exact, balanced, fast = (
                mesh.drop(queries.origins, queries.sectors, limits, tier, options.threads)
                for tier in ("exact", "balanced", "fast")
            )
            wrong = int(wrong_drop(fast, exact).sum())
            row = (each, int(unlike_rows(balanced, exact).sum()), wrong, int((exact.ending == Ending.FLOOR).sum()))
            totals[kind] += row
            if row[1]:
                print(f"{name} {kind}: balanced differs from exact in {row[1]} of {each}")
    print(f"{'falls':<8} {'number':>9} {'balanced wrong':>14} {'fast wrong':>10} {'to a floor':>10}")
    for kind, (count, balanced_wrong, fast_wrong, floors) in [*totals.items(), ("all", sum(totals.values()))]:
        print(f"{kind:<8} {count:9,} {balanced_wrong:14} {fast_wrong / count:10.3%} {floors / count:10.1%}")
    print(f"{len(corpus)} levels, {time.perf_counter() - start:.0f} s")
    sys.exit(int(sum(totals.values())[1] > 0))


if __name__ == "__main__":
    main()
