"""The plain lists: sounds, materials, models and the like."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from jktools.diagnostics import Severity
from jktools.diagnostics.wording import miscounted
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context
from jktools.syntax.jkl.document import Heading, NameList
from jktools.syntax.jkl.records import Record
from jktools.syntax.lines import END, SECTION
from jktools.syntax.rows import Rows


@dataclass(frozen=True, slots=True)
class ListSection:
    """How one plain list is written, and what the engine does with entries beyond the announced number."""

    key: str
    heading: str
    kind: str
    record: Record = records.ENTRY
    refuses_surplus: bool = False


SECTIONS: Mapping[str, ListSection] = MappingProxyType(
    {
        "sounds": ListSection("sounds", "world sounds", "sound", records.SOUND),
        "materials": ListSection("materials", "world materials", "material", records.MATERIAL, refuses_surplus=True),
        "aiclass": ListSection("aiclasses", "world aiclasses", "aiclass"),
        "models": ListSection("models", "world models", "model"),
        "sprites": ListSection("sprites", "world sprites", "sprite"),
        "keyframes": ListSection("keyframes", "world keyframes", "keyframe"),
        "animclass": ListSection("animclasses", "world puppets", "puppet"),
        "soundclass": ListSection("soundclasses", "world soundclasses", "soundclass"),
        "cogscripts": ListSection("cogscripts", "world scripts", "script"),
    }
)
"""By section name, in lower case."""

COLORMAPS = ListSection("colormaps", "world colormaps", "colormap", refuses_surplus=True)
"""Stands at the head of GEORESOURCE."""


def read_list(context: Context, section: ListSection) -> NameList:
    """Read a list section behind its `section:` line."""
    heading = context.heading(section.heading)
    rows = read_until_end(context, section.record, section.kind, heading)
    return name_list(context, section, heading, rows)


def read_until_end(context: Context, record: Record, kind: str, heading: Heading | None) -> Rows:
    """Read records up to `end`; a section that lacks it is told of and ends where the next begins.

    A list that announces no entry needs no `end`: the engine's list parsers return at once.
    """
    first = context.at
    rows = context.rows(record, kind, context.block(SECTION | END, blank=False))
    if context.at_end_word():
        context.at += 1
    elif (len(rows) or not context.done) and not (heading is not None and heading.count == 0):
        context.fault(
            faults.MISSING_END, max(first - 1, context.at - 1),
            f'the list of {kind}s has no "end"' + ("" if context.done else ", but the engine reads it up to one"),
            'put a line "end" behind the last entry',
            severity=Severity.WARNING if context.done else None,
        )  # fmt: skip
    return rows


def name_list(context: Context, section: ListSection, heading: Heading | None, rows: Rows) -> NameList:
    """Make the table, and tell of entries beyond the announced number."""
    if heading is not None and len(rows) > heading.count:
        effect = "refuses the level" if section.refuses_surplus else "drops the rest"
        context.fault(
            faults.COUNT_MISMATCH, int(rows.lines[heading.count]),
            f"{miscounted(heading.count, f'{section.kind}s', len(rows))}; the engine {effect}",
            f'write at least {len(rows)} behind "{section.heading}"',
            severity=None if section.refuses_surplus else Severity.WARNING,
        )  # fmt: skip
    return NameList(heading, rows.line_column(), rows.broken(), rows.word_column("name"))
