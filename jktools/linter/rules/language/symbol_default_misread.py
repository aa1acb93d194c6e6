"""JK506: a default that the engine reads as something else."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

WHOLE = ("int", "thing", "surface", "sector", "cog")
REAL = ("flex", "float")

_WHOLE = re.compile(r"[-+]?[0-9]+")
_REAL = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[-+]?[0-9]+)?")
_HEX = re.compile(r"0x[0-9a-f]+")


@rule("JK506", "symbol-default-misread", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def symbol_default_misread(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a default value of a number or an object that the engine reads as another one.

    ## Why it matters
    An `int`, and the number of a thing, surface, sector or cog, is read as decimal digits up to the first other
    character: `0x10` is 0, `0.5` is 0, `door` is 0. A `flex` is read up to where the number ends.

    ## Bad
        symbols
        int flags=0x10
        end

    ## Bad
        symbols
        flex speed=fast
        end

    ## Good
        symbols
        int flags=16
        flex speed=1.5
        end
    """

    for symbol in script.header.symbols:
        value = symbol.default
        if value is None or symbol.type not in (*WHOLE, *REAL):
            continue
        real = symbol.type in REAL
        found = (_REAL if real else _WHOLE).match(value)
        taken = found[0] if found else ""
        if taken != value or not value:
            hexadecimal = _HEX.fullmatch(value)
            yield Finding(
                facts.label(symbol.name),
                f'{symbol.type} {symbol.name.key} has the default "{value}", but the engine reads {taken or 0}',
                f"write {int(value, 16)}" if hexadecimal else "write a number" if real else "write a whole number",
            )
