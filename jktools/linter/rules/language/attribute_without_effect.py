"""JK511: an attribute that does nothing where it stands."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.header import LINKED_TYPES


@rule("JK511", "attribute-without-effect", severity=Severity.INFO, since="0.1.0", looks_at=Script)
def attribute_without_effect(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an attribute that does nothing for a symbol of its type, or lacks its value.

    ## Why it matters
    Only things, surfaces and sectors are linked to a script, so that a link id, a mask or `nolink` of another symbol
    says nothing; a message takes no attribute at all. `linkid` without a number is 0, `mask` without one stays 0x401.

    ## Bad
        symbols
        sound creak linkid=3
        end

    ## Bad
        symbols
        surface button linkid
        end

    ## Good
        symbols
        surface button linkid=3
        sound creak local
        end
    """

    for symbol in script.header.symbols:
        for attribute in symbol.attributes:
            if attribute.key == "desc" or attribute.key.startswith("//"):
                break
            if attribute.key in ("linkid", "mask", "nolink") and symbol.type not in LINKED_TYPES:
                said = f"{symbol.type} symbols are never linked"
            elif attribute.key == "local" and symbol.type == "message":
                said = "a message takes no attributes"
            elif attribute.key in ("linkid", "mask") and not attribute.has_value:
                said = f"it has no value: the engine takes {0 if attribute.key == 'linkid' else '0x401'}"
            else:
                continue
            yield Finding(
                facts.label(attribute),
                f"{symbol.type} {symbol.name.key} has the attribute {attribute.key}, but {said}",
                "remove it" if symbol.type not in LINKED_TYPES else f"write {attribute.key}= and the value",
            )
