"""What a user can choose for a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal, get_args

from jktools.diagnostics import Severity
from jktools.linter import Options
from jktools.model.cog.verbs import Verb
from jktools.source import Span

Game = Literal["jk", "mots"]
GAMES: tuple[Game, ...] = get_args(Game)


@dataclass(frozen=True, slots=True)
class Ignore:
    """Findings hidden by the configuration: an `[[ignore]]` entry."""

    code: str
    """Of a rule, or its name."""
    path: str = "*"
    """Which files, as a shell pattern over the path in the report or its end: `*/lagoon.jkl`."""
    object: str = ""
    """Kind and index (`surface 145`), or kind and name (`template walkplayer`); empty for any."""
    reason: str = ""
    span: Span | None = None
    """Where the configuration says so."""


@dataclass(frozen=True, slots=True)
class Settings:
    """One run's choices; the defaults are those of the command line."""

    game: Game | None = None
    """None: Mysteries of the Sith for what comes from a GOO, Jedi Knight for the rest."""
    select: tuple[str, ...] = ()
    """Codes, prefixes of codes or names of rules; none means all that are on."""
    ignore: tuple[str, ...] = ()
    severity: Mapping[str, Severity] = field(default_factory=lambda: MappingProxyType({}))
    """Severities that differ from the rules' own, by code."""
    options: Mapping[str, Options] = field(default_factory=lambda: MappingProxyType({}))
    """Options of rules that differ from their defaults, by code."""
    ignores: tuple[Ignore, ...] = ()
    verbs: Mapping[str, Verb] = field(default_factory=lambda: MappingProxyType({}))
    """Verbs of scripts that a custom build of the game registers, by lower-case name."""
    base: tuple[str, ...] = ()
    """Folders and packs with the game's own files, in the order of the search."""
    strict_grammar: bool = False
    """Read every record with the Lark grammar: slow, and the same result."""
