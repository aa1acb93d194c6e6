"""From a level's bytes to a Document: which section comes next, and what is missing."""

from __future__ import annotations

import re
from collections.abc import Callable
from types import MappingProxyType
from typing import Any

import lark
import numpy as np

from jktools.diagnostics import Subject
from jktools.source import Source, Span
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context, quote
from jktools.syntax.jkl.document import ArchLights, Document, Header, NameList
from jktools.syntax.jkl.editor import read_layers, read_lights
from jktools.syntax.jkl.georesource import GeoResource, read_georesource
from jktools.syntax.jkl.lists import COLORMAPS, SECTIONS, read_list
from jktools.syntax.jkl.objects import read_cogs, read_template_lines, read_templates, read_things
from jktools.syntax.jkl.records import HEADER_LINES
from jktools.syntax.jkl.sectors import read_sectors
from jktools.syntax.lines import SECTION
from jktools.syntax.rows import floats, ints

COPYRIGHT_LINES = 34
"""Lines that the engine takes from COPYRIGHT (sithCopyright_Load)."""

REQUIRED = ("copyright", "header", "georesource", "sectors")
"""Sections without which a level does not load, or has no gravity."""

_BETWEEN_WORDS = b" \t,\r\n"

GEOMETRY = "georesource"
"""A JKL without this section is no level: static.jkl holds only resources and templates."""

TEMPLATES = "templates"


def read(source: Source, game: str = "jk", *, strict_grammar: bool = False) -> Document:
    """Read a JKL as the engine of `game` (`jk` or `mots`) does, and tell what it would not.

    Never raises on bad input: what cannot be read is told in `Document.diagnostics`, keeps its place in its
    table, and the rest of the file is read on. With `strict_grammar` the Lark grammar reads every record, which
    is slow and gives the same document.
    """
    context = Context(source, game, strict_grammar)
    parts: dict[str, Any] = {}
    lists: dict[str, NameList] = {}
    sections: dict[str, int] = {}
    while (name := _next_section(context)) is not None:
        if name in sections:
            first = context.lines.span(sections[name]).first.line
            context.fault(
                faults.REPEATED_SECTION, context.at - 1,
                f'section "{name}" stands here again, but line {first} has it already; the first is kept',
                "join the two sections",
            )  # fmt: skip
            continue
        sections[name] = context.at - 1
        if name in SECTIONS:
            lists[SECTIONS[name].key] = read_list(context, SECTIONS[name])
        elif name in _READERS:
            parts[name] = _READERS[name](context)
    _check_file(context, sections)
    if sections:
        _check_lines(context)
    return _document(context, sections, parts, lists)


def read_library(source: Source, game: str = "jk", *, strict_grammar: bool = False) -> Document:
    """Read a template library of an editor (*.tpl): lines as in TEMPLATES, without a heading, and nothing else.

    The document has the one section `templates`. Never raises on bad input, as `read`. Lines and comments are taken as
    the engine takes those of a level.
    """
    context = Context(source, game, strict_grammar)
    templates = read_template_lines(context)
    return _document(context, {TEMPLATES: 0}, {TEMPLATES: templates}, {})


def _next_section(context: Context) -> str | None:
    """Move behind the next `section:` line and give its name in lower case."""
    while (line := context.lines.next_of(SECTION, context.at)) < len(context.lines):
        context.at = line + 1
        try:
            return str(records.parser().parse(context.lines.text(line), start="section").children[0]).lower()
        except lark.UnexpectedInput:
            context.fault(
                faults.MALFORMED_RECORD, line,
                f"expected the name of a section, but found {quote(context.lines.text(line))}",
                "write a name behind SECTION:",
            )  # fmt: skip
    return None


def _check_lines(context: Context) -> None:
    for line in context.lines.cut_lines():
        context.fault(
            faults.OVERLONG_LINE, line,
            f"the line is longer than {context.lines.buffer_size - 1} bytes, but the engine reads no more at once",
            "break the line; the engine takes its rest for a line of its own",
        )  # fmt: skip
    for line in context.lines.lines_with_comment_in_word():
        number = _number_cut(context, line)
        if number is not None:
            context.fault(
                faults.COMMENT_IN_NUMBER, number,
                f'a # stands in the number "{number.text}", but starts a comment for the engine',
                "write a number; the engine loses the rest of the line",
            )  # fmt: skip


def _number_cut(context: Context, line: int) -> Span | None:
    """The number that a `#` cuts, as `1.#QNAN`; None where the `#` starts an ordinary comment behind a word."""
    data = context.source.data
    hash_ = context.lines.span(line).end
    start, end = hash_, hash_
    while start > 0 and data[start - 1] not in _BETWEEN_WORDS:
        start -= 1
    while end < len(data) and data[end] not in _BETWEEN_WORDS:
        end += 1
    word = context.source.span(start, end)
    return word if re.fullmatch(r"[-+]?\d+\.\d*#[A-Za-z]+\d*", word.text) else None


def _check_file(context: Context, sections: dict[str, int]) -> None:
    source = context.source
    if source.declared != len(source.data):
        context.fault(
            faults.CUT_OFF_FILE, source,
            f"the pack gives the file {source.declared} bytes, but has only {len(source.data)} of them",
            "the pack is cut off; copy it again",
        )  # fmt: skip
    if not sections:
        context.fault(
            faults.MISSING_SECTION, context.source, 'expected a level with "SECTION:" lines, but found none',
            "is this a JKL file?",
        )  # fmt: skip
        return
    if GEOMETRY not in sections and context.source.path.lower().endswith("static.jkl"):
        return
    for name in REQUIRED:
        if name not in sections:
            effect = "falls back to 0 for gravity and the like" if name == "header" else "refuses the level"
            context.fault(
                faults.MISSING_SECTION, context.source, f"the level has no section {name.upper()}; the engine {effect}",
                "add the section",
            )  # fmt: skip


