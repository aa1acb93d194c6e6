"""The text of docs/tradeoffs.md, from the figures of all levels.

What it claims is checked against the figures: a sentence that they no longer carry is an error.
"""

from __future__ import annotations

import math
import statistics
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from jktools.engine.body import WALKPLAYER
from jktools.tradeoff import PASSES, TIERS
from jktools.tradeoff.errors import ROUNDING, length
from jktools.tradeoff.write import duration

Figures = dict[str, dict[str, Any]]
"""By level and pass: why there is nothing, or the cells by tier as `jktools tradeoff --json` has them, less deep."""

QUERIED = ("location", "sight", "drop")
WIDTH = 120
COSTS = (("build", "fast"), ("build", "balanced"), ("visibility", "exact"), ("ledges", "exact"))


class Corpus:
    """The figures of all levels together."""

    def __init__(self, figures: Figures) -> None:
        self.figures = figures

    def cells(self, name: str, tier: str, *, beside: str = "") -> Iterator[dict[str, Any]]:
        """One pass at one tier, of the levels where it was measured there and at another tier."""
        for each in self.figures.values():
            held = each.get(name, {})
            if all("seconds" in held.get(t, {}) for t in (tier, beside or tier)):
                yield held[tier]

    def compared(self, name: str, tier: str) -> Iterator[dict[str, Any]]:
        """The cells whose error is known."""
        return (cell for cell in self.cells(name, tier) if "measures" in cell)

    def ratio(self, name: str, tier: str, other: str) -> float:
        """How many times as long, the geometric mean over the levels; not a number where none has both."""
        pairs = zip(self.cells(name, tier, beside=other), self.cells(name, other, beside=tier), strict=True)
        found = [max(a["seconds"], 1e-9) / max(b["seconds"], 1e-9) for a, b in pairs]
        return statistics.geometric_mean(found) if found else math.nan

    def at_edges(self, name: str, tier: str) -> float:
        """How many times as long a query takes that is aimed at an edge, the geometric mean."""
        ratios = [
            cell["seconds_at_edges"] / cell["measures"]["asked_at_edges"] * cell["measures"]["asked"] / cell["seconds"]
            for cell in self.compared(name, tier)
        ]
        return statistics.geometric_mean(ratios) if ratios else math.nan

    def total(self, name: str, tier: str, key: str) -> float:
        """The sum of one measure of the error over the levels where it is known."""
        return sum(cell["measures"].get(key, 0) for cell in self.compared(name, tier))

    def most(self, name: str, tier: str, key: str) -> float:
        """The greatest."""
        return max((cell["measures"].get(key, 0) for cell in self.compared(name, tier)), default=0)

    def share(self, name: str, tier: str, part: str, whole: str) -> float:
        """The sum of one measure as a part of that of another."""
        return self.total(name, tier, part) / (self.total(name, tier, whole) or 1)

    def figure(self, name: str, tier: str, key: str, fold: Callable[[list[float]], float] = sum) -> float:
        """A figure of the cells, folded over the levels."""
        return fold([cell[key] for cell in self.cells(name, tier) if key in cell] or [0])

    def count(self, name: str, tier: str) -> int:
        """Levels in which a pass was measured."""
        return sum(1 for _ in self.cells(name, tier))

    def left_out(self, name: str, tier: str) -> int:
        """Levels in which it took too long."""
        return sum("not_measured" in each.get(name, {}).get(tier, {}) for each in self.figures.values())


TEMPLATE = Path(__file__).with_name("tradeoffs.template.md")
GRID = """
- *The file*: at `fast` vertices lie on a grid, {moved} off at most; the geometry takes {geometry_bytes} of its bytes at
  `balanced`, the whole file {file_bytes}.
"""
NO_GRID = "- *The file*: vertices are those of the level at every tier."


def page(figures: Figures, queries: int, seed: int) -> str:
    """The page. Raises ValueError with the sentence that the figures do not carry."""
    corpus = Corpus(figures)
    for claim, holds in _claims(corpus):
        if not holds:
            raise ValueError(f"docs/tradeoffs.md claims that {claim}, but the figures do not carry it")
    named = _named(corpus)
    filled = TEMPLATE.read_text().format(
        levels=len(figures), queries=f"{queries:,}", seed=seed, table="\n".join(_table(corpus)),
        rows="\n".join(_by_level(figures)), **named,
    )  # fmt: skip
    return "\n".join(_wrapped(filled)) + "\n"


