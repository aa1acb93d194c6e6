"""`jktools sight`."""

from __future__ import annotations

import click

from jktools.cli.app import base_option
from jktools.facts.sightline import EndpointError, describe, sightline
from jktools.geometry import SectorMesh
from jktools.session import load
from jktools.session.settings import Game


@click.command("sight")
@click.argument("level", metavar="LEVEL")
@click.argument("a", metavar="A")
@click.argument("b", metavar="B")
@click.option("--game", type=click.Choice(["jk", "mots"]), default=None, help="The game whose reading applies.")
@base_option
def command(level: str, a: str, b: str, game: Game | None, base: tuple[str, ...]) -> int:
    """Explain whether B is seen from A: the sectors crossed, and what blocks. Walls only.

    A and B are things by number, or points as x,y,z (put -- before a negative one).
    """
    loaded = load(level, base, game)
    try:
        found = sightline(loaded, SectorMesh.from_level(loaded), a, b)
    except EndpointError as error:
        raise click.UsageError(str(error)) from error
    click.echo("\n".join(describe(loaded, found)))
    return 0
