"""JK556: a call whose only effect is its value, which is not used."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Call, ExprStatement


@rule("JK556", "unused-result", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def unused_result(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a call that does nothing but give a value, when nothing takes it.

    ## Why it matters
    The line does nothing. Mostly the assignment in front is missing.

    ## Bad
        symbols
        message startup
        thing player local
        end
        code
        startup:
            GetLocalPlayerThing();
            DestroyThing(player);
            return;
        end

    ## Good
        symbols
        message startup
        thing player local
        end
        code
        startup:
            player = GetLocalPlayerThing();
            DestroyThing(player);
            return;
        end
    """
    for statement in facts.program.of_kind(ExprStatement):
        if isinstance(statement.expression, Call):
            verb = facts.program.verb_of(statement.expression)
            if verb is not None and verb.pure and verb.sight is None:
                yield Finding(
                    facts.label(statement.expression),
                    f"{verb.name} does nothing but give a value, but nothing takes it",
                    "assign the value, or remove the line",
                )