def _claims(c: Corpus) -> Iterator[tuple[str, bool]]:
    """What the sentences say beside their numbers."""
    for name in QUERIED:
        wrong = sum(c.total(name, "balanced", key) for key in ("wrong", "wrong_at_edges", "unlike"))
        yield f"balanced is exact for {name}", wrong == 0
        yield f"fast is wrong at times for {name}", c.total(name, "fast", "wrong") > 0
    for tier in TIERS:
        yield f"no segment refutes {tier}", c.total("visibility", tier, "refuted") == 0
        yield f"{tier} misses no pair", c.total("visibility", tier, "missed") == 0
    wrong = [c.total("ledges", tier, "wrong_length") for tier in ("fast", "balanced")]
    yield "balanced misses no ledge", c.total("ledges", "balanced", "missed") == 0
    yield (
        "balanced is off by less than a body's width",
        c.most("ledges", "balanced", "wrong_longest") < 2 * WALKPLAYER.movesize,
    )
    yield "fast classes more of the edges wrong", wrong[0] > 100 * wrong[1]
    yield "fast is no faster for motion", c.ratio("motion", "fast", "balanced") > 0.9
    yield "exact has fewer pairs", c.total("visibility", "balanced", "false") > 0
    yield "fast misses more ledges", c.total("ledges", "fast", "missed") > c.total("ledges", "balanced", "missed")
    off = [c.most("motion", tier, "off_most") for tier in TIERS]
    yield "the closed form is off by most, and exact by nothing", off[0] > off[1] > off[2] == 0
    yield "motion takes milliseconds", c.figure("motion", "exact", "seconds", max) < 1
    for tier in ("balanced", "exact"):
        yield f"vertices are those of the level at {tier}", c.most("geometry", tier, "moved_most") == 0


def _named(c: Corpus) -> dict[str, str]:
    """The numbers of the sentences."""
    found = {"samples": "8", "sight_asked": f"{c.total('sight', 'balanced', 'asked') + c.total('sight', 'balanced', 'asked_at_edges'):,.0f}"}  # noqa: E501  # fmt: skip
    for name in QUERIED:
        found[f"{name}_wrong"] = _percent(c.share(name, "fast", "wrong", "asked"))
        found[f"{name}_wrong_edges"] = _percent(c.share(name, "fast", "wrong_at_edges", "asked_at_edges"))
    for name in (*QUERIED, "visibility", "ledges", "build"):
        found[f"{name}_balanced"] = _times(c.ratio(name, "balanced", "fast"))
        found[f"{name}_exact"] = _times(c.ratio(name, "exact", "balanced"))
    for tier in ("fast", "balanced"):
        found[f"edges_{tier}"] = _times(c.at_edges("sight", tier))
        found[f"visible_{tier}"] = _percent(c.share("visibility", tier, "false", "pairs"))
        found[f"motion_{tier}"] = length(c.most("motion", tier, "off_most"))
    for tier in ("fast", "balanced"):
        unlike = sum(c.total("basins", tier, key) for key in ("missed", "false", "unlike"))
        found[f"basins_{tier}"] = _count(unlike)
    for name in ("ledges", "basins"):
        found[name] = f"{c.total(name, 'balanced', name):,.0f}"
    found["ledges_missed_fast"] = _count(c.total("ledges", "fast", "missed"))
    found["ledges_missed"] = _count(c.total("ledges", "balanced", "missed"))
    found["sliver"] = _length(c.most("ledges", "balanced", "wrong_longest"))
    pairs, false = (c.total("visibility", "balanced", key) for key in ("pairs", "false"))
    found["visible_more"] = _percent(false / ((pairs + false) or 1))
    moved = c.most("geometry", "fast", "moved_most")
    sizes = {
        name: [c.figure(name, tier, "bytes") or 1 for tier in ("fast", "balanced")] for name in ("geometry", "build")
    }
    file = GRID.strip().format(
        moved=length(moved),
        geometry_bytes=_percent(sizes["geometry"][0] / sizes["geometry"][1]),
        file_bytes=_percent(sizes["build"][0] / sizes["build"][1]),
    )
    return found | {
        "lost": f"{c.total('visibility', 'fast', 'missed_in_file'):,.0f}",
        "segments": f"{c.total('visibility', 'balanced', 'segments'):,.0f}",
        "motion_longest": duration(c.figure("motion", "exact", "seconds", max)),
        "widest": length(c.most("motion", "exact", "widest")),
        "build_longest": duration(c.figure("build", "balanced", "seconds", max)),
        "file": file if moved else NO_GRID,
    }


