"""What is said where one file brings a bug in jktools to light."""

from __future__ import annotations

import os

from jktools.compiler import PassError
from jktools.diagnostics import Diagnostic, Label
from jktools.linter.rule import FILE_FAILED
from jktools.source import Member, Source

TRACEBACK_VARIABLE = "JKTOOLS_TRACEBACK"
"""Set in the environment, a bug shows its traceback and ends the run."""


def file_failed(member: Member, error: Exception) -> Diagnostic:
    """The finding on a file that jktools failed on; raises the error itself where a traceback is asked for."""
    if os.environ.get(TRACEBACK_VARIABLE):
        raise error
    return Diagnostic(
        FILE_FAILED, FILE_FAILED.severity, Label(Source(member.path, b"")),
        f"jktools failed on this file: {type(error).__name__}: {error}",
        f"this is a bug in jktools; please report it with the file ({TRACEBACK_VARIABLE}=1 shows where)",
    )  # fmt: skip


def pass_failed(error: PassError) -> str:
    """The sentence on a pass that failed; raises the error itself where a traceback is asked for."""
    if os.environ.get(TRACEBACK_VARIABLE):
        raise error
    return f"{error}; the rest compiles with --keep-going, and {TRACEBACK_VARIABLE}=1 shows where it failed"
