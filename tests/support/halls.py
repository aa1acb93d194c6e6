"""A small level with something for every query: rooms at several heights, a pit, water, a window for sight only."""

from __future__ import annotations

import numpy as np

from fixtures.rooms import MOVEMENT, OPEN, VISIBLE
from fixtures.rooms import Level as Builder
from jktools.model import Level
from tests.support.levels import level_of

WATER = 0x2
PLAYER = "walkplayer none type=player move=physics physflags=0x4a4f size=.065 height=.18 jumpspeed=1.5 maxthrust=2"


def halls() -> Level:
    """Sectors 0 to 6: a hall, a pit, the bank beyond it, a step, a higher floor, a pool, and the shaft over it."""
    return level_of(_text())


def crooked_halls(seed: int) -> Level:
    """The same with every vertex moved by up to half a JKU: bent faces, sectors that overlap, gaps between them."""
    rng = np.random.default_rng(seed)
    lines = _text().split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith("World vertices"))
    for i in range(start + 1, lines.index("", start)):
        label, *numbers = lines[i].split()
        moved = np.array(numbers, float) + rng.integers(-4, 5, 3) / 8
        lines[i] = " ".join([label, *map(str, moved.tolist())])
    return level_of("\n".join(lines))


def crossroads(first: bool, second: bool) -> Level:
    """Four rooms around an edge: from 0 into 1 and 2, and on into 3 where sight passes the first or the second."""
    builder = Builder("crossroads")
    for x, y in ((0, 0), (2, 0), (0, 2), (2, 2)):
        builder.room((x, y, 0), (x + 2, y + 2, 2))
    builder.window(0, 1, (2, 0, 0), (2, 2, 2))
    builder.window(0, 2, (0, 2, 0), (2, 2, 2))
    builder.window(1, 3, (2, 2, 0), (4, 2, 2), flags=OPEN if first else MOVEMENT)
    builder.window(2, 3, (2, 2, 0), (2, 4, 2), flags=OPEN if second else MOVEMENT)
    return level_of(builder.text())


def _text() -> str:
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
    return builder.text()
