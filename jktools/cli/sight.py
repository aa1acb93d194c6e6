"""`jktools sight`."""

from __future__ import annotations

import click

from jktools.cli.options import base_option, engine_option, game_option
from jktools.engine.profile import Engine
from jktools.facts.level import LevelFacts
from jktools.facts.scene import scene, tell
from jktools.facts.sightline import EndpointError
from jktools.session import load
from jktools.session.settings import Game


@click.command("sight")
@click.argument("level", metavar="LEVEL")
@click.argument("a", metavar="A")
@click.argument("b", metavar="B")
@game_option
@engine_option("The research document's rules, or those of the decompiled engine.")
@click.option("--things/--no-things", default=True, help="Whether things block, or walls only.")
@base_option
def command(level: str, a: str, b: str, game: Game | None, engine: str, things: bool, base: tuple[str, ...]) -> int:
    """Explain whether B is seen from A: the sectors crossed, and what blocks.

    In research any solid thing in the way blocks, in openjkdf2 those of type cog. What moves, or what a COG may change,
    gives "varies".

    LEVEL is a source: a compiled level holds neither the faces of models nor what scripts may change. Past walls alone
    it answers from Python and C++ (`CompiledLevel.mesh`, runtime/README.md).

    A and B are things by number, or points as x,y,z (put -- before a negative one).
    """
    loaded = load(level, base, game)
    try:
        found = scene(LevelFacts.of(loaded), a, b, Engine(engine), things=things)
    except EndpointError as error:
        raise click.UsageError(str(error)) from error
    click.echo("\n".join(tell(loaded, found)))
    return 0
