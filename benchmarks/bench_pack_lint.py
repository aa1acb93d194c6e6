"""Linting a whole level pack (masspack.gob: 7 levels, 6.9 MB) as one cold process: wall seconds and peak memory."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.levels import CORPUS

PACK = CORPUS / "gob/masspack.gob"
RUNS = 5


def test_linting_a_pack() -> None:
    if not PACK.exists():
        pytest.skip("the corpus of real mods is not at hand")
    command = [str(Path(sys.executable).parent / "jktools"), "lint", str(PACK)]
    seconds, megabytes = [], []
    for _ in range(RUNS):
        started = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        _, _, usage = os.wait4(process.pid, 0)
        process.returncode = 0  # reaped above, for its memory
        seconds.append(time.perf_counter() - started)
        megabytes.append(usage.ru_maxrss / 1024)
    print(f"\nlint {PACK.name}: {statistics.median(seconds):.2f} s wall, {statistics.median(megabytes):.0f} MB at most")
