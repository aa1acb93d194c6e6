"""Building a whole level pack (masspack.gob: 7 levels, 6.9 MB) at `balanced`: seconds and memory, and the time by pass.

Memory is the sum over the process and its workers, sampled, so that what they share counts more than once.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

from jktools.compiler import CompileSettings, compilation
from jktools.facts import LevelFacts
from jktools.session import discover, load
from tests.support.levels import CORPUS

PACK = CORPUS / "gob/masspack.gob"
GOAL_SECONDS, GOAL_MEGABYTES = 20, 400
SAMPLE = 0.02


def test_building_a_pack(tmp_path: Path) -> None:
    if not PACK.exists():
        pytest.skip("the corpus of real mods is not at hand")
    command = [str(Path(sys.executable).parent / "jktools"), "build", str(PACK), "-o", str(tmp_path)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    started = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    most = 0.0
    while process.poll() is None:
        most = max(most, sum(_resident(pid) for pid in _tree(process.pid)))
        time.sleep(SAMPLE)
    seconds = time.perf_counter() - started
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime
    print(f"\nbuild {PACK.name}, {os.cpu_count()} cores: {seconds:.2f} s wall (goal {GOAL_SECONDS}), "
          f"{processor:.2f} s of processor, {most:.0f} MB at most (goal {GOAL_MEGABYTES})")  # fmt: skip


def test_time_by_pass() -> None:
    """One after the other in this process; a fact that several passes share counts for the first."""
    if not PACK.exists():
        pytest.skip("the corpus of real mods is not at hand")
    spent: Counter[str] = Counter()
    for member in discover(str(PACK), [], ("jkl",)):
        started = time.perf_counter()
        level = load(member.path)
        at, since = "read", started

        def progress(name: str) -> None:
            nonlocal at, since
            now = time.perf_counter()
            spent[at] += now - since
            at, since = name, now

        compilation(level, CompileSettings(), LevelFacts(level), progress)
        progress("end")
    total = sum(spent.values())
    print(f"\nbuild {PACK.name}, one process: {total:.2f} s; the last pass includes writing the file")
    for name, seconds in spent.items():
        print(f"  {name:<16}{seconds:8.3f} s {seconds / total:7.1%}")


def _tree(root: int) -> list[int]:
    found, pending = [], [root]
    while pending:
        pid = pending.pop()
        found.append(pid)
        try:
            for task in Path(f"/proc/{pid}/task").iterdir():
                pending += map(int, (task / "children").read_text().split())
        except OSError:
            continue
    return found


def _resident(pid: int) -> float:
    try:
        words = Path(f"/proc/{pid}/statm").read_text().split()
    except OSError:
        return 0.0
    return int(words[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20
