"""What the geometry of a level is made of, as plain arrays: of a level as written, or of a compiled one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.model import Level

Bool = npt.NDArray[np.bool_]
Float32 = npt.NDArray[np.float32]
Int32 = npt.NDArray[np.int32]
UInt32 = npt.NDArray[np.uint32]


class Plan(NamedTuple):
    """Sectors, their surfaces and the adjoins between them, as written.

    Corners of sound surfaces and surfaces of sound sectors are within bounds; the rest may name what is not there.
    """

    positions: Float32
    """(vertices, 3), JKU; not finite where a vertex could not be read."""
    corner_start: Int32
    """Surface i has the corners [corner_start[i], corner_start[i + 1])."""
    corner_vertex: Int32
    surface_flags: UInt32
    surface_adjoin: Int32
    """What is no adjoin counts as none."""
    adjoin_flags: UInt32
    adjoin_sector: Int32
    """The sector that each adjoin leads into, -1 for none."""
    sector_flags: UInt32
    first_surface: Int32
    surface_count: Int32
    sound_surfaces: Bool
    """What can be computed with."""
    sound_sectors: Bool

    def by_adjoin(self, values: Int32, none: int) -> Int32:
        """The value of each surface's adjoin, `none` for a surface without one."""
        count = len(self.adjoin_flags)
        has_adjoin = (self.surface_adjoin >= 0) & (self.surface_adjoin < count)
        # The entry behind the last stands for none.
        return np.append(values, none).astype(np.int32)[np.where(has_adjoin, self.surface_adjoin, count)]

    @property
    def has_adjoin(self) -> Bool:
        """(surfaces,)."""
        return np.asarray((self.surface_adjoin >= 0) & (self.surface_adjoin < len(self.adjoin_flags)))


def plan_of(level: Level) -> Plan:
    """Take the geometry of a level."""
    document = level.document
    return Plan(
        level.vertices, document.surfaces.corner_start, document.surfaces.corner_vertex, document.surfaces.flags,
        document.surfaces.adjoin, document.adjoins.flags, level.adjoin_sector, document.sectors.flags,
        document.sectors.first_surface, document.sectors.surface_count, level.sound_surfaces, level.sound_sectors,
    )  # fmt: skip
