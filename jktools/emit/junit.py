"""Findings as JUnit's XML, which Jenkins, GitLab and others show as tests."""

from __future__ import annotations

from itertools import groupby
from xml.etree import ElementTree

from jktools.diagnostics import Diagnostic
from jktools.emit.printable import printable
from jktools.emit.report import LintReport


def findings(report: LintReport) -> str:
    """A suite a file, a test a finding, and one test that passes for a file without any.

    A test fails for a finding that makes the run end with 1, and says the others without failing: a pipeline that reads
    this and one that reads the exit status agree. Paths that could not be read are errors of a suite of their own.
    """
    by_path = {path: list(found) for path, found in groupby(report.diagnostics, key=lambda d: d.path)}
    root = ElementTree.Element("testsuites", name="jktools")
    for path in sorted({*report.files, *by_path}):
        _suite(root, path, by_path.get(path, []), report)
    if report.problems:
        suite = ElementTree.SubElement(root, "testsuite", name="jktools", errors=str(len(report.problems)))
        suite.set("tests", str(len(report.problems)))
        for sentence in report.problems:
            case = ElementTree.SubElement(suite, "testcase", classname="jktools", name="read")
            ElementTree.SubElement(case, "error", message=printable(sentence))
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _suite(root: ElementTree.Element, path: str, found: list[Diagnostic], report: LintReport) -> None:
    name = printable(path)
    failures = sum(diagnostic in report.failing for diagnostic in found)
    suite = ElementTree.SubElement(
        root, "testsuite", name=name, tests=str(max(1, len(found))), failures=str(failures), errors="0"
    )
    if not found:
        ElementTree.SubElement(suite, "testcase", classname=name, name="lint")
    for diagnostic in found:
        span = diagnostic.label.span
        at = f":{span.first.line}:{span.first.column}" if span else ""
        title = f"{diagnostic.code} {diagnostic.code.name}{at}"
        case = ElementTree.SubElement(suite, "testcase", classname=name, name=title)
        if span:
            case.set("file", name)
            case.set("line", str(span.first.line))
        message = printable(diagnostic.message)
        told = [f"{name}{at}: {message}", *([f"help: {printable(diagnostic.help)}"] if diagnostic.help else [])]
        if diagnostic in report.failing:
            failure = ElementTree.SubElement(case, "failure", message=message, type=str(diagnostic.severity))
            failure.text = "\n".join(told)
        else:
            ElementTree.SubElement(case, "system-out").text = "\n".join(
                [f"{diagnostic.severity}: {told[0]}", *told[1:]]
            )
