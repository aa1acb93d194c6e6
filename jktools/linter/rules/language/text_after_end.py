"""JK521: text behind the end of the code."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

_TEXT = re.compile(r"(?:\s+|(?://|\#|;)[^\n]*|(?=end\b)end)*+([^\s][^\r\n]*)", re.IGNORECASE)
"""The first text that is neither blank, nor a comment of code or header, nor one more `end`."""


@rule("JK521", "text-after-end", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def text_after_end(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report text behind the first `end` of the code.

    ## Why it matters
    The first word `end` ends the code wherever it stands; labels behind it do not exist.

    ## Bad
        startup:
            stop;
        end
        killed:
            stop;

    ## Good
        startup:
            stop;
        killed:
            stop;
    """

    if script.code.closed:
        found = _TEXT.match(script.source.text, script.code.end)
        if found is not None:
            line = script.source.position(script.code.end).line
            yield Finding(
                Label(script.source.span(found.start(1), found.end(1))),
                f"text stands here, but the code ends with the word end on line {line}",
                "remove that end, or the text",
            )
