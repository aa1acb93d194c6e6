"""Standard output and error as they may be: closed, full, or of an encoding that lacks a character."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from typing import TextIO

_FAIL = ("strict", "surrogateescape")
"""How a character that an encoding lacks is handled unless somebody chose otherwise: it ends the run."""


def prepare() -> None:
    """Make both streams take any text: what is closed swallows it, what lacks a character shows its escape."""
    # A closed descriptor would be given to the next file opened, and a library's print would write into that.
    sys.stdout = _opened(sys.stdout)
    sys.stderr = _opened(sys.stderr)
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors in _FAIL:
        sys.stdout.reconfigure(errors="backslashreplace")


def _opened(stream: TextIO | None) -> TextIO:
    return open(os.devnull, "w", encoding="utf-8") if stream is None else stream  # noqa: PTH123 (for good)


def tell(text: str) -> None:
    """Write a line to standard error; where that takes it not, nobody can be told."""
    try:
        print(text, file=sys.stderr, flush=True)
    except OSError:
        let_go(sys.stderr)


def let_go(stream: TextIO) -> None:
    """Keep Python from flushing, at its end, into what takes no more: a closed pipe or a full disk."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
