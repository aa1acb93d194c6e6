"""`jktools template`."""

from __future__ import annotations

from collections.abc import Iterable

import click

from jktools.cli.options import base_option, game_option
from jktools.emit import template as template_format
from jktools.emit.printable import printable
from jktools.linter.spelling import did_you_mean
from jktools.model import Level
from jktools.model.resolved import Resolved
from jktools.session import load
from jktools.session.settings import Game


@click.command("template")
@click.argument("level", metavar="LEVEL")
@click.argument("name", metavar="[NAME]", required=False)
@click.option("--json", "as_json", is_flag=True, help="The same as JSON.")
@game_option
@base_option
def command(level: str, name: str | None, as_json: bool, game: Game | None, base: tuple[str, ...]) -> int:
    """Explain where the values of a template come from: each with the template and the line that set it.

    LEVEL is a level or a template library (.tpl). NAME is a template, or the number of a thing, which shows what its
    line changes. Without NAME, list the templates.
    """
    loaded = load(level, base, game)
    if name is None:
        if as_json:
            raise click.UsageError("--json needs the NAME of a template or the number of a thing")
        _say(template_format.listing(loaded))
        return 0
    held = _found(loaded, name)
    if as_json:
        click.echo(template_format.json(held), nl=False)
    else:
        _say(template_format.text(held))
    return 0


def _say(lines: Iterable[str]) -> None:
    click.echo("\n".join(printable(line) for line in lines))


def _found(level: Level, name: str) -> Resolved:
    """The template that the engine keeps of that name, or the first as written; or the thing of that number."""
    kept = level.resolved_templates.by_name.get(name.lower())
    if kept is not None:
        return kept
    index = level.template_by_name.get(name.lower())
    if index is not None:
        return level.resolved_templates[index]
    if name.isascii() and name.isdigit():
        for thing in level.things:
            if str(thing.number) == name.lstrip("0").rjust(1, "0"):
                return thing.resolved
        raise click.UsageError(f"{level.path} places no thing with number {name}")
    hint = did_you_mean(name, level.template_by_name) or "`jktools template LEVEL` lists them"
    raise click.UsageError(f"{level.path} has no template {name}; {hint}")
