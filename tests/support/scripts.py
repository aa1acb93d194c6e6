"""Scripts for tests, whole ones made of fragments, and those of the corpus where it is at hand."""

from __future__ import annotations

import random
import re
import struct
from collections.abc import Iterator

from jktools.diagnostics import Diagnostic
from jktools.linter import find_rule, lint
from jktools.source import Source
from jktools.syntax.cog import Script, read_script
from tests.support.levels import CORPUS


def whole(*fragment: str) -> str:
    """The text of a script made of a fragment.

    With a line `symbols` it is a script already, and gets code that does nothing if it has none; else it is code, and
    gets a header without symbols.
    """
    words = [line.split()[:1] for line in fragment]
    if ["symbols"] not in words:
        return "\n".join(["symbols", "end", "code", *fragment, "end", ""])
    if ["code"] not in words:
        return "\n".join([*fragment, "code", ";", "end", ""])
    return "\n".join([*fragment, ""])


def script_of(text: str | bytes, path: str = "test.cog", game: str = "jk") -> Script:
    """A script from its text."""
    return read_script(Source(path, text.encode("latin-1") if isinstance(text, str) else text), game)


def script_findings(code: str, *fragment: str) -> list[Diagnostic]:
    """The findings of one rule."""
    return lint(script_of(whole(*fragment)), [find_rule(code)])


def corpus_scripts() -> Iterator[tuple[str, bytes]]:
    """Every COG of the corpus with its bytes, unpacked apart from the code under test."""
    for path in sorted((CORPUS / "gob").glob("*")) if CORPUS.exists() else []:
        data = path.read_bytes()
        for i in range(struct.unpack_from("<I", data, 12)[0]):
            offset, size, raw = struct.unpack_from("<II128s", data, 16 + 136 * i)
            name = raw.split(b"\0")[0].decode("latin-1").replace("\\", "/")
            if name.lower().endswith(".cog"):
                yield f"{path.name}!{name}", data[offset : offset + size]


PIECES = [
    ";", ";", "{", "}", "(", ")", "[", "]", ",", ":", "=", "==", "!=", "&&", "||", "<", ">", "<=", ">=", "+", "-", "*",
    "/", "%", "&", "|", "^", "!", "~", ".", "$", "\\", '"', "'", "#", "//", "/*", "*/", "if", "else", "while", "do",
    "for", "goto", "call", "return", "stop", "break", "continue", "end", "x", "startup", "message", "code", "symbols",
    "1", "0x1F", "0x", "08", "1.5", ".5", "1e3", "1.5f", '"s"', "'v'", "\n", "\r",
]  # fmt: skip
"""What random scripts are made of: tokens, and what is nearly one."""


def mutated(text: str, rng: random.Random) -> str:
    """A script with up to three small faults."""
    for _ in range(rng.randint(1, 3)):
        tokens = list(re.finditer(r"\w+|\s+|[^\w\s]", text))
        at = rng.choice(tokens)
        other = rng.choice(tokens)
        match rng.randrange(5):
            case 0:
                text = text[: at.start()] + text[at.end() :]
            case 1:
                text = text[: at.start()] + rng.choice(PIECES) + " " + text[at.start() :]
            case 2:
                text = text[: at.start()] + rng.choice(PIECES) + text[at.end() :]
            case 3:
                text = text[: at.start()] + other[0] + text[at.end() :]
            case _:
                text = text[: at.start()] + chr(rng.randrange(256)) + text[at.start() + 1 :]
    return text
