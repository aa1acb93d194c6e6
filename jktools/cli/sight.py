"""`jktools sight`."""

from __future__ import annotations

import click

from jktools.facts.sightline import EndpointError, describe, sightline
from jktools.geometry.mesh import SectorMesh
from jktools.model import Level
from jktools.source import Member, resolve
from jktools.syntax.jkl import read


@click.command("sight")
@click.argument("level", metavar="LEVEL")
@click.argument("a", metavar="A")
@click.argument("b", metavar="B")
def command(level: str, a: str, b: str) -> int:
    """Explain whether B is seen from A: the sectors crossed, and what blocks. Walls only.

    A and B are things by number, or points as x,y,z (put -- before a negative one).
    """
    target = resolve(level)
    if not isinstance(target, Member):
        raise click.UsageError(f"{level} is no level; name one member of a pack as {level}!NAME")
    loaded = Level(read(target.read()))
    try:
        found = sightline(loaded, SectorMesh.from_level(loaded), a, b)
    except EndpointError as error:
        raise click.UsageError(str(error)) from error
    click.echo("\n".join(describe(loaded, found)))
    return 0
