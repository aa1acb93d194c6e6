"""JK525: an assignment to what is no variable."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Assign, Index, Name


@rule("JK525", "assignment-to-value", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def assignment_to_value(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an assignment whose target is neither a name nor a name with an index.

    ## Why it matters
    The engine's grammar takes `1 = 2` and `f(x) = 2`. Running it stores the value in whatever the number on the stack
    happens to name.

    ## Bad
        startup:
            GetThingHealth(player) = 100;

    ## Good
        startup:
            health[1] = 100;
    """

    for part in facts.program.of_kind(Assign):
        base = part.target.base if isinstance(part.target, Index) else part.target
        if not isinstance(base, Name):
            yield Finding(
                facts.label(part.target),
                "the target of the assignment is a value, but only a variable can be assigned",
                "assign to a name or a name with an index",
            )
