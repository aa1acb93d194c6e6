"""What stops a body in a level: each sector's solid surfaces and ways out, built when a body first comes there."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from jktools.engine.flags import SurfaceFlag
from jktools.engine.ground import TOUCH, Vector
from jktools.geometry.plan import Plan
from jktools.geometry.sphere import Path, Polygon, above, inside, polygon

Float64 = npt.NDArray[np.float64]

MOVEMENT = 0x2
"""Adjoin flag: things pass."""
SEAM = 1e-5
"""JKU: a point this far outside a polygon still counts as on it, where a level's seams are not tight."""
MOST_SECTORS = 64
"""Sectors that one search goes through, as in the decompiled engine."""
SOLID = -1
"""In place of a sector: the surface leads nowhere."""


class SectorFaces:
    """The surfaces of one sector that a body meets: solid ones, and ways into other sectors.

    Solid is a surface without adjoin and with flag 0x4, and one whose adjoin lacks movement or is broken. Without
    either it is nothing: the engine ignores it.
    """

    def __init__(self, plan: Plan, sector: int) -> None:
        """Take the sound surfaces of a sector; coordinates are the plan's float32 values in float64."""
        self.flags = int(plan.sector_flags[sector])
        polygons: list[Polygon] = []
        leads: list[int] = []
        first, count = int(plan.first_surface[sector]), int(plan.surface_count[sector])
        for surface in range(max(first, 0), min(first + count, len(plan.surface_flags))):
            lead = _lead(plan, surface)
            face = _polygon(plan, surface) if lead is not None else None
            if lead is not None and face is not None:
                polygons.append(face)
                leads.append(lead)
        self.polygons, self.leads = tuple(polygons), tuple(leads)
        corners = [np.array([edge.start for edge in face.edges]) for face in polygons]
        self.low: Float64 = np.array([c.min(axis=0) for c in corners]).reshape(-1, 3)
        self.high: Float64 = np.array([c.max(axis=0) for c in corners]).reshape(-1, 3)

    def near(self, low: Vector, high: Vector) -> Iterator[tuple[Polygon, int]]:
        """Give the polygons whose boxes meet a box, each with where it leads."""
        apart = np.logical_or(self.low > high, self.high < low).any(axis=1)
        for i in np.flatnonzero(~apart).tolist():
            yield self.polygons[i], self.leads[i]

    def depth(self, point: Vector) -> float:
        """Give how far a point lies in front of all planes, JKU; negative outside the sector."""
        return min((above(face, point) for face in self.polygons), default=-np.inf)

    def exit(self, start: Vector, end: Vector) -> int | None:
        """Give the sector that a way leads into; SOLID if it leaves through no adjoin, None if it stays inside."""
        outside = [(face, lead) for face, lead in zip(self.polygons, self.leads, strict=True) if above(face, end) < 0]
        if not outside:
            return None
        ways = [(inside(face, _crossing(face, start, end)), lead) for face, lead in outside if lead != SOLID]
        best = max(ways, default=(-np.inf, SOLID))
        return best[1] if best[0] >= -SEAM else SOLID

    def below(self, point: Vector) -> tuple[float, Polygon, int] | None:
        """Give the polygon straight below a point: its height there, itself and where it leads; None in a gap.

        On a shared side the solid one, so that a point on an edge is carried.
        """
        found: list[tuple[float, bool, float, int]] = []
        for i, face in enumerate(self.polygons):
            if face.normal[2] <= 0:
                continue
            height = point[2] - above(face, point) / face.normal[2]
            place = inside(face, (point[0], point[1], height))
            if place >= -SEAM and height <= point[2] + TOUCH:
                found.append((min(place, 0.0), self.leads[i] == SOLID, height, i))
        if not found:
            return None
        _, _, height, i = max(found)
        return height, self.polygons[i], self.leads[i]


class Collision:
    """The sectors of a level as bodies meet them."""

    def __init__(self, plan: Plan) -> None:
        """Look at a level's geometry; nothing is computed yet."""
        self.plan = plan
        self._faces: dict[int, SectorFaces] = {}

    def faces(self, sector: int) -> SectorFaces:
        """Give a sector's surfaces."""
        if sector not in self._faces:
            self._faces[sector] = SectorFaces(self.plan, sector)
        return self._faces[sector]

    def follow(self, sector: int, start: Vector, end: Vector) -> int:
        """Give the sector in which a straight way from `start`, in `sector`, ends (JKU).

        A way that leaves through no adjoin, in a level whose seams gape, ends in the neighbour that holds its end,
        else in the last sector that it came through.
        """
        seen = {sector}
        while len(seen) < MOST_SECTORS:
            faces = self.faces(sector)
            lead = faces.exit(start, end)
            if lead == SOLID:
                lead = next((s for s in faces.leads if s != SOLID and self.faces(s).depth(end) >= 0), None)
            if lead is None or lead in seen:
                break
            seen.add(lead)
            sector = lead
        return sector

    def solids(self, sector: int, path: Path) -> Iterator[Polygon]:
        """Give the solid polygons that a sphere may touch on its way, of all sectors that it reaches.

        A sector is reached when the sphere's box meets the adjoin's box and the sphere comes to its plane.
        """
        end = path.at(path.length)
        margin = path.radius + TOUCH
        low = _shifted(tuple(map(min, path.start, end)), -margin)
        high = _shifted(tuple(map(max, path.start, end)), margin)
        seen, pending = {sector}, [sector]
        while pending:
            for face, lead in self.faces(pending.pop()).near(low, high):
                if lead == SOLID:
                    yield face
                elif lead not in seen and len(seen) < MOST_SECTORS:
                    heights = (above(face, path.start), above(face, end))
                    if min(heights) <= margin and max(heights) >= -margin:
                        seen.add(lead)
                        pending.append(lead)


def _lead(plan: Plan, surface: int) -> int | None:
    """The sector behind a surface, SOLID for a wall, None for what a body does not meet."""
    adjoin = int(plan.surface_adjoin[surface])
    if not 0 <= adjoin < len(plan.adjoin_flags):
        return SOLID if plan.surface_flags[surface] & SurfaceFlag.COLLISION else None
    beyond = int(plan.adjoin_sector[adjoin])
    return beyond if plan.adjoin_flags[adjoin] & MOVEMENT and beyond >= 0 else SOLID


def _polygon(plan: Plan, surface: int) -> Polygon | None:
    ring = plan.corner_vertex[plan.corner_start[surface] : plan.corner_start[surface + 1]]
    if not plan.sound_surfaces[surface] or len(ring) < 3:
        return None
    corners = [(x, y, z) for x, y, z in plan.positions[ring].astype(np.float64).tolist()]
    return polygon(surface, int(plan.surface_flags[surface]) | SurfaceFlag.COLLISION, corners)


def _crossing(face: Polygon, start: Vector, end: Vector) -> Vector:
    """Where a way to behind a plane crosses it; its start if that lies behind too."""
    before, after = above(face, start), above(face, end)
    part = before / (before - after) if before > 0 else 0.0
    x, y, z = (a + (b - a) * part for a, b in zip(start, end, strict=True))
    return (x, y, z)


def _shifted(corner: tuple[float, ...], by: float) -> Vector:
    return (corner[0] + by, corner[1] + by, corner[2] + by)
