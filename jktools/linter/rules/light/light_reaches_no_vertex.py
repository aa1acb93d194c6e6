"""JK730: a light that ends before it reaches a surface."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.lights import still_lights
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK730", "light-reaches-no-vertex", severity=Severity.INFO, since="0.1.0")
def light_reaches_no_vertex(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a thing that shines and does not move, whose light reaches no vertex of a surface.

    ## Why it matters
    The engine lights vertices, not the faces between: a light of intensity i adds to the vertices within i / 0.8 JKU.
    In the middle of a large surface it shows nothing there. Models of things near it are lit still.

    ## Bad
        World templates 4
        lamp none type=cog light=.3
        World things 4
        2: lamp lamp .5 .5 .5 0 0 0 0

    ## Good
        World templates 4
        lamp none type=cog light=1
        World things 4
        2: lamp lamp .5 .5 .5 0 0 0 0
    """
    for light in still_lights(level):
        if not len(light.vertices):
            reach, nearest = told_apart(light.reach, light.nearest)
            yield Finding(
                Label(light.thing.head_span),
                f"{light.thing.title} has light {light.intensity:.6g}, which ends {reach} JKU away, but the "
                f"nearest vertex of a surface is {nearest} JKU away",
                "make it brighter or move it to a vertex, or leave the light out",
                light.thing.subject,
            )
