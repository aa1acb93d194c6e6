"""Measurements as text and as JSON."""

from __future__ import annotations

import hashlib
import io
import os
import platform
from collections.abc import Iterator, Sequence
from typing import Any

import msgspec

from jktools import __version__
from jktools.model import Level
from jktools.tradeoff.measure import Cell, Plan, Row

VERSION = 1
"""Of the shape of the JSON; grows when a reader would have to change."""
WIDTH = 100
"""Columns of the table where there is no terminal."""


def to_json(level: Level, plan: Plan, rows: Sequence[Row]) -> str:
    """Everything that was measured; its shape is docs/tradeoff.schema.json."""
    report = {
        "version": VERSION,
        "tool": {"name": "jktools", "version": __version__},
        "level": {
            "path": level.path,
            "sha256": hashlib.sha256(level.source.data).hexdigest(),
            "bytes": len(level.source.data),
            "sectors": len(level.sectors),
            "surfaces": len(level.surfaces),
            "things": len(level.things),
        },
        "settings": {
            "game": level.game,
            "engine": str(plan.asked.engine),
            "queries": plan.asked.queries,
            "seed": plan.asked.seed,
            "time_limit": plan.time_limit,
        },
        "machine": {"system": platform.system(), "machine": platform.machine(), "cores": os.cpu_count()},
        "passes": [_row(row) for row in rows],
    }
    return msgspec.json.format(msgspec.json.encode(report), indent=2).decode() + "\n"


def _row(row: Row) -> dict[str, Any]:
    return {
        "name": row.found.name,
        "measure": row.found.measure or None,
        "nothing": row.nothing or None,
        "tiers": [] if row.nothing else [cell_of(cell) for cell in row.cells],
    }


def cell_of(cell: Cell) -> dict[str, Any]:
    """One cell as it stands in JSON."""
    measured = bool(cell.seconds) and not cell.not_measured
    took = cell.seconds
    error = cell.error
    return {
        "tier": cell.tier,
        "seconds": {"median": cell.median, "least": min(took), "most": max(took), "runs": len(took)}
        if measured
        else None,
        "seconds_at_edges": cell.seconds_at_edges,
        "memory": None if cell.memory is None or not measured else cell.memory._asdict(),
        "bytes": cell.bytes,
        "error": None if error is None else {"worst": error.worst, "text": error.text, "measures": error.measures},
        "no_error": cell.no_error or None,
        "not_measured": cell.not_measured or None,
    }


def to_table(level: Level, plan: Plan, rows: Sequence[Row], *, width: int = WIDTH) -> str:
    """Lay the measurements out for reading."""
    # rich takes a tenth of a second to import: only who prints a table pays for it.
    from rich.console import Console  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="")
    table.add_column("pass", no_wrap=True)
    table.add_column("tier", no_wrap=True)
    for name in ("time", "memory", "bytes"):
        table.add_column(name, no_wrap=True, justify="right")
    table.add_column("error against exact")
    for row in rows:
        for i, cells in enumerate(_lines(row)):
            table.add_row(row.found.name if i == 0 else "", *(Text(text) for text in cells))
    out = io.StringIO()
    console = Console(file=out, width=width, highlight=False)
    console.print(Text(heading(level, plan)))
    console.print()
    console.print(table)
    console.print()
    for line in legend(plan):
        console.print(Text(line))
    return "\n".join(line.rstrip() for line in out.getvalue().splitlines()) + "\n"


def heading(level: Level, plan: Plan) -> str:
    """What was measured, in one line."""
    return (
        f"{level.path}: {len(level.sectors)} sectors, {len(level.surfaces)} surfaces, {len(level.things)} things; "
        f"engine {plan.asked.engine}"
    )


def legend(plan: Plan) -> Iterator[str]:
    """What the columns mean."""
    asked = [name for name in ("location", "sight", "drop") if name in plan.passes]
    if asked:
        names = ", ".join(asked[:-1]) + " and " + asked[-1] if len(asked) > 1 else asked[0]
        each = " each" if len(asked) > 1 else ""
        yield (
            f"{names}: {plan.asked.queries:,} queries{each}, seed {plan.asked.seed}; a quarter is aimed at edges and "
            "not part of the time"
        )
    yield "time: processor time, the median; memory: what the computation adds to its process at most"


def _lines(row: Row) -> Iterator[tuple[str, str, str, str, str]]:
    if row.nothing:
        yield ("-", "", "", "", f"nothing to do: {row.nothing}")
        return
    for cell in row.cells:
        if cell.not_measured:
            yield (cell.tier, "-", "-", "-", f"not measured: {cell.not_measured}")
            continue
        if cell.error is not None:
            said = "-" if cell.tier == "exact" else cell.error.text
        else:
            said = f"not known: {cell.no_error}" if cell.no_error else "-"
        memory = "-" if cell.memory is None else f"{cell.memory.added / 1e6:.1f} MB"
        size = "-" if cell.bytes is None else f"{cell.bytes:,}"
        yield (cell.tier, duration(cell.median), memory, size, said)


def duration(seconds: float) -> str:
    """A time for reading: three digits."""
    for unit, name in ((1.0, "s"), (1e-3, "ms")):
        if seconds >= 0.9995 * unit:
            return f"{_three(seconds / unit)} {name}"
    return f"{_three(seconds * 1e6)} µs"


def _three(value: float) -> str:
    return f"{value:.3g}" if value < 999.5 else f"{value:.0f}"
