"""`jktools diff`."""

from __future__ import annotations

import click

from jktools.cli.app import base_option, problem
from jktools.cli.status import Status
from jktools.compiler import CompileError, CompileSettings
from jktools.compiler.comparison import compare
from jktools.emit import difference
from jktools.engine.profile import Engine
from jktools.geometry.mesh import Accuracy
from jktools.session.comparing import open_both
from jktools.session.settings import Game


@click.command("diff")
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON, with every record.")
@click.option("--all", "whole", is_flag=True, help="Show every record that differs, not the first ten of a kind.")
@click.option(
    "--engine", type=click.Choice([e.value for e in Engine]), default=Engine.RESEARCH.value, show_default=True,
    help="Whose word counts where both are sources.",
)  # fmt: skip
@click.option(
    "--accuracy", type=click.Choice(["fast", "balanced", "exact"]), default="balanced", show_default=True,
    help="How true and how slow what is computed is where both are sources.",
)  # fmt: skip
@click.option("--game", type=click.Choice(["jk", "mots"]), default=None, help="The game whose reading applies.")
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
