"""The tokens of COG code, as the engine's scanner cuts them.

The definition is `grammars/cog.lark`; this is the same reading in one expression that keeps the place of everything. A
test holds it to what Lark's scanner makes of the grammar.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from jktools.syntax.cog.nodes import Name, Node, Number, String, Vector
from jktools.syntax.cog.tables import END_OF_CODE, Tables

LONGEST_TOKEN = 16381
"""Bytes of one token that the engine's scanner can read: its buffer of 16384 also holds the byte before the token, the
one behind it and an end mark (yy_get_next_buffer in lex.yy.c of the decompiled engine)."""

END_WORD = "end"

# Optional groups are not possessive: before 3.11.5 Python leaves the position behind what such a group tried in vain.
_TOKEN = re.compile(
    r"""
    [ \t\v\f\r\n]*+ (?: (?://|\#)[^\n]*+ [ \t\v\f\r\n]*+ )*+
    (?: ([A-Za-z_][A-Za-z0-9_]*+)
      | ( [(){};,:\[\]+*/%^~-] | [=!<>]=? | &&? | \|\|? | \.(?![0-9]) )
      | ( 0[xX][0-9a-fA-F]++ | (?: [0-9]++ (?: \.[0-9]*+ (?:[eE][-+]?[0-9]++)? | [eE][-+]?[0-9]++ )? )
          | \.[0-9]++ (?:[eE][-+]?[0-9]++)? )
      | "((?: [^\\"]++ | \\. )*)"
      | '((?: [^\\']++ | \\. )*)'
      | ([^\n]) )
    """,
    re.VERBOSE,
)
_NAME, _SIGN, _NUMBER, _STRING, _VECTOR, _STRAY = range(1, 7)

_COMMENT = re.compile(r"(?://|#)[^\n]*+")
_OPEN_LITERAL = {'"': re.compile(r'"(?:[^\\"]++|\\.)*+'), "'": re.compile(r"'(?:[^\\']++|\\.)*+")}
_FLOAT = re.compile(r"[ \t\v\f\r\n]*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)")


class Token(NamedTuple):
    """One token: its column in the parse tables, its bytes, and its node or, without one, its text."""

    column: int
    start: int
    end: int
    value: Name | Number | String | Vector | str


class Stray(Node, frozen=True, eq=False, gc=False):
    """A character that the scanner drops in silence."""

    text: str


@dataclass(slots=True)
class Scan:
    """What the scanner made of the code."""

    tokens: list[Token] = field(default_factory=list)
    """With one of the column of END_OF_CODE at the end."""
    words: list[Name | String] = field(default_factory=list)
    strays: list[Stray] = field(default_factory=list)
    overlong: list[Node] = field(default_factory=list)
    """Tokens that the engine's scanner cannot hold."""
    closed: bool = False
    """Whether the word `end` ended it."""


def scan(text: str, at: int, tables: Tables) -> Scan:
    """Cut the text from an offset on, up to the first word `end`."""
    found = Scan()
    begin = at
    tokens, words = found.tokens, found.words
    name_column, string_column, vector_column = (tables.columns[name] for name in ("NAME", "STRING", "VECTOR"))
    word_columns = tables.words
    match = _TOKEN.match
    append, make = tokens.append, tuple.__new__  # a Token, without the detour through its own __new__
    while token := match(text, at):
        kind = token.lastindex
        start, at = token.span(kind)  # type: ignore[arg-type]  # one group always takes part
        if kind == _NAME:
            spelled = text[start:at].lower()
            column = word_columns.get(spelled)
            if column is None:
                if spelled == END_WORD:
                    found.closed = True
                    append(make(Token, (tables.columns[END_OF_CODE], start, at, text[start:at])))
                    break
                name = Name(start, at, spelled)
                words.append(name)
                append(make(Token, (name_column, start, at, name)))
            else:
                append(make(Token, (column, start, at, spelled)))
        elif kind == _SIGN:
            sign = text[start:at]
            append(make(Token, (word_columns[sign], start, at, sign)))
        elif kind == _NUMBER:
            append(_number(text[start:at], start, at, tables))
        elif kind == _STRING:
            string = String(start - 1, at + 1, text[start:at])
            at += 1
            words.append(string)
            append(make(Token, (string_column, start - 1, at, string)))
        elif kind == _VECTOR:
            written = text[start:at]
            at += 1
            append(make(Token, (vector_column, start - 1, at, Vector(start - 1, at, _vector(written), written))))
        else:
            found.strays.append(Stray(start, at, text[start:at]))
    else:
        append(make(Token, (tables.columns[END_OF_CODE], len(text), len(text), "")))
    if len(text) - begin > LONGEST_TOKEN:
        found.overlong += _overlong(text, begin, found)
    return found


def _overlong(text: str, begin: int, found: Scan) -> Iterator[Node]:
    """The tokens and comments that are too long, and the unpaired quotes behind which the scanner looks too far."""
    for stray in found.strays:
        literal = _OPEN_LITERAL.get(stray.text)
        reach = literal.match(text, stray.start) if literal else None
        if reach is not None and reach.end() - stray.start > LONGEST_TOKEN:
            yield Node(stray.start, reach.end())
    at = begin
    for token in found.tokens:
        if token.start - at > LONGEST_TOKEN:
            for comment in _COMMENT.finditer(text, at, token.start):
                if comment.end() - comment.start() > LONGEST_TOKEN:
                    yield Node(comment.start(), comment.end())
        if token.end - token.start > LONGEST_TOKEN:
            yield Node(token.start, token.end)
        at = token.end


def _number(text: str, start: int, end: int, tables: Tables) -> Token:
    value: int | float
    if text[:2] in ("0x", "0X"):
        kind, value = "HEX", _int32(int(text, 16))
    elif text.isdigit():
        if text[0] == "0" and len(text) > 1:
            octal = re.match("[0-7]*", text)
            kind, value = "OCTAL", _int32(int(octal[0], 8)) if octal else 0
        else:
            kind, value = "DECIMAL", _decimal(text)
    else:
        kind, value = "FLEX", _float32(text)
    return Token(tables.columns[kind], start, end, Number(start, end, value, text))


def _decimal(text: str) -> int:
    """The value as it wraps to 32 bits; only the last digits matter, and Python refuses to read millions of them."""
    if len(text) < 10:
        return int(text)
    value = 0
    for at in range(0, len(text), 9):
        part = text[at : at + 9]
        value = (value * 10 ** len(part) + int(part)) & 0xFFFFFFFF
    return _int32(value)


def _int32(value: int) -> int:
    return (value + 2**31) % 2**32 - 2**31


def _float32(text: str) -> float:
    try:
        rounded: float = struct.unpack("<f", struct.pack("<f", float(text)))[0]
    except OverflowError:
        return float("-inf") if text.startswith("-") else float("inf")
    return rounded


def _vector(text: str) -> tuple[float, float, float]:
    """Three floats as scanf reads them: what it does not reach is 0."""
    parts = [0.0, 0.0, 0.0]
    at = 0
    for i in range(3):
        found = _FLOAT.match(text, at)
        if found is None:
            break
        parts[i], at = _float32(found[1]), found.end()
    return parts[0], parts[1], parts[2]
