"""JK526: a label inside a block."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Labeled
from jktools.syntax.cog.walk import parts, statements


@rule("JK526", "label-inside-block", severity=Severity.INFO, since="0.1.0", on=False, looks_at=Script)
def label_inside_block(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a label that stands inside a block, a loop or an if.

    ## Why it matters
    The engine allows it: a message or a `goto` then starts in the middle of the block. It is rarely meant; mostly a
    brace above is missing.

    ## Bad
        startup:
        {
            x = 1;
        done:
            stop;
        }

    ## Good
        startup:
        {
            x = 1;
        }
        done:
            stop;
    """

    outer = list(script.code.body)
    while outer:
        statement = outer.pop()
        if isinstance(statement, Labeled):
            outer.append(statement.statement)
            continue
        for inner in statements(parts(statement)):
            if isinstance(inner, Labeled):
                yield Finding(
                    facts.label(inner.label),
                    f"the label {inner.label.name} stands inside a block, but handlers start outside of one",
                    "close the block before the label",
                )
