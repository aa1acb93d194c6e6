"""The size of compiled levels against their JKL, over the corpus.

`python -m benchmarks.file_size` prints a row a level: bytes of the JKL, and of the file at `balanced` and `fast` as
shares of it; the last column leaves out templates and names that nothing is known to reach (`--cut-anyway`), as a build
does by itself when the game's files are at hand as its base. The levels are compiled as `jktools build` does it, with
the scripts and models of their packs; of the game's own files none is at hand, so that templates which only static.jkl
has are not in them. `--level WORD` chooses levels by their names.
"""

from __future__ import annotations

import argparse
import statistics
from collections.abc import Iterator

from benchmarks.sight_queries import CORPUS
from jktools.compiler import CompileError, CompileSettings, compile_level
from jktools.geometry import Accuracy
from jktools.model import Level
from jktools.session import load
from jktools.source import Member, resolve

GOALS: dict[Accuracy, float] = {"balanced": 0.75, "fast": 0.6}
LARGE = 100_000
"""Bytes of a JKL from which on geometry, not lists of names, is what a level is made of."""


def sizes(level: Level) -> list[int]:
    """Bytes at balanced and fast, and at balanced without what nothing is known to reach."""
    settings = (CompileSettings(), CompileSettings(accuracy="fast"), CompileSettings(cut_anyway=True))
    return [len(compile_level(level, each)) for each in settings]


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--level", default="", help="levels whose name holds this word")
    word = arguments.parse_args().level
    print(f"{'level':<32}{'JKL':>10}{'balanced':>18}{'fast':>18}{'balanced, cut':>18}")
    rows: list[tuple[int, list[int]]] = []
    for name, length, path in _members():
        if word not in name:
            continue
        level = load(path)
        if not level.has_geometry:
            continue
        try:
            rows.append((length, sizes(level)))
        except CompileError as error:
            print(f"{name[-32:]:<32}{length:>10}  {error}")
            continue
        print(_row(name[-32:], *rows[-1]), flush=True)
    if not rows:
        return
    for title, chosen in (
        ("all", rows), (f"of at least {LARGE} bytes", [row for row in rows if row[0] >= LARGE]),
        ("smaller", [row for row in rows if row[0] < LARGE]),
    ):  # fmt: skip
        if chosen:
            totals = [sum(column) for column in zip(*(each for _, each in chosen), strict=True)]
            print(_row(f"{len(chosen)} levels, {title}", sum(size for size, _ in chosen), totals))
            shares = [[each / size for each in made] for size, made in chosen]
            for name, of in (("median", statistics.median), ("most", max)):
                told = "".join(f"{of(column):>18.2f}" for column in zip(*shares, strict=True))
                print(f"{name:>42}{told}")
    print("goals: " + ", ".join(f"{goal} at {tier}" for tier, goal in GOALS.items()))


def _members() -> Iterator[tuple[str, int, str]]:
    """Each JKL of the corpus: its name, its bytes and its path."""
    for path in sorted([*CORPUS.glob("gob/*"), *CORPUS.glob("jkl/*.jkl")]):
        target = resolve(str(path))
        for member in [target] if isinstance(target, Member) else target.members:
            if member.extension == "jkl":
                name = path.name if isinstance(target, Member) else f"{path.name}!{member.name}"
                yield name, len(member.read().data), member.path


def _row(name: str, size: int, made: list[int]) -> str:
    return f"{name:<32}{size:>10}" + "".join(f"{each:>12} {each / size:>5.2f}" for each in made)


if __name__ == "__main__":
    main()
