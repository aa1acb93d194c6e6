"""Native reading of game text; only jktools.syntax imports it."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


CONTINUED: int = 1

CUT: int = 2

TAIL: int = 4

COMMENT_IN_WORD: int = 8

def logical_lines(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], buffer_size: int) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))]]:
    """
    Cut a text into logical lines as the engine does.

    Returns (line_segment (n+1,) int64, segment_start (m,) int64, segment_end (m,) int64, flags (n,) uint8):
    line i is the concatenation of the byte ranges segment_start[k]:segment_end[k] for k in
    line_segment[i]:line_segment[i+1]. Raises ValueError when buffer_size is below 2.
    """

def decimals(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.float32], dict(shape=(None,))]:
    """
    Read numbers parted by single blanks, each rounded once to float32.

    Returns (n,) float32; too large becomes infinity. Raises ValueError naming the word that is no number.
    """
