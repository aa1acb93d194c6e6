"""What the game's renderer takes into one frame: sectors, translucent surfaces, lights.

As sithRender_Clip, sithRender_RenderLevelGeometry and sithRender_UpdateLights of the decompiled engine do: from sector to
sector through every adjoin that shows what lies behind, seen through the rectangle on the screen around what is left of
it; the rectangle lets more pass than the adjoin itself. An adjoin shows what lies behind when it is visible (0x1) and is
not drawn, or drawn translucent, or with a texture that has holes. Of each sector that a frame reaches count

| what | which | at most |
|---|---|---|
| the sector | | 128 |
| translucent surfaces | drawn, adjoined, translucent (0x2) or with holes, facing the camera, on the screen or not | 32 |
| lights | things that shine (`light`), and actors and players with their field light on, here and in each sector beside it | 32 |

What cannot be known is left out: a texture whose file is not at hand has no holes, and lights farther off are not looked
for. So a frame holds at least what is told. It looks level, as far as a screen of 4 to 3 shows at 90 degrees.
"""  # noqa: E501 (a table)

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from jktools.facts.lights import may_shine
from jktools.model import Level
from jktools.model.resolved import Resolved
from jktools.model.resources import Kind
from jktools.syntax.assets.material import Material

Point = tuple[float, float, float]
Rectangle = tuple[float, float, float, float]
"""Left, right, bottom and top of what is seen, at the distance 1."""

VISIBLE = 0x1
"""Of an adjoin's flags."""
TRANSLUCENT = 0x2
"""Face flag."""
FIELD_LIGHT = 0x4
"""Typeflag of actors and players."""
NEAR = 1 / 64
"""JKU before the camera from which on something is drawn."""
SCREEN: Rectangle = (-1.0, 1.0, -0.75, 0.75)
PIXEL = 2 / 640
"""Of a screen 640 wide: what is left of an adjoin counts from this size on."""
MOST_STEPS = 20_000
"""Adjoins that one frame is followed through; of more, what was found until then is told."""


class Frame(NamedTuple):
    """What a frame takes in, at least."""

    sectors: int
    translucent: int
    lights: int


@dataclass(frozen=True, slots=True)
class _Portal:
    number: int
    behind: int
    normal: Point
    corners: tuple[Point, ...]


class Camera:
    """Takes frames of one level."""

    def __init__(self, level: Level) -> None:
        """Find the adjoins that show what lies behind, what is translucent, and what shines."""
        self.level = level
        count = len(level.sectors)
        self.portals: list[list[_Portal]] = [[] for _ in range(count)]
        self.glass: list[list[tuple[Point, Point]]] = [[] for _ in range(count)]
        """Of each sector: normal and a corner of its translucent surfaces."""
        self.beside: list[list[int]] = [[] for _ in range(count)]
        """The sectors behind visible adjoins, shown or not."""
        self.shining = [0] * count
        for surface in np.flatnonzero(level.sound_surfaces & (level.document.surfaces.adjoin >= 0)).tolist():
            self._add(surface)
        for thing in level.things:
            if thing.dropped is None and 0 <= thing.sector_index < count:
                self.shining[thing.sector_index] += lights_of(thing.resolved)

    def _add(self, index: int) -> None:
        level, table = self.level, self.level.document.surfaces
        sector, adjoin = int(level.surface_sector[index]), int(table.adjoin[index])
        behind = int(level.adjoin_sector[adjoin]) if 0 <= adjoin < len(level.adjoins) else -1
        if sector < 0 or behind < 0:
            return
        first, last = int(table.corner_start[index]), int(table.corner_start[index + 1])
        corners = tuple(_point(row) for row in level.vertices[table.corner_vertex[first:last]].tolist())
        normal = _point(level.surfaces[index].normal.tolist())
        drawn = int(table.geometry_mode[index]) > 0 and int(table.material[index]) >= 0
        clear = bool(int(table.face_flags[index]) & TRANSLUCENT) or self._has_holes(int(table.material[index]))
        if drawn and clear:
            self.glass[sector].append((normal, corners[0]))
        if int(level.document.adjoins.flags[adjoin]) & VISIBLE:
            self.beside[sector].append(behind)
            if clear or not drawn:
                self.portals[sector].append(_Portal(index, behind, normal, corners))

    def _has_holes(self, material: int) -> bool:
        if not 0 <= material < len(self.level.materials):
            return False
        read = self.level.resources.asset(Kind.MATERIAL, self.level.materials[material])
        return isinstance(read, Material) and any(texture.transparent for texture in read.textures)

    def frame(self, sector: int, eye: Point, yaw: float) -> Frame:
        """Look from a point of a sector (JKU) in a direction, degrees to the left of north."""
        turn = math.radians(yaw)
        sine, cosine = math.sin(turn), math.cos(turn)
        seen = {sector}
        pending: list[tuple[int, Rectangle, frozenset[int]]] = [(sector, SCREEN, frozenset((sector,)))]
        shapes: dict[int, _Shape | None] = {}  # a frame comes by an adjoin on many ways
        steps = 0
        while pending and steps < MOST_STEPS:
            here, window, way = pending.pop()
            for portal in self.portals[here]:
                if portal.behind in way:
                    continue
                if portal.number not in shapes:
                    shapes[portal.number] = _shape(portal, eye, sine, cosine)
                shape = shapes[portal.number]
                if shape is None:
                    continue
                steps += 1
                left = _window(shape, window)
                if left is not None:
                    seen.add(portal.behind)
                    pending.append((portal.behind, left, way | {portal.behind}))
        return self._counted(seen, eye)

    def _counted(self, seen: set[int], eye: Point) -> Frame:
        glass = sum(1 for sector in seen for normal, corner in self.glass[sector] if _faces(normal, corner, eye))
        lit = seen.union(*(self.beside[sector] for sector in seen))
        return Frame(len(seen), glass, sum(self.shining[sector] for sector in lit))


