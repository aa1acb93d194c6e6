"""JK012: a name longer than the engine's fields."""

from collections.abc import Iterable, Iterator

import numpy as np

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import LevelFacts
from jktools.facts.references import PARAMETER_KINDS
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.source import Span
from jktools.syntax.jkl import Document, Parameters, Table, records
from jktools.syntax.template.parameters import TEMPLATE_KEYS

MOST_CHARACTERS = 31
"""Of a name; the engine keeps names in 32 bytes, one of which ends them (sithWorld.h in the decompiled engine)."""


@rule("JK012", "overlong-name", severity=Severity.ERROR, since="0.1.0")
def overlong_name(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a name of a file, template or thing with more than 31 characters, also in a parameter or a COG's value.

    ## Why it matters
    The engine keeps names in fields of 32 bytes. What is longer is cut off, so that it names something else, or,
    where the engine does not count (the sound of a sector), overwrites memory.

    ## Bad
        World materials 2
        1: a_very_long_name_of_a_material_file.mat 1 1

    ## Bad
        World templates 4
        barrel none type=cog model3d=a_barrel_that_holds_a_lot_of_oil.3do

    ## Bad
        World cogs 1
        0: door.cog 3 -1 a_wind_that_blows_through_every_door.wav

    ## Good
        World materials 2
        1: a_material_name_of_31_chars.mat 1 1
    """
    for kind, index, name, place in _names(level.document):
        if len(name) > MOST_CHARACTERS:
            yield Finding(
                Label(place),
                f'{kind} {index} has the name "{name}" of {len(name)} characters, but the engine keeps '
                f"{MOST_CHARACTERS}",
                "shorten the name",
                Subject(kind, index, name),
            )


Named = Iterator[tuple[str, int, str, Span]]


def _names(document: Document) -> Named:
    for key, table in document.lists.items():
        yield from _column(document, key.removesuffix("s"), table, table.names)
    yield from _column(document, "template", document.templates, document.templates.names)
    yield from _column(document, "thing", document.things, document.things.names)
    yield from _column(document, "cog", document.cogs, document.cogs.scripts)
    yield from _parameters(document, "template", document.templates, document.templates.parameters)
    yield from _parameters(document, "thing", document.things, document.things.parameters)
    sectors = document.sectors
    sounds = [(i, name) for i, name in enumerate(sectors.sound) if name is not None and len(name) > MOST_CHARACTERS]
    for i, name in sounds:
        line = int(sectors.line_of["sector_sound"][i])
        yield "sector", i, name, document.field_span(records.SECTOR_LINES["sector_sound"], line, 0)
    cogs = document.cogs
    owner = [i for i in range(len(cogs)) for _ in range(cogs.value_start[i], cogs.value_start[i + 1])]
    for at, (i, value) in enumerate(zip(owner, cogs.values, strict=True)):
        ordinal = len(records.COG.fields) + at - int(cogs.value_start[i])
        if len(value) > MOST_CHARACTERS:
            yield "cog", i, value, document.field_span(records.COG, int(cogs.lines[i]), ordinal)


def _column(document: Document, kind: str, table: Table, names: Iterable[str]) -> Named:
    for i, name in enumerate(names):
        if len(name) > MOST_CHARACTERS:
            yield kind, i, name, document.lines.span(int(table.lines[i]))


def _parameters(document: Document, kind: str, table: Table, words: Parameters) -> Named:
    for at in [at for at, value in enumerate(words.values) if len(value) > MOST_CHARACTERS]:
        key, value = words.keys[at].lower(), words.values[at]
        if key not in PARAMETER_KINDS and key not in TEMPLATE_KEYS:
            continue
        i = int(np.searchsorted(words.start, at, "right")) - 1
        line = int(table.lines[i])
        found = document.lines.text(line).rfind(value)
        yield kind, i, value, document.lines.part(line, found, found + len(value))
