"""Findings that are known already and no longer told: what a pack begins with when it is linted for the first time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from jktools.diagnostics.diagnostic import Diagnostic
from jktools.diagnostics.identity import identity


class Known(NamedTuple):
    """Findings that are alike: of one code, in one file, on lines that read the same."""

    path: str
    code: str
    identity: str
    times: int
    message: str
    """Of the first of them, for people."""

    @property
    def key(self) -> tuple[str, str, str]:
        """What they are recognised by."""
        return self.path, self.code, self.identity


Renamed = Callable[[str], str]
"""From the path in a finding to the one in a baseline."""


_Key = tuple[str, str, str]


def _key(diagnostic: Diagnostic, renamed: Renamed) -> _Key:
    return renamed(diagnostic.path), diagnostic.code.id, identity(diagnostic)


def known_of(diagnostics: Iterable[Diagnostic], renamed: Renamed = str) -> list[Known]:
    """A baseline of findings, sorted; bugs of jktools are never part of one."""
    first: dict[_Key, str] = {}
    counts: Counter[_Key] = Counter()
    for diagnostic in diagnostics:
        if not diagnostic.code.is_bug:
            key = _key(diagnostic, renamed)
            first.setdefault(key, diagnostic.message)
            counts[key] += 1
    return [Known(*key, count, first[key]) for key, count in sorted(counts.items())]


class Compared(NamedTuple):
    """What findings are beside a baseline."""

    fresh: list[Diagnostic]
    """Not in it, in their order."""
    gone: list[Known]
    """In it, and found no longer; `times` is how many of them."""


def compare(diagnostics: Sequence[Diagnostic], baseline: Iterable[Known], renamed: Renamed = str) -> Compared:
    """Findings without those of a baseline: of several that are alike the first ones are taken for the known ones."""
    entries = list(baseline)
    left = Counter({entry.key: entry.times for entry in entries})
    fresh = []
    for diagnostic in diagnostics:
        key = _key(diagnostic, renamed)
        if diagnostic.code.is_bug or left[key] <= 0:
            fresh.append(diagnostic)
        else:
            left[key] -= 1
    return Compared(fresh, [entry._replace(times=left[entry.key]) for entry in entries if left[entry.key] > 0])