def _table(c: Corpus) -> Iterator[str]:
    """Every pass at every tier, over the levels."""
    yield "| pass | tier | levels | time | memory | bytes | error |"
    yield "|---|---|---|---|---|---|---|"
    for name in PASSES:
        for tier in TIERS:
            if not c.count(name, tier):
                continue
            late = c.left_out(name, tier)
            levels = f"{c.count(name, tier)}" + (f" ({late} took too long)" if late else "")
            size = c.figure(name, tier, "bytes")
            ratio = c.ratio(name, tier, "balanced")
            beside = "-" if math.isnan(ratio) else f"{ratio:.2f}" if ratio < 10 else f"{ratio:,.0f}"
            yield (
                f"| {name} | {tier} | {levels} | {beside} "
                f"| {c.figure(name, tier, 'memory', max) / 1e6:.1f} MB | {f'{size:,.0f}' if size else '-'} "
                f"| {'-' if tier == 'exact' else _error(c, name, tier)} |"
            )


def _error(c: Corpus, name: str, tier: str) -> str:
    """The error of one pass over all levels."""

    def total(key: str) -> str:
        return f"{c.total(name, tier, key):,.0f}"

    def most(key: str) -> str:
        return _length(c.most(name, tier, key))

    match name:
        case "location" | "sight" | "drop":
            edges = f"{total('wrong_at_edges')} of {total('asked_at_edges')} at edges"
            depth = f"; depth off by up to {most('depth_most')}" if c.most(name, tier, "depth_most") else ""
            return f"{total('wrong')} of {total('asked')} wrong, {edges}{depth}"
        case "visibility":
            return f"{total('false')} false pairs beside {total('pairs')}, {total('missed')} missed"
        case "ledges":
            share = _percent(c.share(name, tier, "wrong_length", "length"))
            return (
                f"{share} of {total('length')} JKU classed otherwise, at most {most('wrong_longest')} in one piece; "
                f"{total('missed')} of {total('ledges')} missed, {total('false')} false; depth off by up to "
                f"{most('depth_most')}"
            )
        case "basins":
            return (
                f"{total('missed')} of {total('basins')} missed, {total('false')} false, {total('unlike')} told "
                f"otherwise; depth off by up to {most('depth_most')}"
            )
        case "motion":
            return f"up to {most('off_most')}; {total('outside')} of {total('stops')} are what no frame rate gives"
        case "geometry":
            return f"vertices moved by up to {most('moved_most')}"
        case _:
            return "-"


def _by_level(figures: Figures) -> Iterator[str]:
    """What `exact` costs and brings, level by level."""
    for name, each in sorted(figures.items(), key=lambda item: (item[1]["level"]["surfaces"], item[0])):
        pairs = each.get("visibility", {}).get("balanced", {}).get("measures")
        sizes = [each.get("build", {}).get(tier, {}).get("bytes") for tier in ("fast", "balanced")]
        cells = [
            *(_seconds(each.get(part, {}), tier) for part, tier in COSTS),
            _percent(pairs["false"] / pairs["pairs"]) if pairs else "not known",
            *(f"{size / each['level']['bytes']:.2f}" if size else "-" for size in sizes),
        ]
        yield f"| {name} | {each['level']['surfaces']} | " + " | ".join(cells) + " |"


def _seconds(held: dict[str, Any], tier: str) -> str:
    if "nothing" in held:
        return "-"
    cell = held.get(tier, {})
    if "seconds" not in cell:
        return cell.get("not_measured", "not measured")
    return duration(cell["seconds"])


def _wrapped(text: str) -> Iterator[str]:
    """Paragraphs and items filled anew, since numbers are longer or shorter than their names."""
    whole: list[str] = []
    for line in [*text.splitlines(), ""]:
        begins = line.startswith(("- ", "#", "!", "|")) or not line.strip()
        if begins and whole:
            hang = "  " if whole[0].startswith("- ") else ""
            yield from textwrap.wrap(
                " ".join(whole), WIDTH, subsequent_indent=hang, break_long_words=False, break_on_hyphens=False
            )
            whole = []
        if begins and not line.startswith("- "):
            yield line
        else:
            whole.append(line.strip())


def _length(value: float) -> str:
    return length(value) if value > ROUNDING else "0 JKU"


def _times(ratio: float) -> str:
    if math.isnan(ratio):
        return "-"
    return f"{ratio:.2g} times" if ratio < 10 else f"{ratio:,.0f} times"


def _count(value: float) -> str:
    return f"{value:,.0f}" if value else "none"


def _percent(share: float) -> str:
    return "0 %" if share < ROUNDING else f"{100 * share:.2g} %" if share < 0.1 else f"{100 * share:.0f} %"
