"""What a user can choose for a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Game = Literal["jk", "mots"]
GAMES: tuple[Game, ...] = get_args(Game)


@dataclass(frozen=True, slots=True)
class Settings:
    """One run's choices; the defaults are those of the command line."""

    game: Game | None = None
    """None: Mysteries of the Sith for what comes from a GOO, Jedi Knight for the rest."""
    select: tuple[str, ...] = ()
    """Codes, prefixes of codes or names of rules; none means all."""
    ignore: tuple[str, ...] = ()
