"""JK412: a value that the engine does not take."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Reason
from jktools.model.wanted import wanted_value


@rule("JK412", "parameter-value-rejected", severity=Severity.WARNING, since="0.1.0")
def parameter_value_rejected(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a value of a parameter that the engine does not take.

    ## Why it matters
    Sizes, masses and times below 0, a `collide` other than 0 to 3, flags that are no hexadecimal number, vectors with
    too few parts: the engine keeps what the thing had before, mostly 0, and says nothing. A `numframes` is left to
    frames-ignored.

    ## Bad
        World templates 4
        ball crate size=-.1

    ## Bad
        World templates 4
        ball crate orient=0/90/0

    ## Good
        World templates 4
        ball crate size=.1 orient=(0/90/0)
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        for ignored in held.ignored:
            if ignored.reason is Reason.REJECTED and ignored.key != "numframes":
                yield Finding(
                    Label(ignored.origin.span),
                    f"{held.owner.title} has {ignored.origin.span.text}, but the engine takes {wanted_value(ignored)}",
                    "write such a value; the engine keeps what the thing had before",
                    held.owner.subject,
                )
