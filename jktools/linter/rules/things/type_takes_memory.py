"""JK424: a type that reads the parent's values as something else."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK424", "type-takes-memory", severity=Severity.INFO, since="0.1.0", on=False)
def type_takes_memory(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing that changes its parent's `type` or `move`, where the parent set values for those.

    ## Why it matters
    The values of a weapon, an explosion, an actor and so on lie in the same memory, and so do those of physics and of a
    path. A child that changes from one to another does not start afresh: the engine reads the parent's damage as, say,
    a pointer to a template. Types without values of their own, as cog and ghost, do no harm.

    ## Bad
        World templates 5
        +bolt none type=weapon damage=20
        +blast +bolt type=explosion range=1

    ## Good
        World templates 5
        +bolt none type=weapon damage=20
        +blast none type=explosion range=1
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        if not held.lost:
            continue
        first = held.lost[0]
        keys = ", ".join(dict.fromkeys(lost.key for lost in held.lost if lost.origin == first.origin))
        yield Finding(
            Label(first.origin.span),
            f"{held.owner.title} changes to {first.origin.span.text}, but its parent's {keys} "
            f"{'lies' if ',' not in keys else 'lie'} in the same memory",
            "give it another parent; the engine reads those values as others",
            held.owner.subject,
            (Label(first.setting.origins[0].span, f"{first.key} is set here"),),
        )
