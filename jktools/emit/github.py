"""Findings as commands of GitHub's workflows, which puts them beside the lines of a pull request."""

from __future__ import annotations

from collections.abc import Iterable

from jktools.diagnostics import Diagnostic, Severity
from jktools.emit.printable import printable
from jktools.emit.report import LintReport
from jktools.emit.text import summary
from jktools.source.path import split_on_disk

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}
_IN_MESSAGES = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A"})
_IN_PROPERTIES = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A", ":": "%3A", ",": "%2C"})


def findings(report: LintReport) -> str:
    """A command a finding, then the line that counts.

    What lies in a pack is put on the pack, which is all that a repository shows; its message tells the place in it.
    """
    return "\n".join([*map(_command, report.diagnostics), *map(_problem, report.problems), _count(report), ""])


def _count(report: LintReport) -> str:
    return summary(report.diagnostics, len(report.files))


def _problem(sentence: str) -> str:
    return f"::error title=jktools::{_message([sentence])}"


def _command(diagnostic: Diagnostic) -> str:
    file, inner = split_on_disk(diagnostic.path)
    properties = {
        "file": file,
        **({} if inner else _lines(diagnostic)),
        "title": f"{diagnostic.code} {diagnostic.code.name}",
    }
    listed = ",".join(f"{name}={value.translate(_IN_PROPERTIES)}" for name, value in properties.items())
    span = diagnostic.label.span
    at = inner[1:] + (f":{span.first.line}:{span.first.column}" if span else "") + ": " if inner else ""
    told = [at + diagnostic.message, *([f"help: {diagnostic.help}"] if diagnostic.help else [])]
    return f"::{_COMMANDS[diagnostic.severity]} {listed}::{_message(told)}"


def _message(lines: Iterable[str]) -> str:
    return "\n".join(map(printable, lines)).translate(_IN_MESSAGES)


def _lines(diagnostic: Diagnostic) -> dict[str, str]:
    span = diagnostic.label.span
    if span is None:
        return {}
    first, last = span.first, span.last
    lines = {"line": str(first.line), "endLine": str(last.line)}
    if first.line == last.line:  # columns count within one line
        lines |= {"col": str(first.column), "endColumn": str(last.column)}
    return lines
