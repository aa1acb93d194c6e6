"""JK517: a number that is octal because of its leading zero."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Number


@rule("JK517", "octal-number", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def octal_number(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a number with a leading zero that the engine reads as another one.

    ## Why it matters
    A number that starts with 0 is octal in code: `010` is 8, and `08` and `09` are 0, as 8 and 9 are no octal digits.

    ## Bad
        x = 010;

    ## Good
        x = 10;
        y = 07;
    """

    for part in facts.program.of_kind(Number):
        if part.text.isdigit() and part.text[0] == "0" and len(part.text) > 1:
            decimal = part.text.lstrip("0") or "0"
            if str(part.value) != decimal:
                yield Finding(
                    facts.label(part),
                    f"{part.text} starts with 0, so that the engine reads it as octal: {part.value}",
                    f"write {decimal}",
                )
