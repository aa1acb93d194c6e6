"""JK523: a statement that computes something and keeps nothing."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Assign, Binary, Call, ExprStatement, Name
from jktools.syntax.cog.walk import postorder


@rule("JK523", "statement-without-effect", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def statement_without_effect(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a statement that is neither a call nor an assignment.

    ## Why it matters
    It does nothing: mostly `==` stands for `=`, or the parentheses of a call are missing. A verb without parentheses is
    JK539's.

    ## Bad
        startup:
            x == 1;

    ## Good
        startup:
            x = 1;
    """
    for statement in facts.program.of_kind(ExprStatement):
        if facts.is_doubtful(statement.start, statement.end):
            continue
        parts = [statement.expression]
        while parts:
            part = parts.pop()
            if isinstance(part, Binary) and part.op == ",":
                parts += (part.right, part.left)
            elif isinstance(part, Name) and facts.program.role_of(part.name) is Role.VERB:
                continue
            elif not isinstance(part, Assign | Call) and not any(isinstance(p, Assign | Call) for p in postorder(part)):
                comparison = isinstance(part, Binary) and part.op == "=="
                yield Finding(
                    facts.label(part),
                    "the statement compares two values, but does nothing with the answer" if comparison
                    else "the statement has a value, but does nothing with it",
                    "write = if an assignment is meant" if comparison else "remove it, or assign the value",
                )  # fmt: skip
