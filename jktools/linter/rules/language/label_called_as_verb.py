"""JK538: a label called as if it were a verb."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script


@rule("JK538", "label-called-as-verb", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def label_called_as_verb(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a label with parentheses behind it, as if it were a verb.

    ## Why it matters
    Labels run by `call name;`. With parentheses the engine looks for a verb of this name, finds none, and does nothing.

    ## Bad
        startup:
            opendoor();
            return;
        opendoor:
            Print("open");
            return;

    ## Good
        startup:
            call opendoor;
            return;
        opendoor:
            Print("open");
            return;
    """
    program = facts.program
    for name, places in program.called.items():
        if name in program.labels and program.role_of(name) is not Role.VERB:
            for place in places:
                yield Finding(
                    facts.label(place), f'"{name}" is a label, but is called as a verb', f'write "call {name};"'
                )
