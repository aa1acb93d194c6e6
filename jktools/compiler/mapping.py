"""Compiled levels as files: how they are known, and mapped into memory."""

from __future__ import annotations

import errno
import mmap
import os
import stat
from pathlib import Path

SUFFIX = ".jklb"
IDENTIFIER = b"JKLB"
"""Bytes 4 to 7 of the file."""


def is_compiled(path: str | Path) -> bool:
    """Whether a path names a compiled level: by its ending, or by the mark in its first bytes."""
    file = Path(path)
    if file.suffix.lower() == SUFFIX:
        return True
    try:
        with file.open("rb") as stream:
            return stream.read(8)[4:] == IDENTIFIER
    except OSError:
        return False


def mapping(path: str | Path) -> mmap.mmap:
    """Map a file for reading. Raises OSError, and ValueError for an empty file."""
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))
    try:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        return mmap.mmap(descriptor, 0, access=mmap.ACCESS_READ)
    finally:
        os.close(descriptor)
