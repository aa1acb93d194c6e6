"""JK503: a word behind a symbol that means nothing."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.syntax.cog import Script

ATTRIBUTES = ("local", "nolink", "linkid", "mask", "desc")


@rule("JK503", "unknown-symbol-attribute", severity=Severity.INFO, since="0.1.0", looks_at=Script)
def unknown_symbol_attribute(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a word behind a symbol that is no attribute.

    ## Why it matters
    The engine skips it in silence, so that a misspelt `local` leaves the symbol waiting for a value of the level. Words
    behind `desc=` and `//` are text, and JK501 tells of those that count all the same.

    ## Bad
        symbols
        thing door locla
        end

    ## Good
        symbols
        thing door local
        end

    ## Good
        symbols
        thing door desc=the big door // at the end of the hall
        end
    """

    for symbol in script.header.symbols:
        for attribute in symbol.attributes:
            if attribute.key in ("desc", "//") or attribute.key.startswith("//"):
                break
            if attribute.key not in ATTRIBUTES:
                yield Finding(
                    facts.label(attribute),
                    f'"{attribute.key}" is no attribute: the engine skips it',
                    did_you_mean(attribute.key, ATTRIBUTES) or f"the attributes are {', '.join(ATTRIBUTES)}",
                )
