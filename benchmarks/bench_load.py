"""Opening a compiled level against reading its JKL: map, header, range check and every array viewed, as a ratio.

`python -m benchmarks.bench_load` prints a row a level: medians of runs that alternate, so that a machine that drifts
hits both alike. `first` leaves out the arrays: what `open_compiled` takes.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from jktools.compiler import CompileError, compile_level, open_compiled
from jktools.model import Level
from jktools.source import Source
from jktools.syntax.jkl import read
from tests.support.levels import CORPUS, corpus_files

RUNS = 15
GOAL = 100


def viewed(path: Path) -> int:
    """Open a file and take every array of it as it lies there; how many there are."""
    level = open_compiled(path)
    return sum(len(list(stored.vectors)) for section in level.sections.values() for stored in section.stored.values())


def parsed(path: str, data: bytes) -> int:
    """Read a JKL into arrays; how many vertices it has."""
    return len(Level(read(Source(path, data))).vertices)


def seconds(run: Callable[[], int]) -> float:
    started = time.perf_counter()
    assert run()
    return time.perf_counter() - started


def test_load() -> None:
    if not CORPUS.exists():
        pytest.skip("the corpus of real mods is not at hand")
    main()


def main() -> None:
    """Print the table."""
    print(f"\n{'level':<24}{'JKL, ms':>10}{'open, ms':>10}{'all, ms':>10}{'ratio':>8}   (goal {GOAL})")
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for name, data in corpus_files():
            level = Level(read(Source(name, data)))
            if not level.has_geometry:
                continue
            try:
                compiled = compile_level(level)
            except CompileError:
                continue
            path = Path(folder, "level.jklb")
            path.write_bytes(compiled)
            times: dict[str, list[float]] = {"parse": [], "open": [], "all": []}
            for _ in range(RUNS):
                times["parse"].append(seconds(lambda name=name, data=data: parsed(name, data)))  # type: ignore[misc]
                times["open"].append(seconds(lambda path=path: len(open_compiled(path).vertices)))  # type: ignore[misc]
                times["all"].append(seconds(lambda path=path: viewed(path)))  # type: ignore[misc]
            parse, opened, whole = (1000 * statistics.median(times[key]) for key in ("parse", "open", "all"))
            ratios.append(parse / whole)
            print(f"{name[-24:]:<24}{parse:>10.2f}{opened:>10.3f}{whole:>10.3f}{parse / whole:>7.0f}x", flush=True)
    print(f"median ratio {statistics.median(ratios):.0f}x")


if __name__ == "__main__":
    main()
