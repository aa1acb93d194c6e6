"""JK505: an attribute that is given twice."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK505", "duplicate-attribute", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def duplicate_attribute(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an attribute that a symbol has twice.

    ## Why it matters
    The engine takes the later one.

    ## Bad
        symbols
        surface button linkid=1 linkid=2
        end

    ## Good
        symbols
        surface button linkid=1
        end
    """

    for symbol in script.header.symbols:
        seen: dict[str, str] = {}
        for attribute in symbol.attributes:
            if attribute.key == "desc" or attribute.key.startswith("//"):
                break
            if attribute.key in seen and attribute.key in ("local", "nolink", "linkid", "mask"):
                yield Finding(
                    facts.label(attribute),
                    f"{symbol.type} {symbol.name.key} has {_written(attribute.key, seen[attribute.key])}, but also "
                    f"{_written(attribute.key, attribute.value)}",
                    "keep the one that is meant",
                )
            seen[attribute.key] = attribute.value


def _written(key: str, value: str) -> str:
    return key if key == value else f"{key}={value}"
