"""Which configuration applies to which path, and what the command line changes in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from jktools.session import Config, Settings, find_config, load_config
from jktools.session.settings import Game

NO_CONFIG = "none"


def configured(paths: Sequence[str], config: str | None) -> Iterator[tuple[list[str], Config]]:
    """Groups of paths that share a configuration, in the order of the paths. Raises ConfigError."""
    groups: dict[Path | None, list[str]] = {}
    for path in paths:
        groups.setdefault(_chosen(path, config), []).append(path)
    for found, group in groups.items():
        yield group, Config() if found is None else load_config(found)


def _chosen(path: str, config: str | None) -> Path | None:
    if config is None:
        return find_config(path)
    return None if config == NO_CONFIG else Path(config)


def overridden(
    settings: Settings,
    game: Game | None,
    base: tuple[str, ...],
    strict_grammar: bool,
    select: tuple[str, ...] = (),
    ignore: tuple[str, ...] = (),
) -> Settings:
    """What the command line says wins; what it ignores is ignored besides what the configuration does.

    What it selects runs even where the configuration ignores it.
    """
    return replace(
        settings,
        game=game or settings.game,
        base=base or settings.base,
        select=select or settings.select,
        ignore=ignore if select else (*settings.ignore, *ignore),
        strict_grammar=strict_grammar,
    )
