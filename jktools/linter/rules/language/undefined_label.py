"""JK537: a goto or call of a label that does not exist."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Goto


@rule("JK537", "undefined-label", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def undefined_label(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a `goto` or `call` of a label that the script does not have.

    ## Why it matters
    The engine says nothing: such a `goto` ends the handler, such a `call` does nothing.

    ## Bad
        startup:
            call opendor;
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
    if not facts.is_whole:
        return
    for jump in program.jumps:
        name = jump.label.name
        if name not in program.labels:
            effect = "ends the handler" if isinstance(jump, Goto) else "does nothing"
            yield Finding(
                facts.label(jump.label),
                f'there is no label "{name}", so that this {"goto" if isinstance(jump, Goto) else "call"} {effect}',
                did_you_mean(name, program.labels) or "name a label of the script",
            )
