"""Time against error, one panel a pass."""

from __future__ import annotations

import io
import math
import statistics
from collections.abc import Sequence
from typing import Any

from jktools.tradeoff.errors import ROUNDING
from jktools.tradeoff.measure import Row

COLOURS = {"fast": "#d95f02", "balanced": "#1b9e77", "exact": "#7570b3"}
MARKERS = {"fast": "o", "balanced": "s", "exact": "D"}
FORMATS = ("png", "svg")
COLUMNS = 4
LEAST_SPAN = 100.0
"""Between the ends of the axis of time: less would show noise."""

Point = tuple[str, float, float]
"""Tier, seconds, error."""


def points_of(row: Row) -> list[Point]:
    """The cells whose time and error are known; a coarse clock may have seen no time pass."""
    return [
        (c.tier, max(c.median, 1e-9), c.error.worst) for c in row.cells if c.error is not None and not c.not_measured
    ]


def to_plot(rows: Sequence[Row], title: str, suffix: str) -> bytes:
    """Draw the passes that have an error as PNG or SVG: down and left is better.

    Needs matplotlib (extra `plot`); raises ModuleNotFoundError without it. The bytes depend on its version only.
    """
    panels = [(row.found.name, row.found.measure, points_of(row)) for row in rows if points_of(row)]
    return draw(panels, title, suffix)


def draw(panels: Sequence[tuple[str, str, Sequence[Point]]], title: str, suffix: str) -> bytes:
    """Draw panels of points; several points of one tier are as many levels.

    Their mean, geometric in time, is drawn large.
    """
    # matplotlib takes half a second to import and is an extra: only who draws pays for it.
    import matplotlib as mpl  # noqa: PLC0415
    from matplotlib.figure import Figure  # noqa: PLC0415

    columns = max(1, min(COLUMNS, len(panels)))
    lines = max(1, math.ceil(len(panels) / columns))
    with mpl.rc_context({"svg.hashsalt": "jktools", "svg.fonttype": "none", "font.size": 9}):
        figure = Figure(figsize=(3.1 * columns, 2.9 * lines + 0.5), dpi=100, layout="constrained")
        figure.suptitle(title)
        for i, (name, measure, points) in enumerate(panels):
            _panel(figure.add_subplot(lines, columns, i + 1), name, measure, points)
        handles = {h.get_label(): h for axes in figure.axes for h in axes.get_legend_handles_labels()[0]}
        tiers = [tier for tier in COLOURS if tier in handles]
        figure.legend([handles[t] for t in tiers], tiers, loc="outside lower center", ncols=3, frameon=False)
        data = io.BytesIO()
        metadata = {"Date": None} if suffix == "svg" else {"Software": None}
        figure.savefig(data, format=suffix, metadata=metadata)
    return data.getvalue()


def _panel(axes: Any, name: str, measure: str, points: Sequence[Point]) -> None:
    axes.set_title(name, fontsize=10)
    axes.set_xscale("log")
    axes.set_xlabel("seconds", fontsize=8)
    axes.set_ylabel("\n".join(_wrapped(measure, 30)), fontsize=8)
    positive = [error for _, _, error in points if error > ROUNDING]
    floor = 10.0 ** (math.floor(math.log10(min(positive))) - 1) if positive else 1e-3
    axes.set_yscale("log")
    top = 10 * max(positive, default=10 * floor)
    axes.set_ylim(floor / 2, top)
    axes.axhline(floor, color="#999999", linewidth=0.8, linestyle=":")
    axes.text(
        0.01, floor / 1.9, " no error", fontsize=7, color="#777777", va="bottom", transform=axes.get_yaxis_transform()
    )
    means: list[Point] = []
    for tier in COLOURS:
        own = [(seconds, max(error, floor)) for each, seconds, error in points if each == tier]
        own_errors = [error for each, _, error in points if each == tier]
        if not own:
            continue
        times, errors = zip(*own, strict=True)
        if len(own) > 1:
            axes.plot(times, errors, MARKERS[tier], color=COLOURS[tier], alpha=0.35, markersize=3, markeredgewidth=0)
        means.append((tier, statistics.geometric_mean(times), max(floor, statistics.mean(own_errors))))
    axes.plot([m[1] for m in means], [m[2] for m in means], "-", color="#bbbbbb", linewidth=1, zorder=0)
    for tier, x, y in means:
        axes.plot([x], [y], MARKERS[tier], color=COLOURS[tier], markersize=7, label=tier)
    least, most = min(p[1] for p in points), max(p[1] for p in points)
    wider = max(0.0, math.log10(LEAST_SPAN * least / most)) / 2 + 0.25
    axes.set_xlim(least / 10**wider, most * 10**wider)
    axes.grid(visible=True, alpha=0.25)
    axes.tick_params(labelsize=7)
    axes.minorticks_off()


def _wrapped(text: str, most: int) -> list[str]:
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) > most:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return lines
