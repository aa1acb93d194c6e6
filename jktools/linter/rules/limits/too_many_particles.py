"""JK805: a particle template with more particles than the engine draws."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST_PARTICLES = 256
"""Vertices of one particle cloud (rdParticle.h in the decompiled engine)."""


@rule("JK805", "too-many-particles", severity=Severity.ERROR, since="0.1.0")
def too_many_particles(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing of type particle with a `count` above 256.

    ## Why it matters
    The engine draws a cloud from an array of 256 and does not look at the count: it overwrites memory. A cloud from a
    PAR file has its own count, and JK818 looks at that.

    ## Bad
        World templates 4
        rain none type=particle count=300

    ## Good
        World templates 4
        rain none type=particle count=256
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        count = held.values.get("count")
        if count is None or held.number("count") <= MOST_PARTICLES or count.origins[0].owner != held.owner:
            continue
        if held.name_in("particle") is not None:
            continue
        yield Finding(
            Label(count.origins[0].span),
            f"{held.owner.title} has count={count.text}, but the engine draws at most {MOST_PARTICLES} particles",
            "lower the count, or use several clouds; the engine overwrites memory",
            held.owner.subject,
        )
