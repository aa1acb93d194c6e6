"""Opening a compiled level against reading its JKL, as ratios.

`python -m benchmarks.bench_load` prints a row a level: seconds of processor, medians of runs that alternate by fives,
so that a machine that drifts hits all alike. `found`: the file is mapped, its header read and every array found, by the
C++ reader. `checked`: every offset and index is checked first, as `open_compiled` and the runtime always do. `opened`:
`open_compiled`, which makes a column when it is asked for. `Python`: the same, and a numpy array of every vector.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from jktools._native_file import level_fault, level_parts  # noqa: TID251 (measured alone)
from jktools.compiler import CompileError, compile_level, open_compiled
from jktools.compiler.mapping import mapping
from jktools.compiler.slots import wanted
from jktools.model import Level
from jktools.source import Source
from jktools.syntax.jkl import read
from tests.support.levels import CORPUS, corpus_files

ROUNDS, RUNS = 5, 5
GOAL = 100


def native(path: Path, check: bool) -> int:
    """Map a file, verify and check it if wanted, and find every array; how many columns there are."""
    with mapping(path) as mapped:
        octets = np.frombuffer(mapped, np.uint8)
        assert not (check and level_fault(octets))
        found = len(level_parts(octets, wanted())[1])
        del octets
    return found


def viewed(path: Path) -> int:
    """Open a file and take every array of it as it lies there; how many there are."""
    level = open_compiled(path)
    return sum(len(list(stored.vectors)) for section in level.sections.values() for stored in section.stored.values())


def opened(path: Path) -> int:
    """Open a file; how many sections it has."""
    return len(open_compiled(path).sections)


def parsed(path: str, data: bytes) -> int:
    """Read a JKL into arrays; how many vertices it has."""
    return len(Level(read(Source(path, data))).vertices)


def seconds(run: Callable[[], int]) -> float:
    started = time.process_time()
    assert run()
    return time.process_time() - started


def test_load() -> None:
    if not CORPUS.exists():
        pytest.skip("the corpus of real mods is not at hand")
    main()


def main() -> None:
    """Print the table."""
    ratios: dict[str, list[float]] = {"found": [], "checked": [], "opened": [], "Python": []}
    heading = "".join(f"{f'{way}, ms':>12}{'ratio':>8}" for way in ratios)
    print(f"\n{'level':<32}{'JKL, ms':>10}{heading}   (goal {GOAL})")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "level.jklb")
        for name, data in corpus_files():
            level = Level(read(Source(name, data)))
            if not level.has_geometry:
                continue
            try:
                path.write_bytes(compile_level(level))
            except CompileError:
                continue
            ways: dict[str, Callable[[], int]] = {
                "JKL": lambda name=name, data=data: parsed(name, data),  # type: ignore[misc]
                "found": lambda: native(path, False), "checked": lambda: native(path, True),
                "opened": lambda: opened(path), "Python": lambda: viewed(path),
            }  # fmt: skip
            times: dict[str, list[float]] = {way: [] for way in ways}
            for _ in range(ROUNDS):
                for way, run in ways.items():
                    times[way] += [seconds(run) for _ in range(RUNS)]
            medians = {way: 1000 * statistics.median(each) for way, each in times.items()}
            row = f"{name[-32:]:<32}{medians['JKL']:>10.2f}"
            for way, told in ratios.items():
                told.append(medians["JKL"] / medians[way])
                row += f"{medians[way]:>12.3f}{told[-1]:>7.0f}x"
            print(row, flush=True)
    print("median ratio: " + ", ".join(f"{statistics.median(each):.0f}x {way}" for way, each in ratios.items()))


if __name__ == "__main__":
    main()
