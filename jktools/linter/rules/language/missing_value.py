"""JK546: the value of what gives none."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK546", "missing-value", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def missing_value(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report the use of a value where a verb gives none.

    ## Why it matters
    Whoever takes the value takes what lay on the stack before, or -1 if it is empty. Calls of names that are no verbs
    have rules of their own.

    ## Bad
        symbols
        message startup
        int done local
        end
        code
        startup:
            done = SetPulse(1.0);
            return;
        end

    ## Good
        symbols
        message startup
        int done local
        end
        code
        startup:
            SetPulse(1.0);
            done = 1;
            return;
        end
    """
    program = facts.program
    for call, verb in program.calls:
        if not verb.gives and call not in program.dropped:
            yield Finding(
                facts.label(call),
                f"{verb.name} gives no value, but one is used here",
                f"its form is {verb.signature}",
            )
