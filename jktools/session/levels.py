"""From paths to levels."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from jktools.model import Level
from jktools.session.settings import Game, Settings
from jktools.source import Container, Gob, InputError, Member, Target, resolve
from jktools.source.container import PACK_SEPARATOR
from jktools.source.path import PACK_EXTENSIONS
from jktools.syntax.jkl import read

LEVEL_EXTENSION = "jkl"


def discover(typed: str) -> list[Member]:
    """The levels that a path names, in the container's order; packs inside a folder are entered.

    Raises InputError when the path cannot be opened or holds no level.
    """
    levels = list(_levels(resolve(typed)))
    if not levels:
        raise InputError(f"nothing to read in {typed}: expected a .jkl level, or a folder or pack that holds one")
    return levels


def _levels(target: Target) -> Iterator[Member]:
    for member in target.members if isinstance(target, Container) else [target]:
        if member.extension == LEVEL_EXTENSION:
            yield member
        elif member.extension in PACK_EXTENSIONS and not isinstance(target, Gob):
            yield from _levels(resolve(member.path))


def game_of(member: Member, chosen: Game | None) -> Game:
    """The game whose reading applies: what was chosen, or that of the pack's extension."""
    if chosen is not None:
        return chosen
    pack = member.path.rpartition(PACK_SEPARATOR)[0]
    return "mots" if pack.lower().endswith(".goo") else "jk"


def read_level(member: Member, settings: Settings) -> Level:
    """Read one level. Raises InputError when the file cannot be opened; its faults are in `diagnostics`."""
    game = game_of(member, settings.game)
    return Level(read(member.read(), game, strict_grammar=settings.strict_grammar))


def load(path: str, game: Game | None = None) -> Level:
    """Read the one level that a path names, as `masspack.gob!jkl/lagoon.jkl`.

    Raises InputError when the path cannot be opened, is no level, or holds several. What is wrong inside the level
    is in `Level.diagnostics`.
    """
    levels = discover(path)
    if len(levels) > 1:
        raise InputError(f"{path} holds {len(levels)} levels: name one of {_listed(m.path for m in levels)}")
    level = read_level(levels[0], Settings(game))
    if not level.document.sections:
        raise InputError(f"cannot read {levels[0].path}: it has no SECTION: lines, so it is no level")
    return level


def _listed(paths: Iterable[str], most: int = 5) -> str:
    names: Sequence[str] = list(paths)
    return ", ".join(names[:most]) + (", ..." if len(names) > most else "")
