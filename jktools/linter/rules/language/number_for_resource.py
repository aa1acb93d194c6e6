"""JK561: a number where a name belongs."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.instance import RESOURCES
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

_NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]*)?")


@rule("JK561", "number-for-resource", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def number_for_resource(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a number as the default of a resource.

    ## Why it matters
    Sounds, models, materials, keyframes and AI classes are named by their files, templates by their names. The engine
    looks for a file or a template called `3`, finds none, and the symbol is -1.

    ## Bad
        symbols
        message startup
        sound creak=3
        end

    ## Good
        symbols
        message startup
        sound creak=door01.wav
        end
    """
    for symbol in script.header.symbols:
        if symbol.type in RESOURCES and symbol.default is not None and _NUMBER.fullmatch(symbol.default):
            yield Finding(
                facts.label(symbol.name),
                f'{symbol.type} {symbol.name.key} has the default "{symbol.default}", but a {symbol.type} has a name',
                "write the name of the template" if symbol.type == "template" else "write the name of the file",
            )
