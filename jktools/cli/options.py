"""The options that several commands have, each declared once."""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable
from typing import Any

import click


def need_matplotlib() -> None:
    """Raise UsageError before anything is computed for a picture that cannot be drawn."""
    if importlib.util.find_spec("matplotlib") is None:
        raise click.UsageError("--output needs matplotlib: pip install 'jktools[plot]'")


class Number(click.FloatRange):
    """A finite number of a range: `nan` is in every range, and `inf` in those without an end."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number. Raises BadParameter."""
        number = super().convert(value, param, ctx)
        if not math.isfinite(number):
            self.fail(f"{value} is not finite", param, ctx)
        return number


base_option = click.option(
    "--base", multiple=True, metavar="PATH",
    help="A folder or pack with the game's own files, searched after the level's own. May be repeated.",
)  # fmt: skip

game_option = click.option(
    "--game", type=click.Choice(["jk", "mots"]), default=None,
    help="The game whose reading applies. [default: mots for a GOO, else jk]",
)  # fmt: skip


def engine_option(help: str) -> Callable[[Any], Any]:
    """The profile of engine rules."""
    return click.option(
        "--engine", type=click.Choice(["research", "openjkdf2"]), default="research", show_default=True, help=help
    )


def accuracy_option(help: str) -> Callable[[Any], Any]:
    """The tier of what is computed."""
    return click.option(
        "--accuracy", type=click.Choice(["fast", "balanced", "exact"]), default="balanced", show_default=True, help=help
    )


def common(function: Any) -> Any:
    """The options that every command over levels has."""
    options = (
        game_option,
        base_option,
        click.option(
            "--config", metavar="FILE", default=None,
            help="The configuration to use, or none for none. [default: jktools.toml found upward from each PATH]",
        ),
        click.option("--strict-grammar", is_flag=True, help="Read every record with the grammar: slow, same result."),
    )  # fmt: skip
    for option in reversed(options):
        function = option(function)
    return function
