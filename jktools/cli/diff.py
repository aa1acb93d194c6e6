"""`jktools diff`."""

from __future__ import annotations

import click

from jktools.cli.app import problem
from jktools.cli.options import accuracy_option, base_option, engine_option, game_option
from jktools.cli.status import Status
from jktools.compiler import CompileError, CompileSettings
from jktools.compiler.comparison import compare
from jktools.emit import difference
from jktools.geometry.mesh import Accuracy
from jktools.session.comparing import open_both
from jktools.session.settings import Game


@click.command("diff")
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON, with every record.")
@click.option("--all", "whole", is_flag=True, help="Show every record that differs, not the first ten of a kind.")
@engine_option("Whose word counts where both are sources.")
@accuracy_option("How true and how slow what is computed is where both are sources.")
@game_option
@base_option
def command(
    before: str,
    after: str,
    as_json: bool,
    whole: bool,
    engine: str,
    accuracy: Accuracy,
    game: Game | None,
    base: tuple[str, ...],
) -> int:
    """Tell what differs between two levels: geometry, things, templates, COGs, and all that is computed of them.

    A and B are compiled levels (.jklb) or sources (`pack.gob!jkl/x.jkl`). A source is compiled on the way, beside a
    compiled level with that one's settings. Records are matched by number where both have as many of a kind, else by
    content.

    Exit status: 0 no difference, 1 some, 2 bad usage or a level that cannot be read or compiled.
    """
    try:
        levels = open_both(before, after, base, game, CompileSettings(engine, accuracy))
    except CompileError as error:
        problem(str(error))
        return Status.USAGE
    found = compare(*levels)
    if as_json:
        click.echo(difference.json((before, after), found), nl=False)
    else:
        click.echo("\n".join(difference.text((before, after), found, whole=whole)))
    return Status.FINDINGS if found else Status.CLEAN
