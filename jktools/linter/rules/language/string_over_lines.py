"""JK528: a string that goes on over a line end."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import String


@rule("JK528", "string-over-lines", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def string_over_lines(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a string that starts on one line and ends on another.

    ## Why it matters
    The engine takes it, line end and all. Mostly a quote is missing, and the code up to the next one is text now.

    ## Bad
        startup:
            Print("hello);
            Print("world");

    ## Good
        startup:
            Print("hello");
            Print("world");
    """

    for word in script.code.words:
        if isinstance(word, String) and "\n" in word.value:
            at = script.source.position(word.end)
            yield Finding(
                Label(script.source.span(word.start, word.start + 1)),
                f"the string starts here, but the next quote stands on line {at.line}",
                "add the closing quote",
            )
