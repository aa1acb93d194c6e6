"""The faults of one asset file, as they are found."""

from __future__ import annotations

from jktools.diagnostics import Code, Diagnostic, Label, Severity, Subject
from jktools.source import Source, Span
from jktools.syntax.assets import faults

MOST_FAULTS = 100
"""Faults told of one file; a file of garbage must not yield a report longer than itself."""


class FaultList:
    """Collects what is wrong with a file, and counts what is too much to tell."""

    def __init__(self, source: Source) -> None:
        """Start with none."""
        self.source = source
        self.found: list[Diagnostic] = []
        self._untold = 0

    @property
    def full(self) -> bool:
        """Whether further faults are only counted."""
        return len(self.found) >= MOST_FAULTS

    def tell(
        self,
        code: Code,
        place: Span | Source,
        message: str,
        help: str | None = None,
        subject: Subject | None = None,
        severity: Severity | None = None,
    ) -> None:
        """Add a fault, with its code's severity when none is given."""
        if self.full:
            self.count()
            return
        self.found.append(Diagnostic(code, severity or code.severity, Label(place), message, help, subject))

    def count(self) -> None:
        """Count a fault that is not told."""
        self._untold += 1

    def finish(self) -> tuple[Diagnostic, ...]:
        """Everything that was told, in the order of the file."""
        if self._untold:
            code = faults.TOO_MANY_ASSET_FAULTS
            self.found.append(
                Diagnostic(
                    code, code.severity, Label(self.source),
                    f"{MOST_FAULTS} faults are reported, but the file has {self._untold} more",
                    "mend the first ones; the rest often follow from them",
                )
            )  # fmt: skip
            self._untold = 0
        return tuple(sorted(self.found, key=lambda d: d.sort_key))
