"""A small level with something for every query: rooms at several heights, a pit, water, a window for sight only."""

from __future__ import annotations

from fixtures.rooms import VISIBLE
from fixtures.rooms import Level as Builder
from jktools.model import Level
from tests.support.levels import level_of

WATER = 0x2
PLAYER = "walkplayer none type=player move=physics physflags=0x4a4f size=.065 height=.18 jumpspeed=1.5 maxthrust=2"


def halls() -> Level:
    """Sectors 0 to 6: a hall, a pit, the bank beyond it, a step, a higher floor, a pool, and the shaft over it."""
    builder = Builder("halls")
    hall = builder.room((0, 0, 0), (4, 4, 3))
    pit = builder.room((4, 0, -2), (6, 4, 3))
    bank = builder.room((6, 0, 0), (8, 4, 3))
    step = builder.room((8, 0, 0.0625), (8.5, 4, 3))
    high = builder.room((8.5, 0, 0.5), (12, 4, 3))
    pool = builder.room((0, 4, -3), (4, 8, -1), flags=WATER)
    shaft = builder.room((0, 4, -1), (4, 8, 3))
    for one, other, x, sill in (
        (hall, pit, 4, 0), (pit, bank, 6, 0), (bank, step, 8, 0.0625), (step, high, 8.5, 0.5)
    ):  # fmt: skip
        builder.window(one, other, (x, 0, sill), (x, 4, 3))
    builder.window(pool, shaft, (0, 4, -1), (4, 8, -1))
    builder.window(hall, shaft, (0, 4, 0), (2, 4, 3))
    builder.window(hall, shaft, (2.5, 4, 1), (4, 4, 2), flags=VISIBLE)
    builder.templates.append(PLAYER)
    builder.thing("walkplayer", (2, 2, 0.18), hall)
    builder.thing("walkplayer", (11, 3, 0.68), high)
    return level_of(builder.text())
