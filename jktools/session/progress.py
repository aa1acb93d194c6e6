"""What a run over many files tells while it lasts."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[int, int, str], None]
"""Told before each file: how many are done, how many there are, and its path."""


def silent(done: int, total: int, path: str) -> None:
    """Show no progress."""
