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

BLANK: int = 1

SECTION: int = 2

WORLD: int = 4

END: int = 8

SECTOR: int = 16

def line_kinds(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.uint8], dict(shape=(None,))]:
    """
    What each line is at its first word: (n,) uint8 of BLANK, SECTION, WORLD, END, SECTOR or 0.
    """

def word_counts(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """How many fields each line has: (n,) int32."""

def read_fields(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], form: str, commas: bool) -> tuple[Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.float32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
    """
    Read records of one form: a letter a field (L label, i whole number, h flags, f number, w word), * a tail.

    Returns (recognised (n,) uint8, ints (n*i,) int64, floats (n*f,) float32, words (2*n*w,) int64 begins and ends,
    tail_start (n+1,) int64, tail (2*m,) int64). Rows that are not recognised to the letter mean nothing.
    Raises ValueError for an unknown letter or a line outside the text.
    """

def read_surfaces(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.float32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float32], dict(shape=(None,))]]:
    """
    Read surfaces: (recognised, ints (9n,) int64, extra_light, corner_start, pairs, light_start, light).
    """

def read_sectors(text: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.float32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Read sectors: (first_line, recognised, ints (4n,), floats (22n,), sound (2n,), line_of (13n,), vertex_start,
    vertex, vertex_line); the order of the values is that of native/text/records.hpp.
    """
