"""Regenerate everything in the repository that is made from something else in it.

`python -m tools.generate` writes in place; with `--into FOLDER` it writes beneath another root, for comparison.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

from tools.format_page import format_page
from tools.parameter_page import parameter_page
from tools.reach_table import reach_table
from tools.rule_pages import count_corpus, rule_pages
from tools.runtime_sections import runtime_sections
from tools.tradeoff_page import tradeoff_page

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = "grammars/level.fbs"
DOORS = ("text", "geometry", "file")


def native_stubs(into: Path) -> list[Path]:
    """`jktools/_native_*.pyi`, from the compiled modules."""
    made = []
    for door in DOORS:
        target = into / f"jktools/_native_{door}.pyi"
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(
            [
                sys.executable,
                "-m",
                "nanobind.stubgen",
                "-q",
                "-m",
                f"jktools._native_{door}",
                "-o",
                str(target),
            ],
            check=True,
        )
        made.append(target)
    return made


def level_code(into: Path) -> list[Path]:
    """The C++ header and the Python module for compiled levels, from the schema."""
    header, module = into / "runtime/level_generated.h", into / "jktools/compiler/level_generated.py"
    for target, options in ((header, ["--cpp"]), (module, ["--python", "--gen-onefile"])):
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(
            [
                str(Path(sys.executable).parent / "flatc"),
                *options,
                "-o",
                str(target.parent),
                str(ROOT / SCHEMA),
            ],
            check=True,
        )
    return [header, module]


def generate(into: Path) -> list[Path]:
    """Write everything beneath `into` and list it."""
    return [
        *native_stubs(into),
        *level_code(into),
        runtime_sections(into),
        parameter_page(into),
        format_page(into),
        *rule_pages(into),
        tradeoff_page(into),
    ]


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--into", type=Path, default=ROOT)
    arguments.add_argument("--count", action="store_true", help="count the rules' findings over the corpus first")
    chosen = arguments.parse_args()
    if chosen.count:
        print(count_corpus(chosen.into))
        print(reach_table(chosen.into))
    for path in generate(chosen.into):
        print(path)


if __name__ == "__main__":
    main()
