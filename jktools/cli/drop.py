"""`jktools drop`."""

from __future__ import annotations

import click

from jktools.cli.options import base_option, game_option
from jktools.facts.fall import fall, tell_fall
from jktools.facts.sightline import EndpointError
from jktools.session import load
from jktools.session.settings import Game


@click.command("drop")
@click.argument("level", metavar="LEVEL")
@click.argument("start", metavar="START")
@game_option
@click.option("--things/--no-things", default=True, help="Whether things carry, or surfaces only.")
@base_option
def command(level: str, start: str, game: Game | None, things: bool, base: tuple[str, ...]) -> int:
    """Tell what is straight below START: the floor, by sector, and things that bodies stand on.

    A thing of type cog with thing flag 0x40 and collide 3 carries on its faces, where it is placed; that one may be
    there at one of its frames is told too. Without its model what is beneath it is unknown.

    LEVEL is a source: a compiled level does not hold the faces of models. Of surfaces alone it answers from Python and
    C++ (`CompiledLevel.mesh`, runtime/README.md).

    START is a thing by number, or a point as x,y,z (put -- before a negative one).
    """
    loaded = load(level, base, game)
    try:
        top, found = fall(loaded, start, things=things)
    except EndpointError as error:
        raise click.UsageError(str(error)) from error
    click.echo("\n".join(tell_fall(loaded, top, found)))
    return 0
