"""JK507: a default value of a type that takes none."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK507", "default-ignored", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def default_ignored(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a default value of a vector.

    ## Why it matters
    The engine reads no default of a vector in the script: it is zero until the level or the code gives it a value.

    ## Bad
        symbols
        vector up=(0/0/1) local
        end

    ## Good
        symbols
        vector up local
        end
    """

    for symbol in script.header.symbols:
        if symbol.type == "vector" and symbol.default is not None:
            yield Finding(
                facts.label(symbol.name),
                f"vector {symbol.name.key} has the default {symbol.default}, but the engine reads none",
                "assign it in the startup message",
            )
