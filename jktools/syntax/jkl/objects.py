"""COGS, TEMPLATES and THINGS: records with a tail of words."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from jktools.diagnostics import Severity
from jktools.diagnostics.wording import miscounted
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context
from jktools.syntax.jkl.document import Cogs, Heading, Int32, Parameters, Templates, Things
from jktools.syntax.jkl.lists import read_until_end
from jktools.syntax.lines import BLANK
from jktools.syntax.rows import Rows, ints
from jktools.syntax.template.records import split_parameter


def _parameters(start: Int32, words: Sequence[str]) -> Parameters:
    pairs = [split_parameter(word) for word in words]
    return Parameters(start, tuple(key for key, _ in pairs), tuple(value for _, value in pairs))


def read_cogs(context: Context) -> Cogs:
    """Read the section behind its `section:` line."""
    heading = context.heading("world cogs")
    rows = read_until_end(context, records.COG, "cog", heading)
    start, values = rows.tails()
    return Cogs(heading, rows.line_column(), rows.broken(), rows.word_column("script"), start, tuple(values))


def read_templates(context: Context) -> Templates:
    """Read the section behind its `section:` line."""
    heading = context.heading("world templates")
    rows = read_until_end(context, records.TEMPLATE, "template", heading)
    if heading is not None and len(rows) > heading.count:
        context.fault(
            faults.COUNT_MISMATCH, int(rows.lines[heading.count]),
            f"{miscounted(heading.count, 'templates', len(rows))}; the engine drops the rest",
            f'write at least {len(rows)} behind "world templates"', severity=Severity.WARNING,
        )  # fmt: skip
    return _templates(heading, rows)


def read_template_lines(context: Context) -> Templates:
    """Read templates up to the end of the file, where no heading and no `end` stand about them."""
    lines = np.arange(context.at, len(context.lines))
    context.at = len(context.lines)
    return _templates(None, context.rows(records.TEMPLATE, "template", lines[context.lines.kinds[lines] & BLANK == 0]))


def _templates(heading: Heading | None, rows: Rows) -> Templates:
    return Templates(
        heading,
        rows.line_column(),
        rows.broken(),
        rows.word_column("name"),
        rows.word_column("parent"),
        _parameters(*rows.tails()),
    )


def read_things(context: Context) -> Things:
    """Read the section behind its `section:` line."""
    heading = context.heading("world things")
    rows = read_until_end(context, records.THING, "thing", heading)
    start, words = rows.tails()
    # Mysteries of the Sith: the field behind the sector is an index when it has no '='.
    first = [words[a] if a < b else "" for a, b in pairwise(start.tolist())]
    has_arch = np.array([_is_index(word) for word in first], np.bool_)
    kept = np.ones(len(words), np.bool_)
    kept[start[:-1][has_arch]] = False
    without = start - np.concatenate([[0], np.cumsum(has_arch)]).astype(np.int32)
    table = Things(
        heading,
        rows.line_column(),
        rows.broken(),
        number=rows.int_column("label"),
        templates=rows.word_column("template"),
        names=rows.word_column("name"),
        position=rows.float_columns("x", 3),
        angles=rows.float_columns("pitch", 3),
        sector=rows.int_column("sector"),
        arch_light=np.array(ints([w if _is_index(w) else "-1" for w in first])[0], np.int32),
        parameters=_parameters(without, [word for word, keep in zip(words, kept.tolist(), strict=True) if keep]),
    )
    context.outside(rows, "thing")
    return table


def _is_index(word: str) -> bool:
    return word.removeprefix("-").isdecimal()
