"""JK418: a movement radius that an actor or player does not take."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Reason
from jktools.syntax.template.values import ValueKind, scan


@rule("JK418", "movesize-passed-over", severity=Severity.WARNING, since="0.1.0")
def movesize_passed_over(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an actor or player whose line has a `movesize` other than the one that it moves with.

    ## Why it matters
    For actors and players the engine passes over `movesize`: they move with the radius of `size`. A body that is meant
    to be wider or narrower than it is meets walls elsewhere.

    ## Bad
        World templates 4
        giant none type=actor size=.065 movesize=.2

    ## Good
        World templates 4
        giant none type=actor size=.2 movesize=.2
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        for ignored in held.ignored:
            wanted = scan(ValueKind.FLOAT, ignored.text)
            size = held.values.get("movesize")
            if ignored.reason is not Reason.FIXED_SIZE or (size is not None and size.value in (None, wanted)):
                continue
            yield Finding(
                Label(ignored.origin.span),
                f"{held.owner.title} has {ignored.origin.span.text}, but moves with {held.number('movesize'):g} JKU",
                "set size, which sets both",
                held.owner.subject,
            )
