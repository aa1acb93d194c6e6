"""A progress bar on a terminal, for what takes longer than a second."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from jktools.session.progress import Progress, silent

PATIENCE = 1.0
"""Seconds before a bar appears."""


@contextmanager
def progress(title: str) -> Iterator[Progress]:
    """Yield what a batch reports to; it stays silent unless standard error is a terminal."""
    if not sys.stderr.isatty():
        yield silent
        return
    started = time.monotonic()
    bar: Any = None
    task: Any = None

    def report(done: int, total: int, path: str) -> None:
        nonlocal bar, task
        if bar is None and time.monotonic() - started > PATIENCE:
            from rich.console import Console  # noqa: PLC0415 (most runs never show a bar)
            from rich.progress import Progress as Bar  # noqa: PLC0415

            bar = Bar(console=Console(stderr=True), transient=True)
            task = bar.add_task(title, total=total)
            bar.start()
        if bar is not None:
            bar.update(task, completed=done, total=total, description=f"{title} {path}")

    try:
        yield report
    finally:
        if bar is not None:
            bar.stop()
