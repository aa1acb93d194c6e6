"""How much can be in view from each sector, by the level's visibility: (sectors,) counts.

From anywhere in the sector, in any direction, past walls only: no view holds more.
"""

from __future__ import annotations

import numpy as np

from jktools.geometry.validity import Int32
from jktools.geometry.visibility import VisibleSectors
from jktools.model import Level

TRANSLUCENT = 0x2
"""Face flag."""
EMITS_LIGHT = 0x1
"""Thing flag."""


def sectors_in_view(level: Level, visible: VisibleSectors) -> Int32:  # noqa: ARG001
    """Sectors, the own one included."""
    counts: Int32 = visible.matrix.sum(axis=1, dtype=np.int32)
    return counts


def translucent_in_view(level: Level, visible: VisibleSectors) -> Int32:
    """Translucent surfaces that are drawn."""
    table = level.document.surfaces
    drawn = (table.face_flags & TRANSLUCENT != 0) & (table.geometry_mode > 0) & (table.material >= 0)
    return _in_sectors(level, visible, level.surface_sector[drawn])


def lights_in_view(level: Level, visible: VisibleSectors) -> Int32:
    """Placed things that shine."""
    shining = [
        thing.sector_index
        for thing in level.things
        if thing.dropped is None
        and thing.resolved.flags("thingflags") & EMITS_LIGHT
        and max(thing.resolved.number("light"), thing.resolved.number("lightintensity")) > 0
    ]
    return _in_sectors(level, visible, np.array(shining, np.int32))


def _in_sectors(level: Level, visible: VisibleSectors, sectors: Int32) -> Int32:
    counts = np.bincount(sectors[sectors >= 0], minlength=len(level.sectors))
    return (visible.matrix.astype(np.int32) @ counts.astype(np.int32)).astype(np.int32)
