"""JK741: particles whose least radius is above the greatest."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.own_line import own_origin
from jktools.facts.particles import own_clouds
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK741", "minsize-over-range", severity=Severity.WARNING, since="0.1.0")
def minsize_over_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing of type particle whose `minsize` is greater than its `range`.

    ## Why it matters
    Particles start between the radii `minsize` and `range`. Where the first is greater, the decompiled engine puts all
    of them at `minsize`, on one sphere, and draws none of them while the ball of radius `range` is out of the picture:
    at the edge of the screen the cloud vanishes. By the words of the research document they lie between the two.
    Negative values are JK743, and a cloud from a PAR file has its places from there.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 minsize=.2

    ## Good
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.2 minsize=.1
    """
    for cloud in own_clouds(level):
        held, made = cloud.template, cloud.particles
        place = own_origin(held, "minsize", "range")
        known = "range" in held.values or not held.leaves_level
        if place is not None and known and made.minsize > made.range >= 0:
            least, most = told_apart(made.minsize, made.range)
            yield Finding(
                Label(place.span),
                f"{held.owner.title} has minsize {least}, but range {most}",
                "swap the two, or leave minsize out",
                held.owner.subject,
            )
