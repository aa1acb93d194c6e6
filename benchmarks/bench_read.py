"""Reading lop_sabers.jkl (1.7 MB): MB/s of the grammar alone, the native records, the whole load and a plain loop.

The four are interleaved so that a machine that drifts hits them alike; medians of their runs.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from functools import cache

import pytest

from jktools._native_text import read_fields, read_sectors, read_surfaces  # noqa: TID251 (measured alone)
from jktools.model import Level
from jktools.source import Member, Source, resolve
from jktools.syntax.jkl import read, records
from jktools.syntax.lines import END, SECTION, WORLD, LogicalLines
from tests.support.levels import CORPUS

LEVEL = CORPUS / "gob/masspack.gob"
RUNS = {"grammar alone": 1, "native records": 15, "jktools.load": 15, "plain loop": 15}
ROUNDS = 3


@cache
def member() -> Member:
    found = resolve(f"{LEVEL}!jkl/lop_sabers.jkl")
    assert isinstance(found, Member)
    return found


def whole_load() -> int:
    source = member().read()
    return len(Level(read(source)).vertices) and len(source.data)


def grammar_alone() -> int:
    source = member().read()
    read(source, strict_grammar=True)
    return len(source.data)


def plain_loop() -> int:
    """Every field of every line as a number where it is one: the least that any Python reader does."""
    text = str(member().read().data, "latin-1")
    rows = []
    for line in text.split("\n"):
        if line[:1] in "#;":
            continue
        row: list[float | str] = []
        for word in line.replace(",", " ").split():
            try:
                row.append(float(word))
            except ValueError:
                row.append(word)
        rows.append(row)
    assert rows
    return len(text)


@cache
def tables() -> tuple[LogicalLines, list[tuple[Callable[..., object], slice, tuple[object, ...]]], int]:
    """The large tables: their reader, their lines, its arguments; and how many bytes they have."""
    lines = LogicalLines(Source("x", bytes(member().read().data)), "jk")
    wanted: list[tuple[Callable[..., object], slice, tuple[object, ...]]] = []
    size = 0
    for heading, record in (
        ("world vertices", records.VERTEX), ("world texture vertices", records.TEXTURE_VERTEX),
        ("world adjoins", records.ADJOIN), ("world surfaces", records.SURFACE), ("world sectors", None),
    ):  # fmt: skip
        first = next(i for i in range(len(lines)) if lines.text(i).lower().startswith(heading)) + 1
        part = slice(first, lines.next_of(SECTION | WORLD | END, first))
        size += int(lines.end[part.stop - 1] - lines.start[part.start])
        if record is None:
            wanted.append((read_sectors, slice(lines.next_sector(first), part.stop), ()))
        elif record is records.SURFACE:
            counts = lines.word_counts(range(part.start, part.stop))  # type: ignore[arg-type]
            end = part.start + int((counts < len(record.fields)).argmax())
            wanted.append((read_surfaces, slice(part.start, end), ()))
            wanted.append((read_fields, slice(end, part.stop), (records.NORMAL.form, False)))
        else:
            wanted.append((read_fields, part, (record.form, not record.scanned)))
    return lines, wanted, size


def native_records() -> int:
    lines, wanted, size = tables()
    for reader, part, arguments in wanted:
        reader(lines.octets, lines.start[part], lines.end[part], *arguments)
    return size


def test_reading() -> None:
    if not LEVEL.exists():
        pytest.skip("the corpus of real mods is not at hand")
    ways = {
        "grammar alone": grammar_alone, "native records": native_records, "jktools.load": whole_load,
        "plain loop": plain_loop,
    }  # fmt: skip
    for way in ("native records", "jktools.load", "plain loop"):
        ways[way]()
    speeds: dict[str, list[float]] = {way: [] for way in ways}
    for _ in range(ROUNDS):
        for way, run in ways.items():
            for _ in range(RUNS[way]):
                started = time.perf_counter()
                size = run()
                speeds[way].append(size / (time.perf_counter() - started) / 1e6)
    plain = statistics.median(speeds["plain loop"])
    print(f"\n{'reading lop_sabers.jkl':<28}{'MB/s':>10}{'of the plain loop':>20}")
    for way, measured in speeds.items():
        median = statistics.median(measured)
        print(f"{way:<28}{median:>10.1f}{median / plain:>19.2f}x")
