"""Maps a file into memory."""

from __future__ import annotations

import errno
import mmap
import os
import stat
from pathlib import Path


def mapping(path: str | Path) -> mmap.mmap:
    """Map a file for reading. Raises OSError, and ValueError for an empty file."""
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))
    try:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        return mmap.mmap(descriptor, 0, access=mmap.ACCESS_READ)
    finally:
        os.close(descriptor)
