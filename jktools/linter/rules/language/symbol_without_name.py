"""JK510: a type word alone."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.header import TYPES


@rule("JK510", "symbol-without-name", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def symbol_without_name(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a line of the symbols that has a type and no name.

    ## Why it matters
    The engine drops it; for a number, a vector or a message it reads what was left of another line.

    ## Bad
        symbols
        thing
        end

    ## Good
        symbols
        thing door
        end
    """

    for symbol in script.header.dropped:
        if symbol.type in TYPES and not symbol.name.key:
            yield Finding(
                facts.label(symbol),
                f"the line has the type {symbol.type}, but no name",
                "name the symbol, or remove the line",
            )
