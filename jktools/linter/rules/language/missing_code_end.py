"""JK522: code that no end closes."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK522", "missing-code-end", severity=Severity.INFO, since="0.1.0", looks_at=Script)
def missing_code_end(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a script that ends without `end`.

    ## Why it matters
    The engine takes the end of the file for it. Editors that append to the file do not, and a file that was cut off
    looks the same.

    ## Bad
        symbols
        end
        code
        startup:
            stop;

    ## Good
        symbols
        end
        code
        startup:
            stop;
        end
    """

    if not script.code.closed and not script.rejected:
        at = len(script.source.data)
        yield Finding(
            Label(script.source.span(at, at)), "the file ends, but no end closes the code", "add a line with end"
        )
