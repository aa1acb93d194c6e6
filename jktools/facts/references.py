"""The files that a level names, each with the place that names it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

from jktools.diagnostics import Subject
from jktools.model import Level
from jktools.model.resources import Kind
from jktools.source import Span
from jktools.syntax.jkl import Parameters, Table, records
from jktools.syntax.template.parameters import PARAMETERS, Refers

NONE = "none"
"""A name that means no file."""

LISTS: Mapping[str, Kind] = MappingProxyType(
    {
        "sounds": Kind.SOUND,
        "materials": Kind.MATERIAL,
        "colormaps": Kind.COLORMAP,
        "aiclasses": Kind.AI_CLASS,
        "models": Kind.MODEL,
        "sprites": Kind.SPRITE,
        "keyframes": Kind.KEYFRAME,
        "animclasses": Kind.PUPPET,
        "soundclasses": Kind.SOUND_CLASS,
        "cogscripts": Kind.COG,
    }
)
"""The lists of a level and what they name."""

PARAMETER_KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        key: Kind[use.refers.name]
        for key, parameter in PARAMETERS.items()
        for use in parameter.uses
        if use.refers not in (None, Refers.TEMPLATE) and use.refers is not None
    }
)
"""The parameters of templates and things that name a file."""


@dataclass(frozen=True, slots=True)
class FileReference:
    """One name of a file in a level."""

    kind: Kind
    name: str
    """As written."""
    where: str
    """`list`, `sector`, `template`, `thing`, `cog` or `value`: what names it."""
    subject: Subject
    _place: Callable[[], Span]

    @property
    def place(self) -> Span:
        """Where it stands; found when it is asked for."""
        return self._place()


def file_references(level: Level) -> Iterator[FileReference]:
    """Every name of a file: lists, sector sounds, parameters, placed COGs and their values. `none` names nothing.

    A COG's value counts by its extension, for which symbol it stands: what a script of the game calls it may not be
    at hand.
    """
    for reference in _all(level):
        if reference.name.lower() != NONE:
            yield reference


def _all(level: Level) -> Iterator[FileReference]:
    document = level.document
    for key, kind in LISTS.items():
        table = document.lists[key]
        for i, name in enumerate(table.names):
            if not table.broken[i]:
                yield _reference(level, kind, name, "list", Subject(kind.title, i, name), int(table.lines[i]))
    for i, sound in enumerate(document.sectors.sound):
        if sound is not None:
            line = int(document.sectors.line_of["sector_sound"][i])
            yield _reference(level, Kind.SOUND, sound, "sector", Subject("sector", i), line)
    yield from _parameters(level, "template", document.templates, document.templates.parameters)
    yield from _parameters(level, "thing", document.things, document.things.parameters)
    cogs = document.cogs
    for i, script in enumerate(cogs.scripts):
        line, subject = int(cogs.lines[i]), Subject("cog", i, script)
        if cogs.broken[i]:
            continue
        yield _reference(level, Kind.COG, script, "cog", subject, line)
        for at in range(cogs.value_start[i], cogs.value_start[i + 1]):
            value = cogs.values[at]
            of_value = Kind.of_extension(value.rpartition(".")[2]) if "." in value else None
            if of_value is not None:
                ordinal = len(records.COG.fields) + at - int(cogs.value_start[i])
                yield _reference(level, of_value, value, "value", subject, line, ordinal)


def _parameters(level: Level, where: str, table: Table, words: Parameters) -> Iterator[FileReference]:
    for i, (first, last) in enumerate(pairwise(words.start.tolist())):
        for at in range(first, last):
            kind = PARAMETER_KINDS.get(words.keys[at].lower())
            if kind is not None and not table.broken[i]:
                yield _reference(level, kind, words.values[at], where, Subject(where, i), int(table.lines[i]))


def _reference(
    level: Level, kind: Kind, name: str, where: str, subject: Subject, line: int, ordinal: int | None = None
) -> FileReference:
    def place() -> Span:
        document = level.document
        if ordinal is not None:
            return document.field_span(records.COG, line, ordinal)
        at = document.lines.text(line).rfind(name)
        return document.lines.part(line, at, at + len(name)) if name and at >= 0 else document.lines.span(line)

    return FileReference(kind, name, where, subject, place)
