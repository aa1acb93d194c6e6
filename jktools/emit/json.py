"""Findings and lists of files as JSON."""

from __future__ import annotations

from typing import Any

import msgspec

from jktools import __version__
from jktools.diagnostics import Diagnostic, Label, Severity
from jktools.emit.report import LintReport
from jktools.source import Container

VERSION = 1
"""Of the shape of this output; grows when a reader would have to change."""


def findings(report: LintReport) -> str:
    """The report of a lint run; its shape is docs/lint.schema.json."""
    names = ("kind", "own", "base", "missing", "unused")
    stats = {} if report.stats is None else {"stats": [dict(zip(names, row, strict=True)) for row in report.stats]}
    return dump(
        {
            "version": VERSION,
            "tool": {"name": "jktools", "version": __version__},
            "summary": {
                "files": len(report.files),
                **{str(s): sum(d.severity is s for d in report.diagnostics) for s in reversed(Severity)},
            },
            "diagnostics": [diagnostic_object(d) for d in report.diagnostics],
            **stats,
        }
    )


def pack(container: Container) -> str:
    """What `pack list` says of a container, in its own order."""
    return dump(
        {
            "version": VERSION,
            "path": container.path,
            "files": [{"name": m.name, "size": m.size, "declared": m.declared} for m in container.members],
        }
    )


def dump(value: dict[str, Any]) -> str:
    """JSON, indented, with a line break at the end."""
    return msgspec.json.format(msgspec.json.encode(value), indent=2).decode() + "\n"


def diagnostic_object(diagnostic: Diagnostic) -> dict[str, Any]:
    """A finding as it stands in JSON."""
    place = _place(diagnostic.label)
    last = diagnostic.label.span.last if diagnostic.label.span else None
    subject = diagnostic.subject
    return {
        "code": diagnostic.code.id,
        "name": diagnostic.code.name,
        "severity": str(diagnostic.severity),
        **place,
        "end_line": last.line if last else None,
        "end_column": last.column if last else None,
        "message": diagnostic.message,
        "help": diagnostic.help,
        "object": {"kind": subject.kind, "index": subject.index, "name": subject.name} if subject else None,
        "related": [{**_place(label), "message": label.message} for label in diagnostic.related],
    }


def _place(label: Label) -> dict[str, Any]:
    first = label.span.first if label.span else None
    return {
        "path": label.path,
        "line": first.line if first else None,
        "column": first.column if first else None,
    }
