"""The header of a script, as the engine's line reader takes it: flags, symbols, and where the code starts.

This reader is not the one of the code: `#` cuts a line, `;` in the first column too, `//` starts no comment, quotes
mean nothing, and everything is lower-cased (sithCogParse_Load and stdConffile_ReadArgs in the decompiled engine).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from jktools.diagnostics import Code, Diagnostic, Label
from jktools.source import Source, Span
from jktools.syntax.cog import faults
from jktools.syntax.cog.nodes import Attribute, Header, Symbol
from jktools.syntax.lines import LogicalLines

NUMBER_TYPES = ("flex", "float", "int", "vector")
LINKED_TYPES = ("thing", "surface", "sector")
REFERENCE_TYPES = (*LINKED_TYPES, "cog", "template", "model", "keyframe", "sound", "material", "ai")
TYPES = frozenset((*NUMBER_TYPES, *REFERENCE_TYPES, "message"))

MOST_REFERENCES = 128
"""Symbols that a level can set: all but messages and local numbers (SITHCOG limits of the decompiled engine)."""
MOST_MESSAGES = 32
MOST_SYMBOLS = 256

DEFAULT_MASK = 0x401
NO_LINK = -1

_WORD = re.compile(r"[^ \t\r\n,\0]+")
_HEX = re.compile(r"[-+]?(?:0x)?([0-9a-f]+)")
_INT = re.compile(r"[-+]?[0-9]+")
_LOWER = {c: c + 32 for c in range(ord("A"), ord("Z") + 1)}


@dataclass(frozen=True, slots=True)
class HeaderReading:
    """What the reader found."""

    header: Header
    faults: tuple[Diagnostic, ...]
    """Why the engine refuses the script here; at most one, since it reads no further."""
    code: int | None
    """Byte offset at which the code starts; None when no `code` line was found."""


def read_header(source: Source, game: str) -> HeaderReading:
    """Read a script up to and including its `code` line. Never raises."""
    return _Reader(source, game).read()


class _Reader:
    def __init__(self, source: Source, game: str) -> None:
        self.source = source
        self.lines = LogicalLines(source, game)
        self.at = -1
        self.words: list[Attribute] = []
        self.faults: list[Diagnostic] = []
        self.flags = 0
        self.flags_word: Attribute | None = None
        self.symbols: list[Symbol] = []
        self.dropped: list[Symbol] = []
        self.references = 0
        self.messages = 0

    def read(self) -> HeaderReading:
        code = self._read()
        end = len(self.source.data) if code is None else code
        header = Header(0, end, self.flags, self.flags_word, tuple(self.symbols), tuple(self.dropped))
        return HeaderReading(header, tuple(self.faults), code)

    def _read(self) -> int | None:
        if self._next() and self._flags():
            self._next()
        if not self._seek("symbols", "before the symbols"):
            return None
        while self._next():
            if self.words[0].value == "end":
                break
            self._symbol()
        else:
            self._missing('the symbols end with the file, but an "end" line must close them', "end")
            return None
        self._next()
        return self.lines.behind(self.at) if self._seek("code", "between the symbols and the code") else None

    def _flags(self) -> bool:
        """Whether the line at hand says the flags, and what they are."""
        if self.words[0].key != "flags":
            return False
        self.flags_word = self.words[0]
        self.flags = read_hex(self.words[0].value, 0)
        return True

    def _next(self) -> bool:
        """Go to the next line that has words."""
        self.at += 1
        while self.at < len(self.lines):
            text = self.lines.text(self.at)
            found = list(_WORD.finditer(text.partition("\0")[0]))
            if found:
                whole = (int(self.lines.start[self.at]), int(self.lines.end[self.at]))
                self.words = [self._word(m[0], m.start(), m.end(), whole) for m in found]
                return True
            self.at += 1
        self.words = []
        return False

    def _word(self, text: str, start: int, end: int, line: tuple[int, int]) -> Attribute:
        lower = text.translate(_LOWER)
        key, equals, value = lower.partition("=")
        if line[1] < 0:  # joined from several physical lines
            place = self.lines.part(self.at, start, end)
            start, end = place.start, place.end
        else:
            start, end = line[0] + start, line[0] + end
        return Attribute(start, end, key, value if equals else key, bool(equals))

    # ---- the lines that must be there

    def _seek(self, word: str, where: str) -> bool:
        """Go to the line that starts with a word; the engine wants it here, so tell of what stands before it."""
        if self.words and self.words[0].value == word:
            return True
        first = self.words
        place = self.source.span(first[0].start, first[-1].end) if first else self._end_of_file()
        while self.words and self.words[0].value != word:
            if self.flags_word is None and word == "symbols":
                self._flags()  # the engine is past reading; the rest of us are not
            self._next()
        unclosed = next((s for s in self.dropped if s.type == "code"), None)
        if not self.words and unclosed is not None and word == "code":
            line = self.source.position(unclosed.start).line
            self._tell(
                faults.MISSING_COG_PART, self._end_of_file(),
                f'there is no "code" line behind the symbols: one stands on line {line}, but no "end" line before it',
                f'add a line "end" before line {line}',
            )  # fmt: skip
            return False
        if not self.words:
            self._missing(f'there is no "{word}" line, but the engine needs one', word)
            return False
        found = place.text.strip()
        comment = found.startswith(("//", ";"))
        self._tell(
            faults.MALFORMED_COG_HEADER, place,
            f'expected only blank lines and comments {where}, but found "{found[:40]}"',
            "comments start with # here, or with ; in the first column" if comment else "remove the line",
        )  # fmt: skip
        return True

    def _end_of_file(self) -> Span:
        return self.source.span(len(self.source.data), len(self.source.data))

    def _missing(self, message: str, word: str) -> None:
        text = self.source.text
        cure = f'add a line "{word}"'
        if "\r" in text and "\n" not in text:
            cure = "save the file with the line ends of Windows or Unix: for the engine it is one line"
        self._tell(faults.MISSING_COG_PART, self._end_of_file(), message, cure)

    def _tell(self, code: Code, place: Span, message: str, help: str) -> None:
        if not self.faults:
            self.faults.append(Diagnostic(code, code.severity, Label(place), message, help))

    # ---- symbols

    def _symbol(self) -> None:
        first, rest = self.words[0], self.words[1:]
        word = first.value
        known = word in TYPES
        name = rest[0] if rest else Attribute(first.end, first.end, "", "", False)
        attributes = tuple(rest[1:])
        number = word in NUMBER_TYPES
        local, link, mask = _effects(word, attributes)
        symbol = Symbol(
            first.start, self.words[-1].end, word, name, attributes, local=local, link=link, mask=mask
        )  # fmt: skip
        takes_value = known and word != "message" and not (number and local)
        full = (
            len(self.symbols) >= MOST_SYMBOLS
            or (word == "message" and self.messages >= MOST_MESSAGES)
            or (known and word != "message" and self.references >= MOST_REFERENCES)
        )
        if not known or not rest or full:
            self.dropped.append(symbol)
            return
        self.symbols.append(symbol)
        self.messages += word == "message"
        self.references += takes_value


def _effects(word: str, attributes: tuple[Attribute, ...]) -> tuple[bool, int, int]:
    """Whether a symbol is local, its link id and its mask, as the engine takes them from the words behind the name."""
    local, link, mask = False, 0, DEFAULT_MASK
    linked = word in LINKED_TYPES
    for attribute in attributes:
        if attribute.key == "local":
            local = True
            if word in NUMBER_TYPES:
                break
        elif not linked:
            continue
        elif attribute.key == "mask":
            mask = read_hex(attribute.value, mask)
        elif attribute.key == "linkid":
            link = read_int(attribute.value)
        elif attribute.key == "nolink":
            link = NO_LINK
    return local, NO_LINK if local or not linked else link, mask


def read_hex(text: str, otherwise: int) -> int:
    """A number as scanf reads `%x`: with or without 0x, up to the first other character, wrapped to 32 bits."""
    found = _HEX.match(text)
    if found is None:
        return otherwise
    value = int(found[1], 16)
    return (-value if text.startswith("-") else value) & 0xFFFFFFFF


def read_int(text: str) -> int:
    """A number as atoi reads it: decimal, up to the first other character, 0 where there is none."""
    found = _INT.match(text)
    return max(-(2**31), min(2**31 - 1, int(found[0][:20]))) if found else 0
