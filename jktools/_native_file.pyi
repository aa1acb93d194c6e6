"""Native reader of compiled levels; only jktools.compiler imports it."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def level_fault(buffer: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> str:
    """
    What is wrong with a buffer that should be a compiled level, in one sentence; empty for one that can be read
    everywhere. The buffer must start at a multiple of 8 bytes.
    """

def level_parts(buffer: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.uint16], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
    """
    Where the columns of a buffer without a fault lie: (columns * 10,) int64, and the step of each, (columns,)
    float64; native/file/parts.hpp tells what the numbers mean. `columns` has three numbers for each: the vtable
    offsets of its section (0: the level itself), of its vector and of its packed form (0: none).
    """
