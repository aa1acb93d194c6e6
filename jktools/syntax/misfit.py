"""What a line has that its grammar does not take, in the words of messages."""

from __future__ import annotations

from dataclasses import dataclass

import lark

from jktools.syntax.records import WORD, Record


@dataclass(frozen=True, slots=True)
class Misfit:
    """Where a line departs from its record."""

    start: int
    """Character at which it does; the line's length where the line ends too early."""
    found: str
    """The word that stands there; empty where the line ends."""
    wanted: str
    """What should stand there."""
    ordinal: int
    """Which field that is, from 0; negative for the words before the first one."""

    @property
    def what(self) -> str:
        """The second half of the message."""
        return f"but found {quote(self.found)}" if self.found else "but the line ends"


def misfit_of(record: Record, text: str, error: lark.UnexpectedInput) -> Misfit:
    """Say what an error of the parser means."""
    ended = isinstance(error, lark.UnexpectedToken) and error.token.type == "$END"
    start = len(text) if ended or error.pos_in_stream is None else error.pos_in_stream
    words = record.words(text)
    word = WORD.match(words[start:])
    ordinal = len(WORD.findall(words[:start])) - record.words_before
    return Misfit(start, word.group() if word else "", _wanted(record, ordinal), ordinal)


def _wanted(record: Record, ordinal: int) -> str:
    if 0 <= ordinal < len(record.fields):
        wanted = record.fields[ordinal]
        article = "" if wanted.kind.value.split()[-1] == wanted.name else f", {wanted.kind.value}"
        return f"the {wanted.name}{article}"
    return f'the words "{record.keyword}"' if ordinal < 0 else "a whole number"


def quote(text: str) -> str:
    """A piece of a file for a message, cut when long."""
    text = " ".join(text.split())
    return f'"{text}"' if len(text) <= 40 else f'"{text[:37]}..."'
