"""JK546: the value of what gives none."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Call, Name
from jktools.syntax.cog.nodes import Expression as Whole
from jktools.syntax.cog.walk import expressions, operands


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
    used: list[Whole] = []
    for statement in program.statements:
        for whole in expressions(statement):
            dropped = (getattr(statement, part, None) for part in ("expression", "first", "step"))
            if not any(whole is each for each in dropped):
                used.append(whole)
    for part in program.expressions:
        used += operands(part)
    for part in used:
        if isinstance(part, Call) and isinstance(part.callee, Name):
            verb = program.verb_of(part)
            if verb is not None and not verb.gives:
                yield Finding(
                    facts.label(part),
                    f"{verb.name} gives no value, but one is used here",
                    f"its form is {verb.signature}",
                )
