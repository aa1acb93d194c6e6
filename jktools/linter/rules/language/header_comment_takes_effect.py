"""JK501: words behind // that the header takes for attributes."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

TAKING_EFFECT = frozenset({"local", "nolink", "mask", "linkid"})


@rule("JK501", "header-comment-takes-effect", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def header_comment_takes_effect(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report words behind `//` in the header that the engine takes for attributes.

    ## Why it matters
    The header knows no `//`: what follows is more words of the line, and a word `local`, `nolink`, `mask=...` or
    `linkid=...` among them counts. A remark "not local" makes a symbol local.

    ## Bad
        symbols
        thing door // was local before
        end

    ## Good
        symbols
        thing door # was local before
        end
    """

    for symbol in script.header.symbols:
        before: set[str] = set()
        commented = False
        for attribute in symbol.attributes:
            commented = commented or attribute.key.startswith("//")
            key = attribute.key.lstrip("/")
            if not commented:
                before.add(key)
            elif attribute.key in TAKING_EFFECT and key not in before:
                yield Finding(
                    facts.label(attribute),
                    f'"{attribute.key}" stands behind //, but // starts no comment in the header: the engine takes it '
                    f"for an attribute of {symbol.type} {symbol.name.key}",
                    "start the comment with #",
                )
