"""JK516: a comment that goes on over line ends of the old kind."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

_COMMENT = re.compile(r"""(?://|\#)[^\n]*|"(?:[^\\"]++|\\.)*"|\'(?:[^\\\']++|\\.)*\'""")
_LONE_RETURN = re.compile(r"\r(?!\n)")
_SWALLOWED = re.compile(r"\r(?=[^\r\n]*[^\s])")


@rule("JK516", "comment-swallows-lines", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def comment_swallows_lines(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a comment that goes on behind a carriage return.

    ## Why it matters
    A comment of the code ends at a line feed. In a file whose lines end with a carriage return alone, the first comment
    swallows all code behind it.
    """

    if not _LONE_RETURN.search(script.source.text, script.code.start, script.code.end):
        return
    for comment in _COMMENT.finditer(script.source.text, script.code.start, script.code.end):
        swallowed = _SWALLOWED.search(comment[0]) if comment[0][0] in "/#" else None
        if swallowed:
            at = comment.start() + swallowed.start()
            yield Finding(
                Label(script.source.span(at, at + 1)),
                "a carriage return stands in a comment, but only a line feed ends one: what follows is comment too",
                "save the file with the line ends of Windows or Unix",
            )
