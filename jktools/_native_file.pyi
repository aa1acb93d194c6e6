"""Native verifier of compiled levels; only jktools.compiler imports it."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def verify_level(buffer: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> bool:
    """
    Whether the buffer is a compiled level all of whose offsets stay inside it.
    """
