"""JK743: a value of a particle template that is outside its range."""

from __future__ import annotations

from collections.abc import Iterator
from types import MappingProxyType

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.own_line import own_origin
from jktools.facts.particles import own_clouds
from jktools.linter.rule import Finding, rule
from jktools.model import Level

HALF_CIRCLE = 180.0
RANGES = MappingProxyType(
    {
        "range": (0.0, None),
        "minsize": (0.0, None),
        "elementsize": (0.0, None),
        "rate": (0.0, None),
        "maxthrust": (0.0, None),
        "pitchrange": (0.0, HALF_CIRCLE),
        "yawrange": (0.0, HALF_CIRCLE),
    }
)
"""Research document, "Particles": angles to each side, so that 180 is the full circle."""


@rule("JK743", "particle-value-out-of-range", severity=Severity.WARNING, since="0.1.0")
def particle_value_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a value of a template or thing of type particle that is negative, or an angle of more than 180 degrees.

    ## Why it matters
    A negative `elementsize` draws what a positive one does, a negative angle goes to both sides as well; a negative
    `range` or `minsize` puts particles on the far side of the thing, a negative `maxthrust` shrinks the cloud to a
    hundredth and keeps it there, a negative `rate` is the same as 0. Angles go to each side, so that 180 is the full
    circle already: a greater one covers part of it twice. A negative `count` is JK744.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 yawrange=360

    ## Good
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 yawrange=180
    """
    for cloud in own_clouds(level):
        held = cloud.template
        for key, (least, most) in RANGES.items():
            place, value = own_origin(held, key), held.number(key)
            if place is not None and (value < least or (most is not None and value > most)):
                allowed = f"{least:g} or more" if most is None else f"from {least:g} to {most:g}"
                yield Finding(
                    Label(place.span),
                    f"{held.owner.title} has {key}={held.values[key].text}, but a particle's {key} is {allowed}",
                    f"write a value of {allowed}" if most is None else f"write a value {allowed}",
                    held.owner.subject,
                )
