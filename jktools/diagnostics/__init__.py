"""What is said about a file, and in which order."""

from jktools.diagnostics.diagnostic import Code, Diagnostic, Label, Severity, Subject
from jktools.diagnostics.suppression import MALFORMED_SUPPRESSION, UNUSED_SUPPRESSION

__all__ = ["MALFORMED_SUPPRESSION", "UNUSED_SUPPRESSION", "Code", "Diagnostic", "Label", "Severity", "Subject"]
