"""The checksum of a compiled level: SHA-256 of the file with the checksum's own bytes taken as zero."""

from __future__ import annotations

import hashlib

import numpy as np
import numpy.typing as npt

from jktools.compiler import level_generated as fb


def seal(data: bytes | bytearray) -> bytes:
    """Write the checksum into a finished buffer."""
    buffer = bytearray(data)
    _stored(buffer)[:] = np.frombuffer(_digest(buffer), np.uint8)
    return bytes(buffer)


def is_intact(data: memoryview | bytes) -> bool:
    """Whether a verified buffer still has the bytes that it was written with."""
    return bytes(_stored(data)) == _digest(data)


def _digest(data: memoryview | bytes | bytearray) -> bytes:
    stored = _stored(data)
    start = stored.__array_interface__["data"][0] - np.frombuffer(data, np.uint8).__array_interface__["data"][0]
    view = memoryview(data)
    digest = hashlib.sha256(view[:start])
    digest.update(bytes(len(stored)))
    digest.update(view[start + len(stored) :])
    return digest.digest()


def _stored(data: memoryview | bytes | bytearray) -> npt.NDArray[np.uint8]:
    stored: npt.NDArray[np.uint8] = fb.Level.GetRootAs(data).ChecksumAsNumpy()  # type: ignore[no-untyped-call]
    return stored
