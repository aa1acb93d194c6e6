"""JK520: a byte past 127 in the code."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

_BEYOND = re.compile("[\x80-\xff]")


@rule("JK520", "byte-out-of-range", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def byte_out_of_range(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a byte of the code, in comments too, that is no ASCII.

    ## Why it matters
    The engine's scanner has a table of 128 characters and looks up every byte in it: for an umlaut or a curly quote it
    reads whatever lies behind the table, or before it. What becomes of the script is luck.

    ## Bad
        startup:
            x = 1; // für die Tür

    ## Good
        startup:
            x = 1; // for the door
    """

    first = _BEYOND.search(script.source.text, script.code.start, script.code.end)
    if first is not None:
        count = len(_BEYOND.findall(script.source.text, script.code.start, script.code.end))
        others = f", and {count - 1} more bytes do" if count > 1 else ""
        yield Finding(
            Label(script.source.span(first.start(), first.end())),
            f"the byte 0x{ord(first[0]):02x} lies outside the 128 characters that the engine's scanner knows{others}",
            "use letters without accents and straight quotes, in comments too",
        )
