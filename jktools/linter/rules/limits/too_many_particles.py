"""JK805: a particle template with more particles than the engine draws."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level, Template, Thing

MOST_PARTICLES = 256
"""Vertices of one particle cloud (rdParticle.h in the decompiled engine)."""


@rule("JK805", "too-many-particles", severity=Severity.ERROR, since="0.1.0")
def too_many_particles(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing of type particle with a `count` above 256.

    ## Why it matters
    The engine draws a cloud from an array of 256 and does not look at the count: it overwrites memory.

    ## Bad
        World templates 4
        rain none type=particle count=300

    ## Good
        World templates 4
        rain none type=particle count=256
    """
    owners: list[tuple[Template | Thing, str | None]] = [
        *zip(level.templates, facts.template_types, strict=True),
        *zip(level.things, facts.thing_types, strict=True),
    ]
    for owner, type_ in owners:
        counts = [value for key, value in owner.parameters if key.lower() == "count"]
        if type_ != "particle" or not counts:
            continue
        count = re.match(r"\+?(\d+)", counts[-1])
        if count is not None and int(count.group(1)) > MOST_PARTICLES:
            yield Finding(
                Label(owner.span),
                f"{owner.title} has count={counts[-1]}, but the engine draws at most {MOST_PARTICLES} particles",
                "lower the count, or use several clouds; the engine overwrites memory",
                owner.subject,
            )
