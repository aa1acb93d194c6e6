"""Lights and Layers: what JED and SED keep in a level for themselves. The engine skips both sections."""

from __future__ import annotations

import re
from dataclasses import replace

import lark
import numpy as np

from jktools.diagnostics import Severity
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.context import Context, quote
from jktools.syntax.jkl.document import EditorLayer, EditorLights
from jktools.syntax.lines import BLANK, END, SECTION
from jktools.syntax.rows import ints

_BY_WORDS = {len(r.fields): r for r in (records.LIGHT_JED, records.LIGHT_SED, records.LIGHT_RGB)}


def read_lights(context: Context) -> EditorLights:
    """Read the section behind its `section:` line; the first light tells which editor wrote it."""
    heading = context.heading("editor lights")
    lines = context.block(SECTION | END, blank=False)
    if context.at_end_word():
        context.at += 1
    words = int(context.lines.word_counts(lines[:1])[0]) if len(lines) else 0
    record = _BY_WORDS.get(words, records.LIGHT_JED)
    told = len(context.diagnostics)
    rows = context.rows(record, "light", lines)
    count = len(rows)
    jed, rgb = record is records.LIGHT_JED, record is records.LIGHT_RGB
    lights = EditorLights(
        heading,
        rows.line_column(),
        rows.broken(),
        flags=rows.hex_column("type" if jed else "flags"),
        layer=np.full(count, -1, np.int32) if jed else rows.int_column("layer"),
        position=rows.float_columns("x", 3),
        range=rows.float_columns("range", 1),
        intensity=rows.float_columns("intensity", 1),
        color=rows.float_columns("red", 3) if rgb else np.full((count, 3), np.nan, np.float32),
    )
    # The engine never sees these lines: what is wrong with them is worth knowing, no more.
    context.diagnostics[told:] = [
        replace(d, severity=Severity.INFO, help="the engine skips this section") for d in context.diagnostics[told:]
    ]
    return lights


def read_layers(context: Context) -> tuple[EditorLayer, ...]:
    """Read the section behind its `section:` line: name, sectors and things of each layer, then what is visible."""
    heading = context.heading("editor layers")
    lines = context.block(SECTION | END)
    if context.at_end_word():
        context.at += 1
    texts = [(int(n), context.lines.text(int(n))) for n in lines if not context.lines.kinds[n] & BLANK]
    layers: list[EditorLayer] = []
    at = 0
    while heading is not None and len(layers) < heading.count and at < len(texts):
        name = texts[at][1].strip()
        sectors, at = _members(context, texts, at + 1)
        things, at = _members(context, texts, at)
        layers.append(EditorLayer(name, sectors, things))
    return tuple(layers)


def _members(context: Context, texts: list[tuple[int, str]], at: int) -> tuple[tuple[int, ...], int]:
    """One list of indices, which may go on over lines, and where the next thing starts."""
    wanted = re.match(r"[ \t]*([0-9]+):", texts[at][1]) if at < len(texts) else None
    if wanted is None:
        place, found = (texts[at][0], quote(texts[at][1])) if at < len(texts) else (context.source, "the end")
        context.fault(
            faults.LOOSELY_READ_RECORD, place, f"expected the number of a layer's objects, but found {found}",
            "the engine skips this section", severity=Severity.INFO,
        )  # fmt: skip
        return (), at
    numbers: list[int] = []
    count = ints([wanted.group(1)])[0][0]
    first = True
    while at < len(texts) and (first or len(numbers) < count):
        try:
            alias, fields = records.parse_any("layer_members", texts[at][1])
        except lark.UnexpectedInput:
            break
        if not first and alias != "layer_more":
            break
        numbers += ints([str(field) for field in fields[first:]])[0]
        at, first = at + 1, False
    return tuple(numbers), at
