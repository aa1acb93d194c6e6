"""JK519: a character that the engine drops."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.faults import OVERLONG_TOKEN


@rule("JK519", "stray-character", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def stray_character(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a character of the code that the engine's scanner drops.

    ## Why it matters
    What starts no token is skipped in silence: `$ @ ? \\` and the backquote, control characters, and a quote that has
    no partner. `print("abc);` is read as `print(abc);`, with a variable abc. A quote behind which the scanner looks
    too far for the next one is left to overlong-token.

    ## Bad
        x = $y;

    ## Bad
        Print("hello);

    ## Good
        x = y;
    """

    told = {d.label.span for d in script.diagnostics if d.code == OVERLONG_TOKEN}  # quotes too far from the next one
    for stray in script.strays:
        if stray.text < "\x80" and script.source.span(stray.start, stray.end) not in told:
            shown = stray.text if stray.text.isprintable() else f"\\x{ord(stray.text):02x}"
            quote = stray.text in "\"'"
            yield Finding(
                facts.label(stray),
                f"the quote {shown} has no partner: the engine drops it and reads on" if quote
                else f"{shown} starts nothing that the engine knows: it drops it and reads on",
                "add the other quote" if quote else "remove it",
            )  # fmt: skip
