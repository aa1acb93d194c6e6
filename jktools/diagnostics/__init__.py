"""What is said about a file, and in which order."""

from jktools.diagnostics.diagnostic import Code, Diagnostic, Label, Severity, Subject

__all__ = ["Code", "Diagnostic", "Label", "Severity", "Subject"]
