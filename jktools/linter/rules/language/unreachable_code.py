"""JK553: code that nothing leads to."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK553", "unreachable-code", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def unreachable_code(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report code that nothing leads to: behind a `return`, `stop` or `goto`, or above the first label.

    ## Why it matters
    It never runs, though somebody wrote it to. Often a label is missing above it, or a `return` is one line too early.

    ## Bad
        startup:
            Print("start");
            return;
            Print("never");

    ## Good
        startup:
            Print("start");
            Print("then");
            return;
    """
    if not facts.is_whole:
        return
    for statement in facts.reach.dead:
        if facts.is_doubtful(statement.start, statement.start + 1):
            continue
        above = facts.reach.flow.blocks[0]
        early = statement in above.statements
        yield Finding(
            facts.label(statement),
            "no label leads here, so that this never runs" if early else "nothing leads here, so that this never runs",
            "put a label above it" if early else "remove it, or what ends the code above",
        )
