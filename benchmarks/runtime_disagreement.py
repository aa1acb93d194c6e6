"""How often the C++ runtime and Python disagree over the corpus: `python -m benchmarks.runtime_disagreement`.

Each level is compiled, and both answer from the file alone. Sight (visible, crossed, blocker), drop (ending, surface,
sector and every bit of the distance), location, visible sectors, ledges, ways over floors and basins must be equal in
every answer, every bit and ties included, and the exit status is 1 if they are not.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from benchmarks.runtime_queries import (
    KINDS,
    Asked,
    ask,
    differing,
    drop_of,
    location_of,
    sight_of,
    visible_of,
)
from benchmarks.sight_queries import levels
from benchmarks.walking_queries import basins_at, floors_of_basins, ledges_of, ledges_of_things, ways_of
from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.model import Level
from tests.runtime.compiler import built

WALKING = {
    "ledges": ledges_of,
    "of things": ledges_of_things,
    "ways": ways_of,
    "basins": basins_at,
    "of basins": floors_of_basins,
}
QUESTIONS = ("sight", "drop", "locate", "visible", *WALKING)


def asked_of(
    question: str, level: Level, compiled: CompiledLevel, count: int, rng: np.random.Generator, threads: int
) -> list[Asked]:
    """So many queries of one sort, shared out among all ways of making them."""
    if question in WALKING:
        return [WALKING[question](compiled, count, rng)]
    each = -(-count // len(KINDS))
    made = [make(level, each, rng) for make in KINDS.values()]
    if question == "visible":
        return [visible_of(compiled, queries, rng) for queries in made]
    answer = {"sight": sight_of, "drop": drop_of, "locate": location_of}[question]
    return [answer(compiled, queries, threads) for queries in made]


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--queries", type=int, default=100_000, help="of each sort a level")
    arguments.add_argument("--level", default="", help="only levels with this in their name")
    arguments.add_argument("--questions", nargs="+", choices=QUESTIONS, default=QUESTIONS)
    arguments.add_argument("--accuracy", default="balanced", choices=("fast", "balanced", "exact"), help="of the file")
    arguments.add_argument("--threads", type=int, default=0, help="of Python's side")
    arguments.add_argument("--seed", type=int, default=1997)
    options = arguments.parse_args()
    rng = np.random.default_rng(options.seed)
    totals = {question: np.zeros(2, np.int64) for question in options.questions}
    start, count = time.perf_counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        program = built("runtime/sample/jklb_query.cpp", Path(folder, "jklb_query"))
        for name, level in levels():
            if options.level not in name:
                continue
            count += 1
            path = Path(folder, "level.jklb")
            path.write_bytes(compile_level(level, CompileSettings(accuracy=options.accuracy)))
            compiled = CompiledLevel(path.read_bytes())
            for question in options.questions:
                for asked in asked_of(question, level, compiled, options.queries, rng, options.threads):
                    found, _ = ask(program, path, asked.queries)
                    wrong = differing(asked.answers, found)
                    totals[question] += len(found), len(wrong)
                    if len(wrong):
                        row = wrong[0]
                        print(f"{name} {question}: {len(wrong)} of {len(found)} differ, the first is")
                        print(f"  {asked.queries[row]}: python {asked.answers[row]}, runtime {found[row]}")
            print(f"{name}: {sum(int(each[1]) for each in totals.values())} so far", file=sys.stderr)
    print(f"{'question':<9} {'queries':>11} {'differ':>7}")
    for question, (number, wrong_number) in totals.items():
        print(f"{question:<9} {number:11,} {wrong_number:7}")
    print(f"{count} levels, {time.perf_counter() - start:.0f} s")
    sys.exit(int(any(each[1] for each in totals.values()) or not count))


if __name__ == "__main__":
    main()
