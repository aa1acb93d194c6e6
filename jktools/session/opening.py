"""Opens a level in either form: its source, or what `jktools build` made of it."""

from __future__ import annotations

from collections.abc import Sequence

from jktools.compiler import CompiledLevel, open_compiled
from jktools.compiler.mapping import is_compiled
from jktools.model import Level
from jktools.session.levels import load
from jktools.session.settings import Game
from jktools.source import InputError


def open_level(path: str, base: Sequence[str] = (), game: Game | None = None) -> Level | CompiledLevel:
    """Open a compiled level, or read the one level that a path names as `load` does.

    Raises InputError when it cannot be read, or when a compiled level comes with a base or a game: both were said when
    it was compiled.
    """
    if not is_compiled(path):
        return load(path, base, game)
    if base or game:
        option = "--base" if base else "--game"
        raise InputError(f"cannot read {path} with {option}: that was said when the level was compiled")
    return open_compiled(path)
