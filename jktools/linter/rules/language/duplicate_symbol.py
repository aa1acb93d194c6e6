"""JK504: a symbol that is declared twice."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Symbol


@rule("JK504", "duplicate-symbol", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def duplicate_symbol(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a symbol whose name an earlier one has.

    ## Why it matters
    The first of a name owns it: the code never sees the later one, which takes a slot and a value of the level's `cogs`
    line all the same.

    ## Bad
        symbols
        thing door
        sound door
        end

    ## Good
        symbols
        thing door
        sound creak
        end
    """

    first: dict[str, Symbol] = {}
    for symbol in script.header.symbols:
        owner = first.setdefault(symbol.name.key, symbol)
        if owner is not symbol:
            yield Finding(
                facts.label(symbol.name),
                f"{symbol.type} {symbol.name.key} has the name of {owner.type} {owner.name.key}, but the first "
                "of a name owns it",
                "rename it, or remove it together with its value in the levels",
                related=(facts.label(owner.name, "the first"),),
            )
