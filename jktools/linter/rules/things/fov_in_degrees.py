"""JK416: a field of view that is no cosine."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK416", "fov-in-degrees", severity=Severity.WARNING, since="0.1.0")
def fov_in_degrees(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an actor or player whose own `fov` is above 1 or below -1.

    ## Why it matters
    The engine compares `fov` with the cosine of the angle between where the actor looks and where a hit comes from
    (sithActor and jkSaber in the decompiled engine), though JKSpecs calls it degrees. No cosine reaches 90: such an
    actor blocks nothing. 45 degrees are 0.71.

    ## Bad
        World templates 4
        guard none type=actor fov=90

    ## Good
        World templates 4
        guard none type=actor fov=.71
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        setting = held.values.get("fov")
        if setting is None or setting.origins[0].owner is not held.owner or abs(held.number("fov")) <= 1:
            continue
        yield Finding(
            Label(setting.origins[0].span),
            f"{held.owner.title} has fov={setting.text}, but fov is a cosine, from -1 to 1",
            "write the cosine of the angle: .71 for 45 degrees, 0 for 90",
            held.owner.subject,
        )
