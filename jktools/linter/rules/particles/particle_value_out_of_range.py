"""JK743: a value of a particle template that is outside its range."""

from __future__ import annotations

from collections.abc import Iterator
from types import MappingProxyType

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.particles import clouds
from jktools.linter.rule import Finding, rule
from jktools.model import Level

HALF_CIRCLE = 180.0
RANGES = MappingProxyType(
    {
        "count": (0.0, None),
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
    """Report a value of a template of type particle that is negative, or an angle of more than 180 degrees.

    ## Why it matters
    Sizes, counts and rates below 0 count as 0 or turn the cloud inside out. Angles go to each side, so that 180 is the
    full circle already: a greater one covers part of it twice.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 yawrange=360

    ## Good
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 yawrange=180
    """
    for cloud in clouds(level):
        held = cloud.template
        for key, (least, most) in RANGES.items():
            setting, value = held.values.get(key), held.number(key)
            if setting is None or setting.origins[0].owner != held.owner:
                continue
            if value < least or (most is not None and value > most):
                allowed = f"{least:g} or more" if most is None else f"{least:g} to {most:g}"
                yield Finding(
                    Label(setting.origins[0].span),
                    f"{held.owner.title} has {key}={setting.text}, but it goes from {allowed}"
                    if most is not None
                    else f"{held.owner.title} has {key}={setting.text}, but it is {allowed}",
                    f"write a {key} of {allowed}",
                    held.owner.subject,
                )
