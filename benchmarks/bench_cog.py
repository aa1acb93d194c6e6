"""The 45 COGs of masspack.gob: files/s and MB/s of the reader and of all rules, beside Lark's bare parse of the same.

All times are of the processor, since other work on the machine would count in seconds by the clock. Warm: rounds in
turn in one process, medians. Cold: each round a process of its own, from behind `import jktools`, so
that it pays for the grammar (from its cache, or built where there is none) and for every import. Lark's bare parse gets
the code alone, without header and final `end`, and makes its own tree.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

import pytest

from jktools.linter import lint
from jktools.source import Container, Source, resolve
from jktools.syntax import grammar
from jktools.syntax.cog import read_script
from jktools.syntax.cog.tables import START_RULES
from tests.support.levels import CORPUS

PACK = CORPUS / "gob/masspack.gob"
ROUNDS = 9
COLD_ROUNDS = 5

COLD = """
import sys, time, jktools
from jktools.source import resolve
files = [m.read() for m in resolve({pack!r}).members if m.extension == "cog"]
begun = time.process_time()
{work}
print(time.process_time() - begun)
"""
COLD_WORK = {
    "cold: imports of the reader": "import jktools.syntax.cog",
    "cold: grammar alone": "from jktools.syntax.cog.tables import tables; begun = time.process_time(); tables()",
    "cold: read": "from jktools.syntax.cog import read_script; [read_script(f) for f in files]",
    "cold: read and all rules": "from jktools.syntax.cog import read_script; from jktools.linter import lint; "
    "[lint(read_script(f)) for f in files]",
}


def sources() -> list[Source]:
    pack = resolve(PACK.as_posix())
    assert isinstance(pack, Container)
    return [member.read() for member in pack.members if member.extension == "cog"]


def code_of(source: Source) -> str:
    script = read_script(source)
    text = source.text[script.code.start : script.code.end]
    return text[: -len("end")] if script.code.closed else text


@pytest.mark.skipif(not PACK.exists(), reason="the corpus of real mods is not at hand")
def test_cog() -> None:
    files = sources()
    codes = [code_of(source) for source in files]
    parser = grammar.load("cog", START_RULES, "basic")

    def fresh() -> list[Source]:
        return [Source(source.path, source.data, source.name) for source in files]

    work: dict[str, Callable[[], object]] = {
        "Lark's bare parse": lambda: [parser.parse(code, start="body") for code in codes],
        "read": lambda: [read_script(source) for source in fresh()],
        "read and all rules": lambda: [lint(read_script(source)) for source in fresh()],
    }
    times: dict[str, list[float]] = {name: [] for name in work}
    for _ in range(ROUNDS + 1):
        for name, run in work.items():
            begun = time.process_time()
            run()
            times[name].append(time.process_time() - begun)
    size, bare = sum(len(s.data) for s in files), statistics.median(times["Lark's bare parse"][1:])
    print(f"\n{len(files)} scripts, {size} bytes, of them {sum(map(len, codes))} of code")
    print(f"{'':<34}{'ms':>8}{'files/s':>9}{'MB/s':>7}{'of the bare parse':>19}")

    def row(name: str, taken: float) -> None:
        print(
            f"{name:<34}{taken * 1e3:>8.1f}{len(files) / taken:>9.0f}{size / taken / 1e6:>7.2f}{taken / bare:>18.2f}x"
        )

    for name, taken in times.items():
        row(name, statistics.median(taken[1:]))
    with tempfile.TemporaryDirectory() as cache:
        for name, line in COLD_WORK.items():
            for cached in (False, True):
                found = [cold(line, cache if cached else "") for _ in range(COLD_ROUNDS + cached)][cached:]
                row(f"{name}, {'cache' if cached else 'no cache'}", statistics.median(found))


def cold(work: str, cache: str) -> float:
    """Seconds of the processor for some work in a process of its own; with a cache of grammars, or without one."""
    done = subprocess.run(
        [sys.executable, "-c", COLD.format(pack=PACK.as_posix(), work=work)],
        capture_output=True, text=True, check=True, env={**os.environ, grammar.CACHE_FOLDER_VARIABLE: cache},
    )  # fmt: skip
    return float(done.stdout)
