"""What stays the same of a finding while the file around it changes."""

from __future__ import annotations

import hashlib
import re

from jktools.diagnostics.diagnostic import Diagnostic

_NUMBERED = re.compile(r"^\s*\d+:")
_LONGEST = 4096
"""Bytes of a line that count: a line may be as long as a file."""


def identity(diagnostic: Diagnostic) -> str:
    """Sixteen hexadecimal digits that outlive lines moved and records numbered anew.

    They are made of the line's text, without the number that a record begins with and with white space squeezed; of a
    finding about a whole file, of its message. Code and path are no part: they are compared beside it. Findings of one
    code on lines that read alike share it.
    """
    span = diagnostic.label.span
    if span is None:
        text = diagnostic.message
    else:
        line = span.source.line_span(span.first.line)
        start = (
            max(line.start, min(span.start, line.end - _LONGEST)) if line.end - line.start > _LONGEST else line.start
        )
        text = _NUMBERED.sub("", span.source.span(start, min(line.end, start + _LONGEST)).text)
    return hashlib.sha256(" ".join(text.split()).encode()).hexdigest()[:16]
