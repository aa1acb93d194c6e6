"""JK013: flags that look decimal but are read as hexadecimal."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.source import Span
from jktools.syntax.jkl import Document, Table, records
from jktools.syntax.jkl.records import Kind, Record
from jktools.syntax.template.parameters import FLAG_KEYS

_DECIMAL = re.compile(r"[1-9]\d+")
_HEXADECIMAL = re.compile(r"\d*[a-f][0-9a-f]*", re.IGNORECASE)


@rule("JK013", "flags-without-prefix", severity=Severity.WARNING, since="0.1.0")
def flags_without_prefix(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report flags of two or more decimal digits without `0x`.

    ## Why it matters
    The engine reads flags as hexadecimal whether `0x` stands before them or not: `16` is 0x16, not 0x10. Every known
    editor writes the `0x`, so that a number without it was mostly typed by hand and meant as decimal.

    A level that also has bare flags with the letters a to f is taken to mean hexadecimal throughout.

    ## Bad
        World adjoins 2
        0: 16 1 1

    ## Bad
        World templates 4
        lamp none type=cog thingflags=1024

    ## Good
        World adjoins 2
        0: 0x10 1 1

    ## Good
        World adjoins 2
        0: 7 1 1
    """
    bare = list(_bare_flags(level.document))
    if any(_HEXADECIMAL.fullmatch(flags.text) for flags in bare):
        return
    for flags in bare:
        if _DECIMAL.fullmatch(flags.text):
            yield Finding(
                Label(flags.place),
                f"the {flags.field} of {flags.subject.kind} {flags.subject.index} are written {flags.text}, but the "
                f"engine reads 0x{flags.text}",
                f"write 0x{int(flags.text):x} if the number is decimal, 0x{flags.text} if it is not",
                flags.subject,
            )


class _Bare(NamedTuple):
    """Flags without 0x."""

    text: str
    field: str
    subject: Subject
    place: Span


def _bare_flags(document: Document) -> Iterator[_Bare]:
    yield from _fields(document, "adjoin", document.adjoins, records.ADJOIN)
    yield from _fields(document, "surface", document.surfaces, records.SURFACE)
    flags = records.SECTOR_LINES["flags"]
    for i, line in enumerate(document.sectors.line_of["flags"].tolist()):
        words = document.lines.text(line).split() if line >= 0 else []
        if len(words) > 1 and not words[1].lower().startswith("0x"):
            yield _Bare(words[1], "flags", Subject("sector", i), document.field_span(flags, line, 0))
    yield from _parameters(document, "template", document.templates.lines.tolist())
    yield from _parameters(document, "thing", document.things.lines.tolist())


def _fields(document: Document, kind: str, table: Table, record: Record) -> Iterator[_Bare]:
    flags = [(i, field.name) for i, field in enumerate(record.fields) if field.kind is Kind.HEX]
    for index, line in enumerate(table.lines.tolist()):
        words = record.words(document.lines.text(line)).split(maxsplit=flags[-1][0] + 1)
        for ordinal, name in flags:
            if ordinal < len(words) and not words[ordinal].lower().startswith("0x"):
                yield _Bare(
                    words[ordinal], name, Subject(kind, index), document.field_span(record, line, ordinal)
                )  # fmt: skip


def _parameters(document: Document, kind: str, lines: list[int]) -> Iterator[_Bare]:
    for index, line in enumerate(lines):
        text = document.lines.text(line)
        for found in re.finditer(r"(?<![^\s,])(\w+)=([^\s,]+)", text):
            key, value = found.groups()
            if key.lower() in FLAG_KEYS and not value.lower().startswith("0x"):
                yield _Bare(value, key, Subject(kind, index), document.lines.part(line, *found.span(2)))
