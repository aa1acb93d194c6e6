"""JK550: an assignment to a verb or to a message that is not declared."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script


@rule("JK550", "shared-name-assigned", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def shared_name_assigned(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an assignment to a verb, or to a message that the symbols do not declare.

    ## Why it matters
    Verbs and messages lie in one table that all scripts share, and the engine lets a script write there: the verb or
    the message is then gone for every script of the game until it is started anew.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            activate = 1;
            return;
        end

    ## Good
        symbols
        message startup
        int active local
        end
        code
        startup:
            active = 1;
            return;
        end
    """
    program = facts.program
    for name, places in program.assigned.items():
        role = program.role_of(name)
        if role in (Role.VERB, Role.MESSAGE):
            kind = "verb" if role is Role.VERB else "message"
            for place in places:
                yield Finding(
                    facts.label(place),
                    f'"{name}" is a {kind} that all scripts share, but is assigned here',
                    "declare a symbol of another name and assign that",
                )
