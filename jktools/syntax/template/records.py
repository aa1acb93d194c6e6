"""The lines of templates and things: name, fields, and a tail of parameters."""

from __future__ import annotations

from jktools.syntax.records import Field, Kind, Record, fields
from jktools.syntax.template.values import parser

TEMPLATE = Record("template", "template", fields(Kind.WORD, "name, parent"), more="*", grammar=parser)
THING = Record(
    "thing", "thing",
    (
        Field("label", Kind.LABEL),
        *fields(Kind.WORD, "template, name"),
        *fields(Kind.FLOAT, "x, y, z, pitch, yaw, roll"),
        Field("sector", Kind.INT),
    ),
    more="*", grammar=parser,
)  # fmt: skip


def split_parameter(word: str) -> tuple[str, str]:
    """Key and value at the first `=`; a word without one is both (stdConffile in the decompiled engine)."""
    key, sign, value = word.partition("=")
    return (key, value) if sign else (word, word)
