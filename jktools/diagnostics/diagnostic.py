"""One thing said about a file: code, place, message, cure."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from jktools.source import Source, Span


class Severity(enum.IntEnum):
    """How bad a finding is.

    An error breaks the level or is undefined behaviour in the engine; a warning is a fault that a player can
    meet or that the engine drops in silence; an info is worth knowing.
    """

    INFO = 1
    WARNING = 2
    ERROR = 3

    def __str__(self) -> str:
        return self.name.lower()


@dataclass(frozen=True, slots=True)
class Code:
    """The fixed identity of a kind of finding: `JK201`, its name and how bad it is by default."""

    id: str
    name: str
    severity: Severity

    def __str__(self) -> str:
        return self.id

    @property
    def is_bug(self) -> bool:
        """Whether it tells of a bug in jktools: nothing hides such a finding, and the exit status is 3."""
        return self.id.startswith("JK9")


@dataclass(frozen=True, slots=True)
class Label:
    """A place and what to say about it; a whole Source stands for the file as such."""

    place: Span | Source
    message: str = ""

    @property
    def path(self) -> str:
        """The file."""
        return (self.place.source if isinstance(self.place, Span) else self.place).path

    @property
    def span(self) -> Span | None:
        """The range of bytes, or None for the whole file."""
        return self.place if isinstance(self.place, Span) else None


@dataclass(frozen=True, slots=True)
class Subject:
    """The object of a level that a finding is about: kind (`surface`), index and name where it has one."""

    kind: str
    index: int
    name: str | None = None


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A finding, ready to be shown. Messages follow one style: lower case, no full stop, both sides stated."""

    code: Code
    severity: Severity
    label: Label
    message: str
    help: str | None = None
    subject: Subject | None = None
    related: tuple[Label, ...] = ()

    @property
    def path(self) -> str:
        """The file it is about."""
        return self.label.path

    @property
    def sort_key(self) -> tuple[str, int, str, str]:
        """Path, place, code, message: the one order of every output. Whole-file findings come first."""
        span = self.label.span
        return (self.path, -1 if span is None else span.start, self.code.id, self.message)
