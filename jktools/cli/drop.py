"""`jktools drop`."""

from __future__ import annotations

import click

from jktools.cli.app import base_option
from jktools.facts.fall import fall, tell_fall
from jktools.facts.sightline import EndpointError
from jktools.geometry import SectorMesh
from jktools.session import load
from jktools.session.settings import Game


@click.command("drop")
@click.argument("level", metavar="LEVEL")
@click.argument("start", metavar="START")
@click.option("--game", type=click.Choice(["jk", "mots"]), default=None, help="The game whose reading applies.")
@base_option
def command(level: str, start: str, game: Game | None, base: tuple[str, ...]) -> int:
    """Tell what is straight below START: the floor, by sector. Things that can be stood on are no part of it.

    START is a thing by number, or a point as x,y,z (put -- before a negative one).
    """
    loaded = load(level, base, game)
    try:
        top, found = fall(loaded, SectorMesh.from_level(loaded), start)
    except EndpointError as error:
        raise click.UsageError(str(error)) from error
    click.echo("\n".join(tell_fall(loaded, top, found)))
    return 0
