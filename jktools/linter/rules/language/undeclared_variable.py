"""JK559: a variable that is assigned but not declared."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script


@rule("JK559", "undeclared-variable", severity=Severity.INFO, since="0.1.0", on=False, looks_at=Script)
def undeclared_variable(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a variable that the code assigns, but that the symbols do not declare.

    ## Why it matters
    It works: the engine declares it on the spot. But a misspelt name then makes a second variable. It is off by
    default, since many scripts rely on it; JK530 reports names that are never assigned.

    ## Bad
        symbols
        message startup
        int count local
        end
        code
        startup:
            cuont = 1;
            return;
        end

    ## Good
        symbols
        message startup
        int count local
        end
        code
        startup:
            count = 1;
            return;
        end
    """
    program = facts.program
    declared = [name for name, slot in program.slot_of.items() if slot.declared is not None]
    for name, places in program.assigned.items():
        if program.role_of(name) is Role.IMPLICIT:
            yield Finding(
                facts.label(places[0]),
                f'"{name}" is assigned, but not declared',
                did_you_mean(name, declared) or "declare it in the symbols",
            )
