"""Values of parameters: what the engine's scan makes of a text, and whether it is written as it should be."""

from __future__ import annotations

import enum
import re
from collections.abc import Mapping
from functools import cache, lru_cache
from types import MappingProxyType

import lark
import numpy as np

from jktools.syntax import grammar

Value = int | float | str | tuple[float, ...] | tuple[int, ...]
"""Floats are rounded to float32; a frame is a tuple of six."""


class ValueKind(enum.Enum):
    """How a value is written; the names are start rules of grammars/template.lark."""

    WORD = "word"
    INT = "int"
    HEX = "hex"
    FLOAT = "float"
    VECTOR = "vector"
    COLOUR = "colour"
    FRAME = "frame"

    @property
    def form(self) -> str:
        """For messages."""
        return _FORM[self]


_FORM = {
    ValueKind.WORD: "a name",
    ValueKind.INT: "a whole number",
    ValueKind.HEX: "a hexadecimal number",
    ValueKind.FLOAT: "a number",
    ValueKind.VECTOR: "three numbers, (x/y/z)",
    ValueKind.COLOUR: "three whole numbers, (red/green/blue)",
    ValueKind.FRAME: "six numbers, (x/y/z:pitch/yaw/roll)",
}

START_RULES = (*(kind.value for kind in ValueKind), "template", "thing")

_INT = r"[-+]?[0-9]+"
_FLOAT = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_HEX = r"[-+]?(?:0[xX](?=[0-9a-fA-F]))?[0-9a-fA-F]+"


def _scan(part: str, count: int, between: str = "/") -> str:
    # scanf takes blanks before a number, but a word holds none; what follows the last number is not looked at
    return r"\(" + between.join([f"({part})"] * count)


_SCANNED: Mapping[ValueKind, re.Pattern[str]] = MappingProxyType(
    {
        ValueKind.INT: re.compile(f"({_INT})"),
        ValueKind.HEX: re.compile(f"({_HEX})"),
        ValueKind.FLOAT: re.compile(f"({_FLOAT})"),
        ValueKind.VECTOR: re.compile(_scan(_FLOAT, 3)),
        ValueKind.COLOUR: re.compile(_scan(_INT, 3)),
        ValueKind.FRAME: re.compile(_scan(_FLOAT, 3) + ":" + _scan(_FLOAT, 3)[2:]),
    }
)
"""The longest prefix that the engine reads."""

_CLEAN: Mapping[ValueKind, re.Pattern[str]] = MappingProxyType(
    {
        ValueKind.WORD: re.compile(r"[^ \t\r\f\v,]+"),
        ValueKind.INT: re.compile(_INT),
        ValueKind.HEX: re.compile(r"(?:0[xX])?[0-9a-fA-F]+"),
        ValueKind.FLOAT: re.compile(_FLOAT),
        ValueKind.VECTOR: re.compile(_scan(_FLOAT, 3) + r"\)"),
        ValueKind.COLOUR: re.compile(_scan(_INT, 3) + r"\)"),
        ValueKind.FRAME: re.compile(_scan(_FLOAT, 3) + ":" + _scan(_FLOAT, 3)[2:] + r"\)"),
    }
)
"""What the grammar's value rules match, as patterns for speed; a test holds the two together."""

LEAST, MOST = -(2**31), 2**31 - 1
HEX_RANGE, HEX_DIGITS = 2**32, 8
"""Flags are held in 32 bits; of more digits scanf keeps the last."""
MOST_DIGITS = 40
"""Digits that are read of a whole number; one with more is beyond 32 bits whatever they are."""


@lru_cache(maxsize=1 << 14)
def scan(kind: ValueKind, text: str) -> Value | None:
    """What the engine reads of a value, or None where its scanf fails.

    Numbers alone are read with atoi and atof, which never fail: no digits are 0. Vectors, frames, colours and flags are
    read with scanf, which takes each number's longest prefix and ignores what follows the last.
    """
    if kind is ValueKind.WORD:
        return text.lower()
    found = _SCANNED[kind].match(text)
    if found is None:
        return {ValueKind.INT: 0, ValueKind.FLOAT: 0.0}.get(kind)
    match kind:
        case ValueKind.INT:
            return _whole(found[1])
        case ValueKind.HEX:
            return _hex(found[1])
        case ValueKind.FLOAT:
            return _float(found[1])
        case ValueKind.COLOUR:
            return tuple(_whole(part) for part in found.groups())
        case _:
            return tuple(_float(part) for part in found.groups())


@lru_cache(maxsize=1 << 14)
def well_formed(kind: ValueKind, text: str) -> bool:
    """Whether a value is written as the grammar has it, to its last byte."""
    return _CLEAN[kind].fullmatch(text) is not None


def parses(kind: ValueKind, text: str) -> bool:
    """Ask the grammar itself; `well_formed` answers the same, faster."""
    try:
        parser().parse(text, start=kind.value)
    except lark.UnexpectedInput:
        return False
    return True


@cache
def parser() -> lark.Lark:
    """The template grammar, loaded once."""
    return grammar.load("template", START_RULES)


def _float(text: str) -> float:
    with np.errstate(over="ignore"):
        return float(np.float32(float(text)))


def _whole(text: str) -> int:
    digits = text.lstrip("+-").lstrip("0") or "0"
    size = int(digits) if len(digits) <= MOST_DIGITS else MOST + 1
    return max(LEAST, min(MOST, -size if text.startswith("-") else size))


def _hex(text: str) -> int:
    size = int(text.lstrip("+-").lower().removeprefix("0x")[-HEX_DIGITS:], 16)
    return -size % HEX_RANGE if text.startswith("-") else size
