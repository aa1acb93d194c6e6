"""Findings as SARIF 2.1.0, which code scanning services and editors read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import quote

from jktools import __version__
from jktools.diagnostics import Code, Diagnostic, Label, Severity
from jktools.diagnostics.identity import identity
from jktools.emit.json import dump
from jktools.emit.report import LintReport
from jktools.linter import UnknownRuleError, find_rule
from jktools.source.path import split_on_disk

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
ROOT = "%SRCROOT%"
"""What relative paths start from: where the program runs, which services take for the repository."""

_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


def findings(report: LintReport) -> str:
    """One run: the rules that found something with their docs, the results, and what could not be read.

    A file in a pack is `pack.gob!jkl/x.jkl`, as in every report, and an artifact within that of the pack. Columns count
    bytes, which are characters in the encoding that the game's files have. Infos are notes.
    """
    codes = sorted({d.code for d in report.diagnostics}, key=lambda code: code.id)
    artifacts = _Artifacts()
    seen: Counter[tuple[str, str, str]] = Counter()
    results = []
    for diagnostic in report.diagnostics:
        alike = (diagnostic.path, diagnostic.code.id, identity(diagnostic))
        seen[alike] += 1
        results.append(_result(diagnostic, codes.index(diagnostic.code), artifacts, f"{alike[2]}:{seen[alike]}"))
    for path in report.files:
        artifacts.index(path)
    run: dict[str, Any] = {
        "tool": {"driver": _driver(codes)},
        "columnKind": "utf16CodeUnits",
        "defaultEncoding": "windows-1252",
        "invocations": [_invocation(report)],
        "artifacts": artifacts.rows,
        "results": results,
    }
    return dump({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]})


def _driver(codes: Sequence[Code]) -> dict[str, Any]:
    return {
        "name": "jktools",
        "version": __version__,
        "semanticVersion": __version__,
        "rules": [_descriptor(code) for code in codes],
    }


def _descriptor(code: Code) -> dict[str, Any]:
    described: dict[str, Any] = {
        "id": code.id,
        "name": code.name,
        "defaultConfiguration": {"level": _LEVELS[code.severity]},
    }
    try:
        rule = find_rule(code.id)
    except UnknownRuleError:  # a bug of jktools is told without a rule
        return described
    described["shortDescription"] = {"text": rule.summary}
    described["fullDescription"] = {"text": rule.reason or rule.summary}
    described["help"] = {"text": rule.docs, "markdown": rule.docs}
    return described


def _result(diagnostic: Diagnostic, rule: int, artifacts: _Artifacts, fingerprint: str) -> dict[str, Any]:
    text = diagnostic.message + (f"\n{diagnostic.help}" if diagnostic.help else "")
    location: dict[str, Any] = {"physicalLocation": _physical(diagnostic.label, artifacts)}
    subject = diagnostic.subject
    if subject:
        name = f"{subject.kind} {subject.index}" + (f" ({subject.name})" if subject.name else "")
        location["logicalLocations"] = [{"name": name, "fullyQualifiedName": f"{diagnostic.path}#{name}"}]
    result: dict[str, Any] = {
        "ruleId": diagnostic.code.id,
        "ruleIndex": rule,
        "level": _LEVELS[diagnostic.severity],
        "message": {"text": text},
        "locations": [location],
        "partialFingerprints": {"primaryLocationLineHash": fingerprint},
    }
    if diagnostic.related:
        result["relatedLocations"] = [
            {
                "id": number,
                "physicalLocation": _physical(label, artifacts),
                **({"message": {"text": label.message}} if label.message else {}),
            }
            for number, label in enumerate(diagnostic.related, 1)
        ]
    return result


def _physical(label: Label, artifacts: _Artifacts) -> dict[str, Any]:
    index = artifacts.index(label.path)
    place: dict[str, Any] = {"artifactLocation": {**artifacts.rows[index]["location"], "index": index}}
    if label.span:
        first, last = label.span.first, label.span.last
        place["region"] = {
            "startLine": first.line,
            "startColumn": first.column,
            "endLine": last.line,
            "endColumn": last.column,
        }
    return place


class _Artifacts:
    """The files of a run, each once, a pack before what lies in it."""

    def __init__(self) -> None:
        self.rows: list[dict[str, Any]] = []
        self._indices: dict[str, int] = {}

    def index(self, path: str) -> int:
        """The number of a file, which is given one when it is met first."""
        if path not in self._indices:
            inner = split_on_disk(path)[1]
            row: dict[str, Any] = {"location": _location(path)}
            if inner:
                row["parentIndex"] = self.index(path.removesuffix(inner))
            self._indices[path] = len(self.rows)
            self.rows.append(row)
        return self._indices[path]


def _location(path: str) -> Mapping[str, str]:
    """A file as a URI: from the root where the path is relative."""
    octets = path.encode("utf-8", "surrogateescape")
    if PurePosixPath(path).is_absolute():
        return {"uri": "file://" + quote(octets, safe="/!")}
    return {"uri": quote(octets, safe="/!"), "uriBaseId": ROOT}


def _invocation(report: LintReport) -> dict[str, Any]:
    told = [{"level": "error", "message": {"text": sentence}} for sentence in report.problems]
    invocation: dict[str, Any] = {"executionSuccessful": not told}
    if told:
        invocation["toolExecutionNotifications"] = told
    return invocation
