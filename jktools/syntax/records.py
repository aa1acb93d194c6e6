"""Kinds of line in the game's text files: which rule reads one, its fields, and what the engine makes of a bad one."""

from __future__ import annotations

import enum
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

import lark


class Kind(enum.Enum):
    """What a field is: how people call it, and the longest prefix that the engine would still read."""

    LABEL = "a number and a colon"
    INT = "a whole number"
    HEX = "a hexadecimal number"
    FLOAT = "a number"
    WORD = "a name"


_PREFIX: Mapping[Kind, str] = MappingProxyType(
    {
        Kind.LABEL: r"[-+]?\d+:",
        Kind.INT: r"[-+]?\d+",
        Kind.HEX: r"[-+]?(?:0[xX])?[0-9a-fA-F]+",
        Kind.FLOAT: r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?",
        Kind.WORD: r"\S+",
    }
)


WORD = re.compile(r"[^ \t\r\f\v]+")
"""A word as the grammar parts them; `str.split` and `\\s` take more control bytes for blanks than the engine does."""


def keywords(text: str) -> str:
    """The words of a line in lower case, each followed by one blank."""
    return "".join(word + " " for word in WORD.findall(text.lower()))


_LETTER = {Kind.LABEL: "L", Kind.INT: "i", Kind.HEX: "h", Kind.FLOAT: "f", Kind.WORD: "w"}


@dataclass(frozen=True, slots=True)
class Field:
    """One value of a record, named in the game's words."""

    name: str
    kind: Kind


@dataclass(frozen=True)
class Record:
    """One kind of line.

    `scanned` lines are read by the engine with scanf, the others as fields split at blanks and commas.
    """

    rule: str
    """Start rule of the grammar."""
    title: str
    """For messages: `vertex`, `adjoin`."""
    fields: tuple[Field, ...]
    scanned: bool = False
    keyword: str = ""
    """The words before the fields, in lower case; they choose among the alternatives of one rule."""
    alias: str = ""
    """Name of that alternative in the grammar; the rule's own name where there is only one."""
    more: str = ""
    """What may follow the fields in a record that the native reader takes: `*` any words, `ff` two numbers."""
    grammar: Callable[[], lark.Lark] = field(kw_only=True)
    """The parser that has the rule; loaded when first called."""

    @cached_property
    def form(self) -> str:
        """The fields for the native reader, a letter each (native/text/records.hpp)."""
        return "".join(_LETTER[f.kind] for f in self.fields) + self.more

    @cached_property
    def words_before(self) -> int:
        """How many words stand before the first field."""
        return len(self.keyword.split())

    def ordinal(self, name: str) -> int:
        """Position of a field among the fields. Raises ValueError."""
        return [f.name for f in self.fields].index(name)

    def words(self, text: str) -> str:
        """The text with what separates words turned into blanks, position for position."""
        return text if self.scanned else text.replace(",", " ")

    def parse(self, text: str) -> list[lark.Token]:
        """The fields of a line, and what the rule repeats behind them. Raises lark.UnexpectedInput."""
        return fields_of(self.grammar().parse(self.words(text), start=self.rule))

    def surplus(self, text: str) -> list[lark.Token]:
        """The words of a well-formed line that nobody reads."""
        last = self.grammar().parse(self.words(text), start=self.rule).children[-1]
        return [t for t in last.children if isinstance(t, lark.Token)] if isinstance(last, lark.Tree) else []

    def salvage(self, text: str) -> list[str] | None:
        """The fields as the engine would read a malformed line, or None where it refuses the level.

        scanf takes each value's longest prefix and fails on none; the field reader takes the prefix of each
        word, 0 where there is none, and fails only when words are missing.
        """
        return self._scan(text) if self.scanned else self._split(text)

    def _scan(self, text: str) -> list[str] | None:
        words = r"\s*".join(map(re.escape, self.keyword.split()))
        values = r"\s*".join(f"({_PREFIX[f.kind]})" for f in self.fields)
        found = re.match(rf"\s*{words}\s*{values}", text, re.IGNORECASE | re.ASCII)
        return list(found.groups()) if found else None

    def _split(self, text: str) -> list[str] | None:
        words = WORD.findall(self.words(text))
        if len(words) < len(self.fields):
            return None
        read = [prefix(f.kind, word) for f, word in zip(self.fields, words, strict=False)]
        return read + words[len(read) :] if self.more == "*" else read


def prefix(kind: Kind, word: str) -> str:
    """What the engine's field reader makes of a word: its longest prefix that fits, or 0."""
    if kind is Kind.WORD:
        return word
    found = re.match(_PREFIX[Kind.INT if kind is Kind.LABEL else kind], word, re.ASCII)
    return found.group() if found else "0"


def fields_of(tree: lark.Tree[lark.Token]) -> list[lark.Token]:
    """The tokens of a parsed line, without what nobody reads."""
    return [child for child in tree.children if isinstance(child, lark.Token)]


def fields(kind: Kind, names: str) -> tuple[Field, ...]:
    """Fields of one kind from their names, parted by commas."""
    return tuple(Field(name.strip(), kind) for name in names.split(","))