def _read_copyright(context: Context) -> None:
    first = context.at
    while not context.at_section() and context.at - first < COPYRIGHT_LINES:
        context.at += 1
    if context.at - first < COPYRIGHT_LINES:
        context.fault(
            faults.MALFORMED_RECORD, first - 1,
            f"the copyright has {context.at - first} lines, but the engine takes {COPYRIGHT_LINES}",
            "restore the section from another level",
        )  # fmt: skip


def _read_header(context: Context) -> Header:
    order = tuple(HEADER_LINES)
    values: dict[str, Any] = {}
    lines: dict[str, int] = {}
    expected = 0
    while not context.at_section() and not context.at_end_word():
        text = records.keywords(context.text())
        alias = next((a for a in order if text.startswith(HEADER_LINES[a].keyword + " ")), None)
        wanted = order[min(expected, len(order) - 1)]
        if alias is None or alias != wanted:
            context.fault(
                faults.MALFORMED_RECORD if alias is None else faults.LOOSELY_READ_RECORD, context.at,
                f'expected "{HEADER_LINES[wanted].keyword}", but found {quote(context.text())}',
                "write the 11 lines of HEADER in their order; the engine shifts the values otherwise",
            )  # fmt: skip
        expected += 1
        if alias is None:
            context.at += 1
            continue
        expected = order.index(alias) + 1
        lines[alias] = context.at
        fields = context.record(HEADER_LINES[alias], context.at, Subject("header", expected - 1))
        context.at += 1
        if fields is not None:
            values[alias] = fields
    if expected < len(order) and lines:
        context.fault(
            faults.LOOSELY_READ_RECORD, max(lines.values()),
            f'the header ends here, but "{HEADER_LINES[order[expected]].keyword}" should follow',
            "write the 11 lines of HEADER in their order",
        )  # fmt: skip
    version = str(values.pop("version", ["0"])[0])
    (number,), outside = ints([version])
    if outside:
        context.beyond(lines["version"], "header", 0, "version", version)
    decimals = {alias: floats(list(map(str, fields))) for alias, fields in values.items()}
    for alias, taken in decimals.items():
        for i in np.flatnonzero(np.isinf(taken)).tolist():
            name = HEADER_LINES[alias].keyword
            context.beyond(lines[alias], "header", order.index(alias), name, str(values[alias][i]))
    return Header(number, MappingProxyType(decimals), MappingProxyType(lines))


def _read_arch_lights(context: Context) -> ArchLights:
    """Positional: objects, their meshes, their vertices; counts are what follows, not what is announced."""
    heading = context.heading("num archobjects")
    meshes: list[int] = [0]
    vertices: list[int] = [0]
    light: list[str] = []
    while not context.at_section() and not context.at_end_word():
        text = context.text()
        try:
            alias, fields = records.parse_any("arch_line", text)
        except lark.UnexpectedInput:
            context.fault(
                faults.MALFORMED_RECORD, context.at, f"expected a line of ARCHLIGHTING, but found {quote(text)}",
                "mend or remove the line",
            )  # fmt: skip
        else:
            if alias == "arch_object":
                meshes.append(meshes[-1])
            elif alias == "arch_mesh":
                meshes[-1] += 1
                vertices.append(vertices[-1])
            elif alias == "arch_vertex":
                vertices[-1] += 1
                light.extend(map(str, fields[1:]))
        context.at += 1
    context.counted(heading, "objects", len(meshes) - 1)
    return ArchLights(heading, np.array(meshes, np.int32), np.array(vertices, np.int32), floats(light).reshape(-1, 4))


_READERS: dict[str, Callable[[Context], Any]] = {
    "copyright": _read_copyright,
    "header": _read_header,
    "georesource": read_georesource,
    "sectors": read_sectors,
    "cogs": read_cogs,
    TEMPLATES: read_templates,
    "things": read_things,
    "archlighting": _read_arch_lights,
    "lights": read_lights,
    "layers": read_layers,
}


def _document(
    context: Context, sections: dict[str, int], parts: dict[str, Any], lists: dict[str, NameList]
) -> Document:
    # A reader that is given no lines yields its empty table.
    nothing = Context(Source(context.source.path, b""), context.game)
    for name, read_part in _READERS.items():
        if name not in parts:
            parts[name] = read_part(nothing)
    for section in SECTIONS.values():
        if section.key not in lists:
            lists[section.key] = read_list(nothing, section)
    geometry: GeoResource = parts["georesource"]
    lists[COLORMAPS.key] = geometry.colormaps
    return Document(
        source=context.source,
        game=context.game,
        lines=context.lines,
        sections=MappingProxyType(sections),
        header=parts["header"],
        lists=MappingProxyType(lists),
        vertices=geometry.vertices,
        texture_vertices=geometry.texture_vertices,
        adjoins=geometry.adjoins,
        surfaces=geometry.surfaces,
        normals=geometry.normals,
        sectors=parts["sectors"],
        cogs=parts["cogs"],
        templates=parts["templates"],
        things=parts["things"],
        arch_lights=parts["archlighting"],
        lights=parts["lights"],
        layers=parts["layers"],
        diagnostics=context.finish(),
    )
