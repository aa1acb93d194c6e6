"""Findings for a terminal: what, where, the line itself, and the cure."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import click

from jktools.diagnostics import Diagnostic, Label, Severity
from jktools.emit.printable import printable
from jktools.emit.report import LintReport
from jktools.source import Span

_COLOURS = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.INFO: "cyan"}

MOST_COLUMNS = 160
"""Longest part of a source line that is shown; what the finding points at stays in view."""

LEAD = 40
"""Columns shown before the place in a line that is cut."""


def findings(report: LintReport, *, colour: bool = False) -> str:
    """The whole report: a block a finding, the table where files were counted, and the line that counts."""
    blocks = render(report.diagnostics, colour=colour)
    tables = [] if report.stats is None else [stats(report.stats) + "\n"]
    return "\n".join([*blocks, *tables, summary(report.diagnostics, len(report.files)) + "\n"])


def render(diagnostics: Sequence[Diagnostic], *, colour: bool = False) -> Iterator[str]:
    """The report in blocks, one a finding, each ending in a line feed."""
    for diagnostic in diagnostics:
        yield "\n".join(_block(diagnostic, colour)) + "\n"


def summary(diagnostics: Sequence[Diagnostic], files: int) -> str:
    """One line that counts: `3 errors, 1 warning in 7 files`."""
    parts = []
    for severity in reversed(Severity):
        count = sum(d.severity is severity for d in diagnostics)
        if count:
            parts.append(f"{count} {severity}{'s' if count > 1 else ''}")
    where = f"{files} file{'' if files == 1 else 's'}"
    return f"{', '.join(parts)} in {where}" if parts else f"no findings in {where}"


def stats(rows: Sequence[tuple[str, int, int, int, int]]) -> str:
    """A table of the files that are named: kind, with the mod, in a base, missing, unused."""
    lines = [("kind", "own", "base", "missing", "unused"), *((r[0], *map(str, r[1:])) for r in rows)]
    return "\n".join(f"{kind:<12}" + "".join(f"{cell:>9}" for cell in cells) for kind, *cells in lines)


def _block(diagnostic: Diagnostic, colour: bool) -> Iterator[str]:
    def styled(text: str, **style: object) -> str:
        return click.style(text, **style) if colour else text  # type: ignore[arg-type]

    shade = _COLOURS[diagnostic.severity]
    head = styled(f"{diagnostic.severity}[{diagnostic.code}]", fg=shade, bold=True)
    yield f"{head}: {styled(printable(diagnostic.message), bold=True)}"
    gutter = max((_number_width(label) for label in (diagnostic.label, *diagnostic.related)), default=1)
    yield from _excerpt(diagnostic.label, "-->", gutter, lambda mark: styled(mark, fg=shade, bold=True))
    for label in diagnostic.related:
        yield from _excerpt(label, ":::", gutter, lambda mark: styled(mark, fg="blue"))
    if diagnostic.help:
        yield f"{' ' * gutter} = {styled('help', bold=True)}: {printable(diagnostic.help)}"


def _number_width(label: Label) -> int:
    return 1 if label.span is None else len(str(label.span.first.line))


def _excerpt(label: Label, arrow: str, gutter: int, paint: object) -> Iterator[str]:
    assert callable(paint)
    span = label.span
    if span is None:
        note = f" {label.message}" if label.message else ""
        yield f"{' ' * gutter}{arrow} {printable(label.path)}{note}"
        return
    line, column = span.first
    yield f"{' ' * gutter}{arrow} {printable(label.path)}:{line}:{column}"
    yield f"{' ' * gutter} |"
    shown, at, width = _window(span)
    yield f"{line:>{gutter}} | {shown}"
    note = f" {label.message}" if label.message else ""
    yield f"{' ' * gutter} | {' ' * at}{paint('^' * width)}{note}"


def _window(span: Span) -> tuple[str, int, int]:
    """The part of the first line to show (tabs as blanks), and the place and width of the mark in it.

    Only what is shown is ever copied: a line may be as long as a file.
    """
    whole = span.source.line_span(span.first.line)
    begin, end = whole.start, whole.end
    if end - begin > MOST_COLUMNS:
        begin = max(begin, min(span.start - LEAD, end - MOST_COLUMNS))
        end = min(end, begin + MOST_COLUMNS)
    text = "".join(c if c.isprintable() else " " if c == "\t" else "?" for c in span.source.span(begin, end).text)
    before, after = "..." * (begin > whole.start), "..." * (end < whole.end)
    at = span.start - begin + len(before)
    width = min(span.end, end) - span.start
    return before + text + after, at, max(1, width)
