"""What the C++ runtime costs over the corpus: `python -m benchmarks.bench_runtime`.

For each level: opening a compiled file, checking it and answering one query, in a fresh process (with the file's pages
dropped from the page cache, and with them there) and again and again in one; making a locator; then sight, a thread
each, against Python's native batch, by seconds of processor. Medians over the levels, and the worst.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from benchmarks.runtime_queries import ask, sight_of
from benchmarks.sight_queries import SETS, levels, through_edges
from jktools.compiler import CompiledLevel, compile_level
from tests.runtime.compiler import built

TRIES = 9
"""Fresh processes a level."""

TIMES = re.compile(
    r"first (\S+) ms to open, (\S+) ms to the first answer; median of \d+ (\S+) ms and (\S+) ms; "
    r"(\S+) ms for a locator of (\d+) sectors, (\d+) surfaces"
)


def times(program: Path, path: Path, *, cold: bool) -> tuple[float, ...]:
    """Milliseconds of one process: opened and answered at first, their medians, and a locator's; sectors, surfaces."""
    if cold:
        handle = os.open(path, os.O_RDONLY)
        os.fdatasync(handle)
        os.posix_fadvise(handle, 0, 0, os.POSIX_FADV_DONTNEED)
        os.close(handle)
    done = subprocess.run([program, path, "--time"], capture_output=True, text=True, check=True)
    found = TIMES.match(done.stdout)
    assert found
    return tuple(float(x) for x in found.groups())


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--level", default="", help="only levels with this in their name")
    arguments.add_argument("--queries", type=int, default=20_000, help="of each sort a level")
    options = arguments.parse_args()
    rng = np.random.default_rng(1997)
    kinds = {**SETS, "edges": through_edges}
    taken: dict[str, list[float]] = {
        name: [] for name in ("fresh, not in the cache", "fresh", "again: open", "again: first answer", "a locator")
    }
    shares: list[float] = []
    runtime, python = dict.fromkeys(kinds, 0.0), dict.fromkeys(kinds, 0.0)
    count = 0
    with tempfile.TemporaryDirectory(dir=".") as folder:  # on a disk: a file system in memory has no page cache
        program = built("runtime/sample/jklb_query.cpp", Path(folder, "jklb_query"))
        for name, level in levels():
            if options.level not in name:
                continue
            count += 1
            path = Path(folder, "level.jklb")
            path.write_bytes(compile_level(level))
            runs = {cold: np.array([times(program, path, cold=cold) for _ in range(TRIES)]) for cold in (True, False)}
            taken["fresh, not in the cache"].append(float(np.median(runs[True][:, 1])))
            taken["fresh"].append(float(np.median(runs[False][:, 1])))
            taken["again: open"].append(float(np.median(runs[False][:, 2])))
            taken["again: first answer"].append(float(np.median(runs[False][:, 3])))
            locator, sectors, surfaces = np.median(runs[False][:, 4:], axis=0).tolist()
            taken["a locator"].append(locator)
            shares.append(1e6 * locator / surfaces)
            print(
                f"{name[-40:]:<40} {taken['fresh'][-1]:8.3f} ms to the first answer, "
                f"{locator:6.3f} ms for a locator of {sectors:5.0f} sectors, {surfaces:5.0f} surfaces",
                flush=True,
            )
            compiled = CompiledLevel(path.read_bytes())
            _ = compiled.mesh
            for kind, make in kinds.items():
                queries = make(level, options.queries, rng)
                start = time.process_time()
                asked = sight_of(compiled, queries, threads=1)
                python[kind] += time.process_time() - start
                runtime[kind] += ask(program, path, asked.queries)[1]
    print(f"{'ms, open to first answer':<26} {'median':>8} {'worst':>8}")
    for kind, values in taken.items():
        print(f"{kind:<26} {np.median(values):8.3f} {max(values):8.3f}")
    print(f"a locator takes {np.median(shares):.0f} ns a surface, {min(shares):.0f} to {max(shares):.0f}")
    print(f"{'sight, queries/s a thread':<26} {'runtime':>10} {'python':>10} {'ratio':>6}")
    for kind in kinds:
        mine, theirs = count * options.queries / runtime[kind], count * options.queries / python[kind]
        print(f"{kind:<26} {mine:10,.0f} {theirs:10,.0f} {mine / theirs:6.2f}")
    print(f"{count} levels")


if __name__ == "__main__":
    main()
