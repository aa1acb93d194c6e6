"""JK014: a label that is not the record's position."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.syntax.jkl import Document, Table


@rule("JK014", "label-out-of-place", severity=Severity.INFO, since="0.1.0")
def label_out_of_place(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report the first record of a table whose label is not its position.

    ## Why it matters
    The engine ignores labels and counts records, so that everything that goes by the label names another record than
    it seems to. The editor SED refuses a level with such a vertex. Labels of things are their real numbers and are
    not meant here.

    ## Bad
        World vertices 12
        - 3: 0 1 0
        33: 0 1 0

    ## Good
        World vertices 12
        3: 0 1 0
    """
    document = level.document
    for kind, table in _tables(document):
        wrong = [i for i, line in enumerate(table.lines.tolist()) if not _fits(document.lines.text(line), i)]
        if not wrong:
            continue
        first = wrong[0]
        span = level.line_span(int(table.lines[first]))
        label = span.text.split(maxsplit=1)[0].rstrip(":")
        more = f"; {len(wrong) - 1} more {kind} labels differ" if len(wrong) > 1 else ""
        yield Finding(
            Label(span.source.span(span.start, span.start + len(label))),
            f"the {kind} at position {first} is labelled {label}, but the engine counts from 0 and calls it {first}"
            + more,
            "number the records in order",
            Subject(kind, first),
        )


def _tables(document: Document) -> Iterator[tuple[str, Table]]:
    for key, table in document.lists.items():
        if key != "sounds":  # the one list without labels
            yield key.removesuffix("s"), table
    yield "vertex", document.vertices
    yield "texture vertex", document.texture_vertices
    yield "adjoin", document.adjoins
    yield "surface", document.surfaces
    yield "normal", document.normals
    yield "cog", document.cogs


def _fits(text: str, position: int) -> bool:
    """Whether a line starts with its position; one without a label is left to loosely-read-record."""
    if text.startswith(f"{position}:"):
        return True
    label = re.match(r"\s*([-+]?\d+):", text)
    return label is None or int(label.group(1)) == position
