"""JK502: a line of the header whose type word the engine does not know."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.syntax.cog import Script
from jktools.syntax.cog.header import TYPES


@rule("JK502", "unknown-symbol-type", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def unknown_symbol_type(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a line of the symbols whose first word is no type.

    ## Why it matters
    The engine drops the line in silence. A name that the code uses is then a variable of its own, a flex 0, and a value
    in the level's `cogs` line goes to the symbol behind it.

    ## Bad
        symbols
        thnig door
        end

    ## Good
        symbols
        thing door
        end
    """

    for symbol in script.header.dropped:
        if symbol.type == "code" and script.rejected:
            break  # the end of the symbols is missing, and all of this is code
        if symbol.type not in TYPES and not symbol.type.startswith(("//", ";")):
            near = did_you_mean(symbol.type, sorted(TYPES))
            yield Finding(
                facts.label(symbol),
                f'the line starts with "{symbol.type}", but that is no type: the engine drops it',
                near or f"the types are {', '.join(sorted(TYPES))}",
            )
