"""JK527: a label that stands twice."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Labeled


@rule("JK527", "duplicate-label", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def duplicate_label(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a label whose name a later one has.

    ## Why it matters
    The later one in the code wins: what follows the first is never run by the message, `call` or `goto` of that name.

    ## Bad
        startup:
            stop;
        startup:
            x = 1;

    ## Good
        startup:
            x = 1;
    """

    for statement in facts.program.of_kind(Labeled):
        last = facts.program.labels[statement.label.name]
        if last is not statement:
            yield Finding(
                facts.label(statement.label),
                f"the label {statement.label.name} stands here, but another one of that name follows, and the last "
                "counts",
                "rename one of them",
                related=(facts.label(last.label, "the last"),),
            )
