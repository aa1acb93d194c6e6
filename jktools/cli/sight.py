"""`jktools sight`."""

from __future__ import annotations

import click

from jktools.cli.app import base_option
from jktools.facts.scene import scene, tell
from jktools.facts.sightline import EndpointError, describe, sightline
from jktools.geometry import SectorMesh
from jktools.session import load
from jktools.session.settings import Game


@click.command("sight")
@click.argument("level", metavar="LEVEL")
@click.argument("a", metavar="A")
@click.argument("b", metavar="B")
@click.option("--game", type=click.Choice(["jk", "mots"]), default=None, help="The game whose reading applies.")
@click.option("--things/--no-things", default=True, help="Whether things block, or walls only.")
@base_option
def command(level: str, a: str, b: str, game: Game | None, things: bool, base: tuple[str, ...]) -> int:
    """Explain whether B is seen from A: the sectors crossed, and what blocks.

    Any solid thing in the way blocks (research document); one that moves or that a COG may change gives "varies".

    A and B are things by number, or points as x,y,z (put -- before a negative one).
    """
    loaded = load(level, base, game)
    try:
        mesh = SectorMesh.from_level(loaded)
        lines = tell(loaded, scene(loaded, mesh, a, b)) if things else describe(loaded, sightline(loaded, mesh, a, b))
    except EndpointError as error:
        raise click.UsageError(str(error)) from error
    click.echo("\n".join(lines))
    return 0
