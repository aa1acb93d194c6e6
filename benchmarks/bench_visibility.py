"""Visibility of real levels: seconds at each tier, how tight it is, and how the time grows with the portals.

`python -m benchmarks.bench_visibility`; `--exact` adds the exact tier, which takes minutes. Processor time on one
thread, the median of three runs for all but the exact tier. For scale: on azulcity (289 sectors, 525 adjoins that can
be seen through), ericw-tools' vis takes 0.018 s for its base and 0.10 s for its full pass, from 100 to 31.9 visible
sectors a sector, measured once on another machine; it is not run here.
"""

from __future__ import annotations

import argparse
import statistics
import time
from typing import NamedTuple

import numpy as np

from benchmarks.sight_queries import CORPUS, levels
from benchmarks.visibility_missed import sample
from jktools.geometry import Accuracy, SectorMesh, VisibleSectors

RUNS = 3
SEGMENTS = 20
"""A pair of sectors, for the share of visible pairs that a segment was found for."""


class Row(NamedTuple):
    """What was measured of one level."""

    portals: int
    seconds: float


def timed(mesh: SectorMesh, accuracy: Accuracy, runs: int, threads: int = 1) -> tuple[float, VisibleSectors]:
    """The median processor time of some runs, in seconds, and the answer."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        found = mesh.visible_sectors(accuracy, threads)
        times.append(time.process_time() - start)
    return statistics.median(times), found


def main() -> None:
    """Print everything, or say that there are no levels to measure."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--exact", action="store_true", help="the exact tier too")
    arguments.add_argument("--level", default="", help="levels whose name holds this")
    options = arguments.parse_args()
    if not CORPUS.exists():
        print(f"no levels at {CORPUS}: nothing measured")
        return
    tiers: list[Accuracy] = ["fast", "balanced", *(["exact"] if options.exact else [])]  # type: ignore[list-item]
    heads = "  ".join(f"{tier + ' s':>10} {'visible':>8}" for tier in tiers)
    print(f"{'level':<36} {'sectors':>7} {'portals':>7}  {heads}  {'seen':>6} {'cut short':>9}")
    rows = []
    for name, level in levels():
        if options.level not in name:
            continue
        mesh = SectorMesh.from_level(level)
        results = [timed(mesh, tier, 1 if tier == "exact" else RUNS) for tier in tiers]
        balanced = results[1][1]
        seen = sample(level, balanced.matrix, SEGMENTS, np.random.default_rng(1997)).seen
        cells = "  ".join(f"{seconds:10.4f} {found.matrix.sum(axis=1).mean():8.2f}" for seconds, found in results)
        print(
            f"{name[-36:]:<36} {len(level.sectors):7} {balanced.portals:7}  {cells}"
            f"  {seen.sum() / balanced.matrix.sum():6.1%} {balanced.cut_short:9}",
            flush=True,
        )
        rows.append(Row(balanced.portals, results[1][0]))
    large = [row for row in rows if row.portals >= 100]
    if len(large) > 2:
        power, _ = np.polyfit(np.log([row.portals for row in large]), np.log([row.seconds for row in large]), 1)
        print(f"balanced grows with the portals to the power {power:.2f} ({len(large)} levels of 100 portals and more)")


if __name__ == "__main__":
    main()
