"""How much memory this process holds, native memory included: what the kernel counts, since Python cannot.

On Linux the peak can be set back, so that it tells of one computation; elsewhere nothing is measured.
"""

from __future__ import annotations

import contextlib
import ctypes
import gc
import re
from pathlib import Path

_STATUS = Path("/proc/self/status")
_CLEAR = Path("/proc/self/clear_refs")
_PEAK_TO_NOW = "5"
"""What clear_refs takes to set the peak back to what is held now (proc(5))."""


def start() -> int | None:
    """Give back what is free, forget the peak so far, and tell how many bytes are held; None if nobody can tell."""
    gc.collect()
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)  # of glibc: what is free would hide what is taken next
    try:
        _CLEAR.write_text(_PEAK_TO_NOW)
    except OSError:
        return None
    return _held("VmHWM")


def peak() -> int | None:
    """The most bytes that were held at a time since `start`."""
    return _held("VmHWM")


def _held(field: str) -> int | None:
    try:
        found = re.search(rf"^{field}:\s*(\d+) kB$", _STATUS.read_text(), re.MULTILINE)
    except OSError:
        return None
    return int(found[1]) * 1024 if found else None
