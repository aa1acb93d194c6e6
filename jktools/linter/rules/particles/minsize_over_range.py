"""JK741: particles whose least radius is above the greatest."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.particles import clouds
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK741", "minsize-over-range", severity=Severity.WARNING, since="0.1.0")
def minsize_over_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template of type particle whose `minsize` is greater than its `range`.

    ## Why it matters
    Particles start between the radii `minsize` and `range`. Where the first is greater, the decompiled engine puts all
    of them at `minsize`, on one sphere far from the thing; by the words of the research document they lie between the
    two. Neither is a cloud of that range.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.1 minsize=.2

    ## Good
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat count=64 elementsize=.01 range=.2 minsize=.1
    """
    for cloud in clouds(level):
        held, made = cloud.template, cloud.particles
        setting = held.values.get("minsize")
        own = [held.values[key].origins[0] for key in ("minsize", "range") if key in held.values]
        place = next((origin for origin in own if origin.owner == held.owner), None)
        if setting is not None and place is not None and made.minsize > made.range:
            yield Finding(
                Label(place.span),
                f"{held.owner.title} has minsize {made.minsize:.6g}, but range {made.range:.6g}",
                "swap the two, or leave minsize out",
                held.owner.subject,
            )
