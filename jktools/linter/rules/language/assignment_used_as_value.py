"""JK524: an assignment whose value is used."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Assign, Binary, DoWhile, For, If, While
from jktools.syntax.cog.walk import expressions, operands


@rule("JK524", "assignment-used-as-value", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def assignment_used_as_value(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an assignment in a condition, an argument or another assignment.

    ## Why it matters
    In COG an assignment has no value. `if (x = 1)` tests what lay on the stack before, and on an empty one -1, which is
    true; `x = y = 0` stores x, or nothing, and never 0.

    ## Bad
        startup:
            if (x = 1) stop;

    ## Bad
        startup:
            x = y = 0;

    ## Good
        startup:
            if (x == 1) stop;
            y = 0;
            x = 0;
    """
    program = facts.program
    if program.dropped.issuperset(program.of_kind(Assign)):
        return
    for statement in program.statements:
        for whole in expressions(statement):
            condition = isinstance(statement, If | While | DoWhile) or (
                isinstance(statement, For) and whole is statement.condition
            )
            used = [(whole, condition)]
            while used:
                part, needed = used.pop()
                if isinstance(part, Assign) and needed:
                    yield Finding(
                        facts.label(part),
                        "the value of an assignment is used here, but an assignment has none",
                        "write == if a comparison is meant" if condition else "assign in a statement of its own",
                    )
                parts = operands(part)
                comma = isinstance(part, Binary) and part.op == ","
                used += ((p, (needed and p is parts[-1]) if comma else True) for p in reversed(parts))
