"""`docs/tradeoffs.md`: what accuracy costs and brings, over every level of the corpus.

`python -m tools.tradeoff_page` measures what docs/tradeoffs.json does not hold yet, level by level and pass by pass,
and writes the page and its plot; stopped, it goes on from there. `--again PASS,...` measures these anew, `--write` only
writes. The page alone follows from the figures: `make generate` writes it too.
"""

from __future__ import annotations

import argparse
import functools
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from jktools.compiler import CompileError, CompileSettings, compile_level
from jktools.engine.profile import Engine
from jktools.model import Level
from jktools.session import Settings, discover, load
from jktools.session.levels import read_level
from jktools.tradeoff import PASSES, TIERS, Asked, Plan, Row, measure
from jktools.tradeoff.plot import draw
from jktools.tradeoff.write import cell_of
from tools.tradeoff_text import Figures, page

ROOT = Path(__file__).resolve().parent.parent
CORPUS = ROOT.parent / "shared" / "corpus"
FIGURES = "docs/tradeoffs.json"
PAGE = "docs/tradeoffs.md"
PLOT = "docs/tradeoffs.svg"
GROUPS = (
    ("location",),
    ("sight",),
    ("drop",),
    ("motion",),
    ("geometry",),
    ("visibility",),
    ("ledges", "basins"),
    ("build",),
)
"""Measured and kept together, the quick ones first."""
QUERIES, SEED = 8_000, 1997


def levels() -> list[tuple[str, str, Level]]:
    """Name, path and level of all that can be compiled, the smallest first."""
    found = []
    for member in discover(str(CORPUS), extensions=("jkl",)):
        level = read_level(member, Settings())
        try:
            compile_level(level, CompileSettings(only=frozenset({"cogs"})))
        except CompileError:
            continue
        found.append((Path(member.path).relative_to(CORPUS).as_posix(), member.path, level))
    return sorted(found, key=lambda each: len(each[2].surfaces))


def run(
    figures: Figures, chosen: Sequence[str], again: Sequence[str], seconds: float, keep: Callable[[], None]
) -> None:
    """Measure what the figures do not hold."""
    found = levels()
    names = {name for name, *_ in found}
    for gone in set(figures) - names:
        del figures[gone]
    for each in figures.values():
        for name in again:
            each.pop(name, None)
    for group in (group for group in GROUPS if not chosen or set(group) & set(chosen)):
        for name, path, level in found:
            held = figures.setdefault(name, {})
            held["level"] = {
                "sectors": len(level.sectors),
                "surfaces": len(level.surfaces),
                "bytes": len(level.source.data),
            }
            if all(part in held for part in group):
                continue
            # The exact build is its parts again: minutes that tell nothing new.
            tiers = TIERS[:2] if group == ("build",) else TIERS
            plan = Plan(Asked(Engine.RESEARCH, QUERIES, SEED), group, tiers, seconds, repeat_seconds=0.5)
            for row in measure(functools.partial(load, path), plan):
                held[row.found.name] = _kept(row)
            print(name, ", ".join(group), flush=True)
            keep()


def _kept(row: Row) -> Any:
    if row.nothing:
        return {"nothing": row.nothing}
    cells = {}
    for cell in row.cells:
        whole = cell_of(cell)
        times, error = whole["seconds"], whole["error"]
        kept = {
            "seconds": times and float(f"{times['median']:.4g}"),
            "seconds_at_edges": whole["seconds_at_edges"] and float(f"{whole['seconds_at_edges']:.4g}"),
            "memory": whole["memory"] and whole["memory"]["added"],
            "bytes": whole["bytes"],
            "worst": error and error["worst"],
            "measures": error and error["measures"],
            "not_measured": whole["not_measured"],
        }
        cells[cell.tier] = {key: value for key, value in kept.items() if value is not None}
    return cells


def read() -> Figures:
    """The figures, none where the file is absent."""
    path = ROOT / FIGURES
    return json.loads(path.read_text()) if path.exists() else {}


def write(figures: Figures) -> None:
    """Keep the figures, a line for each level and pass."""
    lines = []
    for name in sorted(figures):
        own = [
            f'    "{part}": {json.dumps(figures[name][part])}' for part in ("level", *PASSES) if part in figures[name]
        ]
        lines.append(f'  "{name}": {{\n' + ",\n".join(own) + "\n  }")
    target = ROOT / FIGURES
    fresh = target.with_suffix(".part")
    fresh.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    fresh.replace(target)


def plot(figures: Figures) -> bytes:
    """Time against error of all levels, one panel a pass."""
    panels = []
    for name, found in PASSES.items():
        points = [
            (tier, held[name][tier]["seconds"], held[name][tier]["worst"])
            for held in figures.values()
            for tier in TIERS
            if "worst" in held.get(name, {}).get(tier, {})
        ]
        if points:
            panels.append((name, found.measure, points))
    return draw(panels, f"{len(figures)} levels of real mods: down and left is better", "svg")


def tradeoff_page(into: Path) -> Path:
    """Write the page from the figures that are kept."""
    target = into / PAGE
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page(read(), QUERIES, SEED))
    return target


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--passes", default="", help="those to measure, between commas; all by default")
    arguments.add_argument("--again", default="", help="passes to measure anew, between commas")
    arguments.add_argument("--time-limit", type=float, default=600.0, help="seconds a cell")
    arguments.add_argument("--write", action="store_true", help="measure nothing")
    options = arguments.parse_args()
    figures = read()
    if not options.write:
        if not CORPUS.exists():
            print(f"no levels at {CORPUS}: nothing measured")
            return
        chosen, again = ([name for name in text.split(",") if name] for text in (options.passes, options.again))
        run(figures, chosen, again, options.time_limit, lambda: write(figures))
        write(figures)
    print(tradeoff_page(ROOT))
    (ROOT / PLOT).write_bytes(plot(figures))


if __name__ == "__main__":
    main()
