"""COGS, TEMPLATES and THINGS: records with a tail of words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from jktools.diagnostics import Severity
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context
from jktools.syntax.jkl.document import Cogs, Parameters, Templates, Things
from jktools.syntax.jkl.lists import read_until_end
from jktools.syntax.jkl.rows import Rows, ints


class _Words:
    """Parameters of many records, cut by `start`."""

    def __init__(self) -> None:
        self.start = [0]
        self.words: list[str] = []

    def add(self, words: Sequence[str]) -> None:
        self.words.extend(map(str, words))
        self.start.append(len(self.words))

    def parameters(self) -> Parameters:
        pairs = [split_parameter(word) for word in self.words]
        return Parameters(
            np.array(self.start, np.int32), tuple(key for key, _ in pairs), tuple(value for _, value in pairs)
        )


def split_parameter(word: str) -> tuple[str, str]:
    """Key and value at the first `=`; a word without one is both (stdConffile in the decompiled engine)."""
    key, sign, value = word.partition("=")
    return (key, value) if sign else (word, word)


def read_cogs(context: Context) -> Cogs:
    """Read the section behind its `section:` line."""
    heading = context.heading("world cogs")
    rows = Rows(records.COG)
    read_until_end(context, rows, "cog")
    values = _Words()
    for row in rows.fields:
        values.add(row[len(records.COG.fields) :])
    return Cogs(
        heading,
        rows.line_column(),
        rows.broken(),
        rows.word_column("script"),
        np.array(values.start, np.int32),
        tuple(values.words),
    )


def read_templates(context: Context) -> Templates:
    """Read the section behind its `section:` line."""
    heading = context.heading("world templates")
    rows = Rows(records.TEMPLATE)
    read_until_end(context, rows, "template")
    words = _Words()
    for row in rows.fields:
        words.add(row[len(records.TEMPLATE.fields) :])
    if heading is not None and len(rows) > heading.count:
        context.fault(
            faults.COUNT_MISMATCH, rows.lines[heading.count],
            f"the heading announces {heading.count} templates, but {len(rows)} follow; the engine drops the rest",
            f'write at least {len(rows)} behind "world templates"', severity=Severity.WARNING,
        )  # fmt: skip
    return Templates(
        heading,
        rows.line_column(),
        rows.broken(),
        rows.word_column("name"),
        rows.word_column("parent"),
        words.parameters(),
    )


def read_things(context: Context) -> Things:
    """Read the section behind its `section:` line."""
    heading = context.heading("world things")
    rows = Rows(records.THING)
    read_until_end(context, rows, "thing")
    words = _Words()
    arch: list[str] = []
    for row in rows.fields:
        tail = list(row[len(records.THING.fields) :])
        # Mysteries of the Sith: the field behind the sector is an index when it has no '='.
        arch.append(str(tail.pop(0)) if tail and "=" not in tail[0] and _is_index(tail[0]) else "-1")
        words.add(tail)
    table = Things(
        heading,
        rows.line_column(),
        rows.broken(),
        number=rows.label_column(),
        templates=rows.word_column("template"),
        names=rows.word_column("name"),
        position=rows.float_columns("x", 3),
        angles=rows.float_columns("pitch", 3),
        sector=rows.int_column("sector"),
        arch_light=np.array(ints(arch)[0], np.int32),
        parameters=words.parameters(),
    )
    context.outside(rows, "thing")
    return table


def _is_index(word: str) -> bool:
    return word.lstrip("+-").isdigit()
