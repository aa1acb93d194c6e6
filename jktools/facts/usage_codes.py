"""Codes of findings about a whole mod; the run over it tells them, since no document can."""

from jktools.diagnostics import Code, Severity

UNUSED_FILE = Code("JK150", "unused-file", Severity.INFO)
MISPLACED_FILE = Code("JK151", "misplaced-file", Severity.INFO)
