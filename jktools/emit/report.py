"""What a lint run has to say, in whatever format it is said."""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

from jktools.diagnostics import Diagnostic


@dataclass(frozen=True, slots=True)
class LintReport:
    """Findings and what belongs to them."""

    diagnostics: Sequence[Diagnostic]
    """In the one order of every output."""
    files: Sequence[str]
    """The paths of all that was read."""
    problems: Sequence[str] = ()
    """Paths that could not be read, one sentence each."""
    failing: AbstractSet[Diagnostic] = frozenset()
    """Those for which the run ends with status 1."""
    stats: Sequence[tuple[str, int, int, int, int]] | None = None
    """A row a kind of file: its name, then how many are the mod's own, in a base, missing and unused."""
