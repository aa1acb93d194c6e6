"""Which sectors can be seen from which: the potentially visible set."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Bool = npt.NDArray[np.bool_]
UInt8 = npt.NDArray[np.uint8]

Progress = Callable[[int, int], object]
"""Called now and then with how much of how much is done; may raise to stop the work."""


class VisibleSectors(NamedTuple):
    """Which sectors can be seen from each, a bit a pair."""

    rows: UInt8
    """(n, (n + 7) // 8): bit b % 8 of byte b // 8 of row a says that sector b is potentially visible from a."""
    portals: int
    """See-through surfaces, what may come to be see-through included."""
    cut_short: int
    """Portals with more than 8,192 chains behind them: the rest was flooded as `fast` does, which is looser."""

    @property
    def matrix(self) -> Bool:
        """(n, n) bool: row a, column b."""
        return unpacked(self.rows)


def unpacked(rows: UInt8) -> Bool:
    """Give the (n, n) bool matrix of (n, (n + 7) // 8) rows of bits."""
    return np.unpackbits(rows, axis=1, count=len(rows), bitorder="little").view(np.bool_)


def compressed(row: bytes) -> bytes:
    """Write runs of zero bytes as a zero and their length, 1 to 255: the coding of Quake's visibility lump."""
    return re.sub(rb"\0{1,255}", lambda run: bytes((0, len(run[0]))), row)


def expanded(data: bytes, size: int) -> bytes:
    """Undo `compressed` for a row of `size` bytes. Raises ValueError when the data is no such row."""
    row = re.sub(rb"\0(.)", lambda run: bytes(run[1][0]), data, flags=re.DOTALL) if len(data) <= 2 * size else b""
    if len(row) != size or compressed(row) != data:
        raise ValueError(f"{len(data)} bytes do not expand to a row of {size}")
    return row
