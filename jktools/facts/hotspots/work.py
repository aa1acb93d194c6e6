"""What one sight test costs, as counted work: sectors entered and surfaces tested, never milliseconds.

Source: sithCollision_HasLos, sithCollision_SearchRadiusForThings and sithAI_GetThingsInView in the decompiled engine. A
ray tests every surface of each sector that it enters, up to what stops it. FirstThingInView walks from sector to sector
through adjoins, whichever way they lie from the ray to what it finds, and looks at every adjoin of each.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from jktools.geometry.mesh import ADJOIN_VISIBLE, SectorMesh
from jktools.geometry.validity import Float64
from jktools.model import Level

MOST_FLOODED = 128
"""Sectors of one FirstThingInView (sithAI_GetThingsInView)."""


class Work(NamedTuple):
    """What one test does, and whether sight reaches the end."""

    sectors: int
    surfaces: int
    visible: bool
    changeable: bool = False
    """Whether the way passes, or ends at, a surface that a script can change."""


class Place(NamedTuple):
    """Where an end of a test lies."""

    sector: int
    point: tuple[float, float, float]
    """JKU."""


class SightWork:
    """Counts the work of single tests in one level."""

    def __init__(self, level: Level, mesh: SectorMesh, changeable: frozenset[int]) -> None:
        """`changeable` are the surfaces that scripts can open or shut."""
        self.level, self.mesh, self.changeable = level, mesh, changeable
        self._rays: dict[tuple[Place, Place], Work] = {}

    @cached_property
    def surface_counts(self) -> list[int]:
        """Surfaces of each sector."""
        return [int(count) for count in self.level.document.sectors.surface_count]

    @cached_property
    def centres(self) -> Float64:
        """(sectors, 3) JKU: the mean of each sector's vertices; NaN where that is not known."""
        level = self.level
        found = np.full((len(level.sectors), 3), np.nan)
        for i in np.flatnonzero(level.sound_sectors).tolist():
            vertices = level.sectors[i].vertices
            if len(vertices):
                found[i] = level.vertices[vertices].astype(np.float64).mean(axis=0)
        return found

    def ray(self, origin: Place, target: Place) -> Work:
        """One HasLOS between two places, past walls only."""
        key = (origin, target)
        if key not in self._rays:
            self._rays[key] = self._ray(origin, target)
        return self._rays[key]

    def _ray(self, origin: Place, target: Place) -> Work:
        if not self.level.sound_sectors[origin.sector]:
            return Work(0, 0, visible=False, changeable=True)
        told = self.mesh.explain(origin.sector, origin.point, target.point)
        entered = [step.sector for step in told.steps]
        tested = sum(self.surface_counts[sector] for sector in entered)
        touched = any(step.surface in self.changeable for step in told.steps)
        return Work(len(entered), tested, told.visible, touched)

    def flood(self, origin: Place, farthest: float) -> Work:
        """One FirstThingInView that looks every way: depth first, while the way so far is at most `farthest` JKU.

        The way is counted by the `dist` of the adjoins, as the engine does. A viewer that looks one way passes only
        adjoins that face it: this is the most that any view can cost.
        """
        level = self.level
        adjoins = level.document.adjoins
        seen: set[int] = set()
        tested = 0
        pending = [(origin.sector, 0.0)]
        while pending and len(seen) < MOST_FLOODED:
            sector, way = pending.pop()
            if sector in seen or not level.sound_sectors[sector]:
                continue
            seen.add(sector)
            if way > farthest:
                continue
            through = [s.adjoin_index for s in level.sectors[sector].surfaces if s.adjoin is not None]
            tested += len(through)
            for adjoin in reversed(through):
                behind = int(level.adjoin_sector[adjoin])
                if behind >= 0 and int(adjoins.flags[adjoin]) & ADJOIN_VISIBLE:
                    mirror = int(adjoins.mirror[adjoin])
                    pending.append((behind, way + float(adjoins.distance[adjoin]) + float(adjoins.distance[mirror])))
        return Work(len(seen), tested, visible=True)
