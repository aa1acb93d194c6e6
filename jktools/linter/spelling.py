"""The nearest name where one was misspelt."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

LEAST_LIKENESS = 0.8
"""Share of letters in common (difflib's ratio): below it, two names of a game are mostly two different things."""


def did_you_mean(typed: str, known: Iterable[str]) -> str | None:
    """Help that names the nearest of the lower-case names, or None when none is near."""
    near = difflib.get_close_matches(typed.lower(), list(known), n=1, cutoff=LEAST_LIKENESS)
    return f'did you mean "{near[0]}"?' if near else None
