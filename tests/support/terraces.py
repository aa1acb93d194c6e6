"""The floors of `engine.ground.Steps` as a level: one room a tread, open above the higher of two neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from fixtures.rooms import Level as Builder
from jktools.engine.ground import SURFACES, Steps, Tread
from jktools.model import Level
from tests.support.levels import level_of

HALF_WIDTH, TOP, FAR = 8.0, 4.0, 16.0
"""JKU: rooms reach this far to both sides, up, and beyond the first and the last tread's start."""


def terraces(treads: Sequence[Tread]) -> Level:
    """Build the level of some treads; heights and starts must be float32 values."""
    builder = Builder("terraces")
    ends = [*(tread.start for tread in treads[1:]), treads[-1].start + FAR]
    starts = [treads[1].start - FAR if len(treads) > 1 else -FAR, *(tread.start for tread in treads[1:])]
    for tread, start, end in zip(treads, starts, ends, strict=True):
        room = ((-HALF_WIDTH, start, tread.height), (HALF_WIDTH, end, TOP))
        builder.room(*room, floor_flags=tread.surface)
    for i, (here, after) in enumerate(pairwise(treads)):
        sill = max(here.height, after.height)
        builder.window(i, i + 1, (-HALF_WIDTH, after.start, sill), (HALF_WIDTH, after.start, TOP))
    return level_of(builder.text())


def rounded(*treads: tuple[float, float]) -> Steps:
    """Treads whose numbers are what a level's float32 makes of them."""
    return Steps(tuple(Tread(float(np.float32(y)), float(np.float32(z)), SURFACES["floor"]) for y, z in treads))
