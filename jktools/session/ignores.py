"""What the settings do to findings: hide some, change how bad others are, and tell of entries that hide nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fnmatch import fnmatch

from jktools.diagnostics import UNUSED_SUPPRESSION, Diagnostic, Label
from jktools.session.settings import Ignore, Settings
from jktools.source.container import PACK_SEPARATOR


def with_settings(found: Sequence[Diagnostic], settings: Settings, used: set[int]) -> list[Diagnostic]:
    """Findings without those that an `[[ignore]]` hides, with the severities that the settings give them."""
    kept = []
    for diagnostic in found:
        hiding = [i for i, entry in enumerate(settings.ignores) if _hides(entry, diagnostic)]
        used.update(hiding)
        if not hiding:
            severity = settings.severity.get(diagnostic.code.id, diagnostic.severity)
            kept.append(diagnostic if severity is diagnostic.severity else replace(diagnostic, severity=severity))
    return kept


def _hides(entry: Ignore, diagnostic: Diagnostic) -> bool:
    if diagnostic.code.is_bug or entry.code != diagnostic.code.id or not _matches(entry.path, diagnostic.path):
        return False
    subject = diagnostic.subject
    if not entry.object:
        return True
    return subject is not None and entry.object.lower() in (
        f"{subject.kind} {subject.index}",
        f"{subject.kind} {subject.name}".lower(),
    )


def _matches(pattern: str, path: str) -> bool:
    """Whether a shell pattern names a path or, from a slash or `!` on, its end; case does not count."""
    path, pattern = "/" + path.lower(), pattern.lower()
    return any(fnmatch(path, lead + pattern) for lead in ("", "/", "*/", f"*{PACK_SEPARATOR}"))


def unused_ignores(settings: Settings, used: set[int], seen: Sequence[str], ran: Sequence[str]) -> list[Diagnostic]:
    """A finding for each `[[ignore]]` that hid nothing though its rule ran over a file that it names."""
    if UNUSED_SUPPRESSION.id not in ran:
        return []
    return [
        Diagnostic(
            UNUSED_SUPPRESSION, settings.severity.get(UNUSED_SUPPRESSION.id, UNUSED_SUPPRESSION.severity),
            Label(entry.span), f"the entry hides {entry.code}, but there is no such finding", "remove the entry",
        )
        for i, entry in enumerate(settings.ignores)
        if i not in used and entry.span and entry.code in ran and any(_matches(entry.path, path) for path in seen)
    ]  # fmt: skip
