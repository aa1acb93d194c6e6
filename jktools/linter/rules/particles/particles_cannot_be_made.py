"""JK744: a cloud of particles that ends the game when it is created."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.own_line import own_origin
from jktools.facts.particles import Cloud
from jktools.linter.particles import new_faults
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK744", "particles-cannot-be-made", severity=Severity.ERROR, since="0.1.0")
def particles_cannot_be_made(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing of type particle that the level can reach, without a material or with a count below 0.

    ## Why it matters
    When it creates the cloud, the decompiled engine counts the cels of the material without a look whether there is
    one, and asks for memory for the count as a number without a sign. Either ends the game. A cloud from a PAR file
    has both from there.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 count=64 range=.1 elementsize=.01
        World things 4
        2: smoke smoke .5 .5 .5 0 0 0 0

    ## Good
        World templates 4
        smoke none type=particle timer=1 count=64 range=.1 elementsize=.01 material=00gsmoke.mat
        World things 4
        2: smoke smoke .5 .5 .5 0 0 0 0
    """
    for cloud, key in new_faults(level, facts.reach, _broken):
        held = cloud.template
        own = own_origin(held, key)
        has = "no material" if key == "material" else f"count={held.values['count'].text}"
        wants = "a material" if key == "material" else "a count from 0 to 256"
        yield Finding(
            Label(held.owner.head_span if own is None else own.span),
            f"{held.owner.title} makes particles with {has}, but the decompiled engine crashes without {wants}",
            f"give it {wants}",
            held.owner.subject,
        )


def _broken(cloud: Cloud) -> str | None:
    if cloud.material is None:
        return "material"
    return "count" if cloud.particles.count < 0 else None
