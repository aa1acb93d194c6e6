"""The fullest frames of a level, sought where most can be seen.

Frames are taken from the middles of the sectors that see most, by the level's visibility, and from near the vertices of
the best of these, all around. A frame that is found is certain; that there is no fuller one is not.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from jktools.facts.camera import Camera, Point
from jktools.geometry.validity import Int32
from jktools.geometry.visibility import VisibleSectors
from jktools.model import Level

YAWS = tuple(range(0, 360, 30))
MOST_SECTORS = 64
"""Sectors that frames are taken from."""
MOST_CORNERS = 4
"""Of these, the fullest are looked from at their vertices too."""
TOWARDS_VERTEX = 0.8
"""Of the way from the middle of a sector to a vertex."""


class Counted(enum.IntEnum):
    """What is counted, by its place in `Frame`."""

    SECTORS = 0
    TRANSLUCENT = 1
    LIGHTS = 2


class FullFrame(NamedTuple):
    """A frame, and what it takes in."""

    held: int
    sector: int
    eye: Point
    """JKU."""
    yaw: int
    """Degrees to the left of north, +y."""

    @property
    def place(self) -> str:
        """For messages: `from (1, 2, 3) in sector 4, 30 degrees left of north,`."""
        x, y, z = self.eye
        turned = f"{self.yaw} degrees left of north" if self.yaw else "north"
        return f"from ({x:.4g}, {y:.4g}, {z:.4g}) in sector {self.sector}, {turned},"


def totals(level: Level, camera: Camera) -> tuple[int, int, int]:
    """What no frame can exceed: all that the level has, by `Counted`."""
    return len(level.sectors), sum(map(len, camera.glass)), sum(camera.shining)


def in_view(camera: Camera, visible: VisibleSectors) -> tuple[Int32, Int32, Int32]:
    """How much lies where each sector's visibility goes, (sectors,), by `Counted`; frames can hold more."""
    seen = visible.matrix.astype(np.int32)
    glass = np.array([len(each) for each in camera.glass], np.int32)
    return seen.sum(axis=1, dtype=np.int32), seen @ glass, seen @ np.array(camera.shining, np.int32)


def fullest(level: Level, camera: Camera, seen: Int32, item: Counted) -> FullFrame | None:
    """The fullest frame that is found; `seen` (sectors,) tells where to look first."""
    order = [int(i) for i in np.argsort(-seen, kind="stable") if level.sound_sectors[i]]
    first = [_fullest(camera, sector, [_middle(level, sector)], item) for sector in order[:MOST_SECTORS]]
    first.sort(key=lambda found: -found.held)
    again = [
        _fullest(camera, found.sector, list(_near_vertices(level, found.sector)), item)
        for found in first[:MOST_CORNERS]
    ]
    return max([*first, *again], key=lambda frame: frame.held, default=None)


def _fullest(camera: Camera, sector: int, eyes: list[Point], item: Counted) -> FullFrame:
    frames = (FullFrame(camera.frame(sector, eye, yaw)[item], sector, eye, yaw) for eye in eyes for yaw in YAWS)
    return max(frames, key=lambda frame: frame.held)


def _middle(level: Level, sector: int) -> Point:
    x, y, z = level.vertices[level.sectors[sector].vertices].astype(np.float64).mean(axis=0).tolist()
    return x, y, z


def _near_vertices(level: Level, sector: int) -> Iterator[Point]:
    middle = np.array(_middle(level, sector))
    for vertex in level.vertices[level.sectors[sector].vertices].astype(np.float64):
        x, y, z = (middle + (vertex - middle) * TOWARDS_VERTEX).tolist()
        yield x, y, z
