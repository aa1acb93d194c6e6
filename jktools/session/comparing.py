"""Opens what can be compared: compiled levels, and sources, which are compiled on the way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import get_args

from jktools.compiler import CompiledFileError, CompiledLevel, CompileSettings, compile_level, open_compiled
from jktools.compiler.mapping import is_compiled
from jktools.engine.profile import Engine
from jktools.geometry import Accuracy
from jktools.session.levels import load
from jktools.session.settings import Game


def open_both(
    before: str, after: str, base: Sequence[str], game: Game | None, settings: CompileSettings
) -> tuple[CompiledLevel, CompiledLevel]:
    """Open two levels. A source is compiled as the compiled one beside it was, else with `settings`.

    Raises InputError when one cannot be read, CompileError when a source cannot be compiled.
    """
    opened = [open_compiled(path) if is_compiled(path) else None for path in (before, after)]
    example = next((each for each in opened if each is not None), None)
    if example is not None:
        game, settings = game or game_of(example), settings_of(example)
    first, second = (
        each or compile_source(path, base, game, settings) for path, each in zip((before, after), opened, strict=True)
    )
    return first, second


def compile_source(path: str, base: Sequence[str], game: Game | None, settings: CompileSettings) -> CompiledLevel:
    """Compile the one level that a path names, and open it."""
    return CompiledLevel(compile_level(load(path, base, game), settings), path)


def game_of(level: CompiledLevel) -> Game:
    """The game that a level was compiled for."""
    return "mots" if level.settings["game"] == "mots" else "jk"


def settings_of(level: CompiledLevel) -> CompileSettings:
    """What a level was compiled with. Raises CompiledFileError for settings that this version does not know."""
    recorded = level.settings
    accuracy = next((each for each in get_args(Accuracy) if each == recorded["accuracy"]), None)
    known = {each.value for each in Engine}
    if accuracy is None or recorded["engine"] not in known:
        told = ", ".join(f"{key} {value}" for key, value in recorded.items())
        raise CompiledFileError(f"cannot compile again as {level.path} was, for {told}: use the jktools that wrote it")
    return CompileSettings(
        recorded["engine"], accuracy, frozenset(level.only), frozenset(level.skip), cut_anyway=level.cut_anyway,
        plain=level.plain,
    )  # fmt: skip
