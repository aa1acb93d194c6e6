"""Every level of the corpus compiled twice, with 1 and with 2 jobs: `python -m benchmarks.rebuild [--tier exact]`.

Smallest levels first. Both runs must give the same bytes; the second one has processes of its own, so other hash seeds.
What is done is kept in `--notes`, and a later call goes on from there (delete the file to begin anew). Prints one line
a level and tier; the exit status is 1 when a level is not compiled, or the bytes differ. `--minutes` ends the run
before another level is begun.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmarks.sight_queries import CORPUS
from jktools.compiler import CompileSettings
from jktools.session import build_all, load
from jktools.source import Member, resolve

TIERS = ("fast", "balanced", "exact")
TOGETHER = 4
"""Levels of one run with 2 jobs."""


def corpus() -> list[str]:
    """The paths of all levels, by their size; static.jkl, which has templates only, is none."""
    found = []
    for path in sorted([*CORPUS.glob("jkl/*.jkl"), *CORPUS.glob("gob/*")]):
        target = resolve(str(path))
        members = [target] if isinstance(target, Member) else target.members
        found += [(len(member.read().data), member.path) for member in members if member.extension == "jkl"]
    return [path for _, path in sorted(found) if load(path).has_geometry]


class Notes:
    """What earlier calls have done."""

    def __init__(self, path: Path) -> None:
        """Read them, if there are any."""
        self._path = path
        self.known: dict[tuple[str, int, str], dict[str, Any]] = {}
        for line in path.read_text().splitlines() if path.exists() else ():
            note = json.loads(line)
            self.known[note["tier"], note["jobs"], note["level"]] = note

    def add(self, **note: Any) -> None:
        """Keep one."""
        with self._path.open("a") as file:
            print(json.dumps(note), file=file)
        self.known[note["tier"], note["jobs"], note["level"]] = note


def compiled(paths: Sequence[str], tier: str, jobs: int) -> Iterator[tuple[str, str, int]]:
    """Each level's path, the SHA-256 of its file and its size; what could not be compiled is left out."""
    with tempfile.TemporaryDirectory() as folder:
        built = build_all(list(paths), Path(folder), compiling=CompileSettings(accuracy=tier), jobs=jobs)
        for message in (*built.refused, *built.problems, *built.bugs):
            print(f"  {message}", flush=True)
        for each in built.written:
            yield each.level, hashlib.sha256(each.target.read_bytes()).hexdigest(), each.size


def run(tier: str, paths: Sequence[str], jobs: int, notes: Notes, end: float) -> None:
    """Compile what is not done yet."""
    waiting = [path for path in paths if (tier, jobs, path) not in notes.known]
    together = TOGETHER if jobs > 1 else 1
    for first in range(0, len(waiting), together):
        if time.monotonic() > end:
            return
        chosen = waiting[first : first + together]
        began = time.perf_counter()
        found = {path: (digest, size) for path, digest, size in compiled(chosen, tier, jobs)}
        seconds = (time.perf_counter() - began) / len(chosen)
        for path in chosen:
            digest, size = found.get(path, ("", 0))
            notes.add(tier=tier, jobs=jobs, level=path, sha256=digest, bytes=size, seconds=round(seconds, 2))


def tell(tier: str, paths: Sequence[str], notes: Notes) -> bool:
    """Print what came of a tier; whether all that is done is as it must be."""
    good, done = True, 0
    for path in paths:
        once, again = (notes.known.get((tier, jobs, path)) for jobs in (1, 2))
        name = path.rpartition("/corpus/")[2]
        if once is None or again is None:
            print(f"{tier:9}{name:48} not done")
            continue
        same = once["sha256"] == again["sha256"] != ""
        good, done = good and same, done + same
        verdict = "same" if same else "not compiled" if not once["sha256"] else "DIFFERS"
        print(f"{tier:9}{name:48}{once['bytes']:9} bytes {once['seconds']:8.2f} s {verdict}")
    print(f"{tier}: {done} of {len(paths)} levels compiled with 1 and with 2 jobs to the same bytes", flush=True)
    return good


def main() -> int:
    """Compile, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tier", action="append", choices=TIERS, help="may be repeated; by default all")
    parser.add_argument("--minutes", type=float, default=float("inf"))
    parser.add_argument("--without", action="append", default=[], help="leave out levels with this in their path")
    parser.add_argument("--notes", type=Path, default=Path("build/rebuild.jsonl"))
    arguments = parser.parse_args()
    arguments.notes.parent.mkdir(exist_ok=True)
    notes = Notes(arguments.notes)
    paths = [path for path in corpus() if not any(each in path for each in arguments.without)]
    end = time.monotonic() + 60 * arguments.minutes
    good = True
    for tier in arguments.tier or TIERS:
        for first in range(0, len(paths), TOGETHER):
            for jobs in (1, 2):
                run(tier, paths[first : first + TOGETHER], jobs, notes, end)
        good &= tell(tier, paths, notes)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
