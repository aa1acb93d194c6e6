"""How long a user waits: `--version` and linting one small level, each a whole process, beside a bare interpreter.

Run in turn so that a machine that drifts hits all three alike; medians of 15 runs.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SMALL = ROOT.parent / "shared/corpus/gob/rain.gob"
RUNS = 15


def test_start() -> None:
    level = SMALL if SMALL.exists() else ROOT / "fixtures/smithdev/level/jkl/smithdev.jkl"
    jktools = str(Path(sys.executable).parent / "jktools")
    commands = {
        "python3 -c pass": [sys.executable, "-c", "pass"],
        "jktools --version": [jktools, "--version"],
        f"jktools lint {level.name}": [jktools, "lint", str(level)],
    }
    times: dict[str, list[float]] = {name: [] for name in commands}
    for _ in range(RUNS + 1):
        for name, command in commands.items():
            started = time.perf_counter()
            subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
            times[name].append(time.perf_counter() - started)
    bare = statistics.median(times["python3 -c pass"][1:])
    print(f"\n{'whole process':<28}{'median s':>10}{'of a bare start':>18}")
    for name, taken in times.items():
        median = statistics.median(taken[1:])  # the first round warms the caches
        print(f"{name:<28}{median:>10.3f}{median / bare:>17.1f}x")
