"""UNI, the string tables: the texts that the game shows for keys (stdStrTable_Load in the decompiled engine)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from jktools.diagnostics import Severity
from jktools.diagnostics.wording import miscounted
from jktools.source import Source, Span
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.faultlist import FaultList
from jktools.syntax.misfit import quote

MOST_LINE = 254
"""Bytes of a line that the engine reads; the rest of a longer one is passed over."""

_COUNT = re.compile(r"MSGS\s*([0-9]{1,9})")
_ENTRY = re.compile(r'[^"]*"([^"]*)"?[ \t]*([^ \t]*)[ \t]*(?:"([^"]*)"?)?')


@dataclass(frozen=True, slots=True)
class Text:
    """One entry."""

    key: str
    text: str
    place: Span


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Strings(Asset):
    """A UNI file."""

    texts: Mapping[str, Text] = field(default_factory=dict)
    """By key, in lower case; the first of a key counts."""


def read_strings(source: Source) -> Strings:
    """Read a UNI. Never raises: what is wrong is told in `Strings.diagnostics`."""
    told = FaultList(source)
    lines = _lines(source, told)
    head = next(lines, None)
    announced = _COUNT.match(source.text, head.start) if head else None
    if head is None or announced is None:
        told.tell(
            faults.MALFORMED_ASSET, head or source,
            f'expected "MSGS" and a count, but found {quote(head.text) if head else "nothing"}',
            "write it in the first line; the engine shows none of the texts",
        )  # fmt: skip
        return Strings(source=source, diagnostics=told.finish())
    return Strings(source=source, texts=_texts(lines, head, int(announced[1]), told), diagnostics=told.finish())


def _texts(lines: Iterator[Span], head: Span, announced: int, told: FaultList) -> dict[str, Text]:
    texts: dict[str, Text] = {}
    count = 0
    for place in lines:
        text = place.text
        if text.lstrip()[:3].lower() == "end":
            break
        count += 1
        entry = _ENTRY.match(text)
        if entry is None or entry[3] is None:
            told.tell(
                faults.LOOSELY_READ_ASSET, place, f'expected "key" number "text", but found {quote(text)}',
                "put key and text in double quotes; the engine passes over the line",
            )  # fmt: skip
            continue
        key = entry[1].lower()
        if key in texts:
            told.tell(
                faults.LOOSELY_READ_ASSET, place,
                f"the key {quote(entry[1])} stands here again, but the engine keeps its first text",
                "remove one of the two", severity=Severity.INFO,
            )  # fmt: skip
        texts.setdefault(key, Text(entry[1], entry[3], place))
    else:
        told.tell(
            faults.LOOSELY_READ_ASSET, told.source, 'the table has no "END"', 'put a line "END" behind the last entry'
        )
    if count != announced:
        told.tell(
            faults.ASSET_COUNT_MISMATCH, head, miscounted(announced, "texts", count),
            f"write {count}; the engine " + ("drops the rest" if count > announced else "notes it in its log"),
            severity=Severity.WARNING if count > announced else Severity.INFO,
        )  # fmt: skip
    return texts


def _lines(source: Source, told: FaultList) -> Iterator[Span]:
    """The lines that the engine sees: neither empty nor a comment."""
    for line in re.finditer(r"[^\n]+", source.text):
        text = line.group().strip()
        if text and not text.startswith("#"):
            place = source.span(line.start(), line.start() + len(line.group().rstrip()))
            if len(line.group()) > MOST_LINE:
                told.tell(
                    faults.LOOSELY_READ_ASSET, place,
                    f"the line has {len(line.group())} bytes, but the engine reads {MOST_LINE}",
                    "split the text over two entries; the engine cuts it",
                )  # fmt: skip
                place = source.span(line.start(), line.start() + MOST_LINE)
            yield place
