"""Exit statuses, and which of several wins."""

from __future__ import annotations

import enum
from collections.abc import Sequence

from jktools.diagnostics import Diagnostic, Severity


class Status(enum.IntEnum):
    """What the process ends with; the greater wins."""

    CLEAN = 0
    FINDINGS = 1
    USAGE = 2
    BUG = 3
    INTERRUPTED = 130
    CLOSED_PIPE = 141
    TERMINATED = 143


def of_findings(diagnostics: Sequence[Diagnostic], fail_on: Severity | None) -> Status:
    """3 when a rule failed, 1 when a finding is as bad as `fail_on` (None: never), else 0."""
    if any(d.code.is_bug for d in diagnostics):
        return Status.BUG
    return Status.FINDINGS if any(fails(d, fail_on) for d in diagnostics) else Status.CLEAN


def fails(diagnostic: Diagnostic, fail_on: Severity | None) -> bool:
    """Whether a finding makes a run fail: it is as bad as `fail_on` (None: never), or a rule that failed."""
    return diagnostic.code.is_bug or (fail_on is not None and diagnostic.severity >= fail_on)
