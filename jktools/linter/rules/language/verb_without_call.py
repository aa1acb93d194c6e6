"""JK539: a verb named without parentheses."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script


@rule("JK539", "verb-without-call", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def verb_without_call(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a verb that is named without parentheses.

    ## Why it matters
    The name alone calls nothing: its value is some number that is never 0.

    ## Bad
        startup:
            if (IsMulti) return;
            Print("alone");
            return;

    ## Good
        startup:
            if (IsMulti()) return;
            Print("alone");
            return;
    """
    program = facts.program
    for name, places in program.read.items():
        if program.role_of(name) is Role.VERB:
            for place in places:
                yield Finding(
                    facts.label(place),
                    f'"{name}" is a verb, but nothing calls it here',
                    f"write {name}({'...' * bool(facts.vocabulary.verbs[name].args)})",
                )
