"""JK742: a particle flag that does nothing."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.engine.particle_template import ParticleFlag
from jktools.facts import LevelFacts
from jktools.facts.own_line import own_origin, templates_and_things
from jktools.facts.particles import PARTICLE
from jktools.linter.rule import Finding, rule
from jktools.model import Level

WITHOUT_EFFECT = int(ParticleFlag.UNUSED_2 | ParticleFlag.UNUSED_40)


@rule("JK742", "particle-flag-without-effect", severity=Severity.INFO, since="0.1.0", on=False)
def particle_flag_without_effect(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing of type particle with a typeflag that does nothing: 0x2 or 0x40.

    ## Why it matters
    JKSpecs calls 0x2 the animation of cels, but neither the tests of the research document nor the decompiled engine
    show an effect: 0x20 lets the cels run. Most of the game's own templates have 0x2, so this rule is off.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 typeflags=0x2

    ## Good
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 typeflags=0x20
    """
    for held in templates_and_things(level):
        place = own_origin(held, "typeflags")
        idle = held.flags("typeflags") & WITHOUT_EFFECT
        if held.type == PARTICLE and idle and place is not None:
            yield Finding(
                Label(place.span),
                f"{held.owner.title} has typeflags={held.values['typeflags'].text}, but 0x{idle:x} does nothing",
                "leave it out; 0x20 lets the cels run",
                held.owner.subject,
            )