def lights_of(held: Resolved) -> int:
    """How many lights a thing is to the renderer."""
    if not may_shine(held):
        return 0
    field = held.type in ("actor", "player") and held.flags("typeflags") & FIELD_LIGHT
    return (held.number("light") > 0) + bool(field and held.number("lightintensity") > 0)


def _point(values: list[float]) -> Point:
    x, y, z = values
    return x, y, z


def _faces(normal: Point, corner: Point, eye: Point) -> bool:
    """Whether a surface looks at the camera, by its written normal."""
    return (eye[0] - corner[0]) * normal[0] + (eye[1] - corner[1]) * normal[1] + (eye[2] - corner[2]) * normal[2] > 0


def _turned(point: Point, eye: Point, sine: float, cosine: float) -> Point:
    """A point as the camera sees it: x right, y forward, z up."""
    x, y = point[0] - eye[0], point[1] - eye[1]
    return x * cosine + y * sine, y * cosine - x * sine, point[2] - eye[2]


class _Shape(NamedTuple):
    """An adjoin as the camera sees it, and the rectangle around it; of nothing, one that overlaps no window."""

    corners: list[Point]
    around: Rectangle


_NOTHING = _Shape([], (math.inf, -math.inf, math.inf, -math.inf))


def _shape(portal: _Portal, eye: Point, sine: float, cosine: float) -> _Shape | None:
    """What of an adjoin lies before the camera; None for one that looks away."""
    if not _faces(portal.normal, portal.corners[0], eye):
        return None
    return _before([_turned(corner, eye, sine, cosine) for corner in portal.corners])


def _before(corners: list[Point]) -> _Shape:
    corners = _clipped(corners, [y - NEAR for _, y, _ in corners])
    return _Shape(corners, _around(corners)) if len(corners) >= 3 else _NOTHING


def _around(corners: list[Point]) -> Rectangle:
    across = [x / y for x, y, _ in corners]
    up = [z / y for _, y, z in corners]
    return min(across), max(across), min(up), max(up)


def _window(shape: _Shape, window: Rectangle) -> Rectangle | None:
    """The rectangle around what is left of an adjoin in a window; None for nothing."""
    left, right, bottom, top = window
    least_x, most_x, least_z, most_z = around = shape.around
    if most_x < left or least_x > right or most_z < bottom or least_z > top:
        return None
    if least_x < left or most_x > right or least_z < bottom or most_z > top:
        corners = _inside(shape.corners, window)
        if len(corners) < 3:
            return None
        around = _around(corners)
    left, right, bottom, top = around
    return around if right - left >= PIXEL and top - bottom >= PIXEL else None


def _inside(corners: list[Point], window: Rectangle) -> list[Point]:
    left, right, bottom, top = window
    corners = _clipped(corners, [x - left * y for x, y, _ in corners])
    corners = _clipped(corners, [right * y - x for x, y, _ in corners])
    corners = _clipped(corners, [z - bottom * y for _, y, z in corners])
    return _clipped(corners, [top * y - z for _, y, z in corners])


def _clipped(corners: list[Point], sides: list[float]) -> list[Point]:
    """What of a polygon lies on the inner side of a plane: `sides` tells how far inside each corner is."""
    if len(corners) < 3 or max(sides) < 0:
        return []
    if min(sides) >= 0:
        return corners
    found: list[Point] = []
    for i, (point, side) in enumerate(zip(corners, sides, strict=True)):
        before, other = corners[i - 1], sides[i - 1]
        if (side > 0 > other) or (side < 0 < other):
            t = other / (other - side)
            found.append(
                (
                    before[0] + (point[0] - before[0]) * t,
                    before[1] + (point[1] - before[1]) * t,
                    before[2] + (point[2] - before[2]) * t,
                )
            )
        if side >= 0:
            found.append(point)
    return found
