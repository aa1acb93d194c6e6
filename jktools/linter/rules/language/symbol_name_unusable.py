"""JK560: a symbol that the code cannot name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.scanner import END_WORD
from jktools.syntax.cog.tables import KEYWORDS

_IDENTIFIER = re.compile(r"[a-z_][a-z0-9_]*")
_TAKEN = frozenset({*KEYWORDS, "stop", END_WORD})


@rule("JK560", "symbol-name-unusable", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def symbol_name_unusable(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a symbol whose name the code cannot write.

    ## Why it matters
    The header takes any word as a name. The code reads letters, digits and `_` that do not start with a digit: `a-b` is
    a subtraction there, and a keyword is a keyword. Such a symbol takes its slot and its value, and is never seen.

    ## Bad
        symbols
        message startup
        thing 3door
        end

    ## Good
        symbols
        message startup
        thing door3
        end
    """
    for symbol in script.header.symbols:
        name = symbol.name.key
        if not _IDENTIFIER.fullmatch(name):
            said = "the code cannot write such a name"
        elif name in _TAKEN:
            said = f"{name} is a keyword of the code"
        else:
            continue
        yield Finding(
            facts.label(symbol.name),
            f'{symbol.type} has the name "{name}", but {said}',
            "take a name of letters, digits and _ that starts with no digit and is no keyword",
        )
