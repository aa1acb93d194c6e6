"""Whether asking the visible sectors first changes an answer: `python -m benchmarks.sees_disagreement`.

Over every level of the corpus, `sees` with `visible_sectors` must equal `sees` without, and that must equal the
complete search, way and all, in a sample of the queries. The exit status is 1 where one does not.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np

from benchmarks.sight_queries import SETS, Queries, levels, through_edges
from jktools.geometry import SectorMesh

KINDS = {**SETS, "edges": through_edges}
SEARCHED = 100
"""Queries of each kind and level that the complete search answers too."""


def searched(mesh: SectorMesh, queries: Queries, aims: np.ndarray) -> np.ndarray:
    """The answers to the first queries by the complete search."""
    out = []
    for origin, sector, target, aim in zip(*(column[:SEARCHED] for column in (*queries, aims)), strict=True):
        way = mesh.explain(int(sector), origin, target)
        out.append(way.visible and any(step.sector == aim for step in way.steps))
    return np.array(out)


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--queries", type=int, default=1_000_000, help="over all levels, shared out evenly")
    arguments.add_argument("--seed", type=int, default=1997)
    options = arguments.parse_args()
    corpus = list(levels())
    each = -(-options.queries // (len(corpus) * len(KINDS)))
    rng = np.random.default_rng(options.seed)
    wrong = unlike = unseen = count = 0
    for name, level in corpus:
        mesh = SectorMesh.from_level(level)
        visible = mesh.visible_sectors()
        for kind, make in KINDS.items():
            queries = make(level, each, rng)
            aims = mesh.locate(queries.targets)
            walked, asked = (mesh.sees(*queries, aims, first) for first in (None, visible))
            bad = int((walked != asked).sum()) + int((searched(mesh, queries, aims) != walked[:SEARCHED]).sum())
            if bad:
                print(f"{name} {kind}: {bad} answers differ")
            wrong, count = wrong + bad, count + each
            unlike += int((mesh.sight(*queries).visible & ~walked & (aims >= 0)).sum())
            unseen += int((aims < 0).sum())
    print(f"{count:,} queries over {len(corpus)} levels: {wrong} answers differ")
    print(f"{unlike} targets are visible, but not on a way through the sector that they lie in; {unseen} lie in none")
    sys.exit(int(wrong > 0))


if __name__ == "__main__":
    main()
