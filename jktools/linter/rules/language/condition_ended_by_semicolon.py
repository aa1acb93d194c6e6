"""JK529: a semicolon behind a condition."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Empty, If


@rule("JK529", "condition-ended-by-semicolon", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def condition_ended_by_semicolon(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a semicolon directly behind the parentheses of `if`.

    ## Why it matters
    It is the whole body: what follows runs whether the condition holds or not.

    ## Bad
        startup:
            if (x == 1);
                stop;

    ## Good
        startup:
            if (x == 1)
                stop;
    """

    for statement in facts.program.of_kind(If):
        then = statement.then
        if not isinstance(then, Empty) or statement.otherwise is not None:
            continue
        if not facts.is_doubtful(statement.condition.end + 1, then.end):
            yield Finding(
                facts.label(then),
                "the semicolon is all that the if decides about, but more seems to be meant",
                "remove the semicolon",
            )
