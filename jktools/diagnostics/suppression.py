"""Comments that hide findings: `# jktools: ignore JK201 -- the reason`, in COG code also behind `//`.

On a line of its own such a comment speaks for the next line that is neither empty nor a comment; behind something it
speaks for its own line; `ignore-file` speaks for the whole file.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from jktools.diagnostics.diagnostic import Code, Diagnostic, Label, Severity
from jktools.source import Source, Span

UNUSED_SUPPRESSION = Code("JK020", "unused-suppression", Severity.WARNING)
MALFORMED_SUPPRESSION = Code("JK021", "malformed-suppression", Severity.WARNING)

_MARK = "jktools:"
_TEXT = re.compile(r"(?P<scope>ignore|ignore-file)[ \t]+(?P<codes>(?:(?!--).)+?)[ \t]*(?:--[ \t]*(?P<reason>.*))?$")


@dataclass(frozen=True, slots=True)
class CommentStyle:
    """How comments look from a place of a file on."""

    marked: re.Pattern[str]
    """Finds comments with our mark; the group `text` is what follows it, None where something else was found."""
    no_content: re.Pattern[str]
    """Matches at the start of a line that holds nothing, or a comment alone."""
    start: int = 0
    """Byte offset from which on comments look so."""


LINES = CommentStyle(
    re.compile(r"(?:#|^;)[ \t]*jktools:[ \t]*(?P<text>[^\r\n]*)", re.MULTILINE), re.compile(r"[ \t]*(#|$)|;")
)
"""Levels, and the headers of scripts."""

_CODE = re.compile(
    r""""(?:[^\\"]++|\\.)*"|'(?:[^\\']++|\\.)*'|(?://|\#)(?:[ \t]*jktools:[ \t]*(?P<text>[^\r\n]*))?[^\n]*"""
)
_CODE_EMPTY = re.compile(r"[ \t]*(//|#|$)")


def code_comments(start: int) -> CommentStyle:
    """Comments of COG code, which starts at a byte offset: `//` or `#`, outside strings and vectors."""
    return CommentStyle(_CODE, _CODE_EMPTY, start)


@dataclass(frozen=True, slots=True)
class Suppression:
    """One comment: the codes it hides, and the line (from 1) it speaks for, or None for the whole file."""

    span: Span
    codes: tuple[str, ...]
    line: int | None

    def hides(self, diagnostic: Diagnostic, code: str) -> bool:
        """Whether one of its codes (a whole one, or a rule's name) hides a finding."""
        if diagnostic.code.is_bug:
            return False
        if code.upper() != diagnostic.code.id and code.lower() != diagnostic.code.name:
            return False
        span = diagnostic.label.span
        if self.line is None:
            return True
        return span is not None and span.source is self.span.source and span.first.line == self.line


def suppressions(
    source: Source, styles: Sequence[CommentStyle] = (LINES,)
) -> tuple[list[Suppression], list[Diagnostic]]:
    """The comments of a file, and what is wrong with those that cannot be understood.

    Each style reaches to where the next one starts.
    """
    found: list[Suppression] = []
    faults: list[Diagnostic] = []
    if _MARK not in source.text:
        return found, faults
    for comment, style in _marked(source.text, styles):
        span = source.span(comment.start(), comment.start() + len(comment.group().rstrip()))
        understood = _TEXT.match(comment["text"].strip())
        if understood is None:
            said = comment["text"].strip()
            faults.append(
                Diagnostic(
                    MALFORMED_SUPPRESSION, MALFORMED_SUPPRESSION.severity, Label(span),
                    f'expected "ignore CODE -- reason" or "ignore-file CODE -- reason", but found "{said}"',
                    "name the codes to hide, as JK201",
                )
            )  # fmt: skip
            continue
        codes = tuple(re.split(r"[,\s]+", understood["codes"].strip()))
        line = None if understood["scope"] == "ignore-file" else _target(source, span, style)
        found.append(Suppression(span, codes, line))
    return found, faults


def _marked(text: str, styles: Sequence[CommentStyle]) -> Iterator[tuple[re.Match[str], CommentStyle]]:
    ends = [*(style.start for style in styles[1:]), len(text)]
    for style, end in zip(styles, ends, strict=True):
        for comment in style.marked.finditer(text, style.start, end):
            if comment["text"] is not None:
                yield comment, style


def _target(source: Source, comment: Span, style: CommentStyle) -> int:
    """The line that a comment speaks for."""
    line, column = comment.first
    if source.line(line)[: column - 1].strip():
        return line
    last = source.position(len(source.data)).line
    while line < last:
        line += 1
        if not style.no_content.match(source.line(line)):
            break
    return line


def apply(
    diagnostics: Iterable[Diagnostic], comments: Sequence[Suppression], known: Sequence[Code]
) -> list[Diagnostic]:
    """The findings that no comment hides, and one for each code of a comment that hides nothing.

    `known` are the codes that ran: of one that did not, nobody can say whether it would have found something.
    """
    kept: list[Diagnostic] = []
    used: set[tuple[int, str]] = set()
    for diagnostic in diagnostics:
        hiding = [(i, code) for i, c in enumerate(comments) for code in c.codes if c.hides(diagnostic, code)]
        used.update(hiding)
        if not hiding:
            kept.append(diagnostic)
    ran = {code.id for code in known} | {code.name for code in known}
    unused = [(c, code) for i, c in enumerate(comments) for code in c.codes if (i, code) not in used]
    return kept + [_unused(c, code) for c, code in unused if code.upper() in ran or code.lower() in ran]


def _unused(comment: Suppression, code: str) -> Diagnostic:
    where = "in this file" if comment.line is None else f"on line {comment.line}"
    return Diagnostic(
        UNUSED_SUPPRESSION, UNUSED_SUPPRESSION.severity, Label(comment.span),
        f"the comment hides {code}, but there is no such finding {where}", "remove the comment",
    )  # fmt: skip
