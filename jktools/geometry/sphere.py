"""A moving sphere against a polygon: its face, its edges, its corners.

Plain floats, not arrays: after the boxes have been compared two or three polygons are left, and for so few numpy costs
more than it saves.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from jktools.engine.ground import GRAZE, TOUCH, Vector


class Edge(NamedTuple):
    """One side of a polygon."""

    start: Vector
    along: Vector
    """Unit."""
    length: float
    inward: Vector
    """Unit, in the polygon's plane."""


class Polygon(NamedTuple):
    """A convex polygon: its unit normal, a point of its plane, and its sides counter-clockwise about the normal."""

    surface: int
    """Index of the level's surface."""
    flags: int
    point: Vector
    normal: Vector
    edges: tuple[Edge, ...]


class Path(NamedTuple):
    """A sphere's way: its centre's start, unit direction, length and radius, JKU."""

    start: Vector
    way: Vector
    length: float
    radius: float

    def at(self, distance: float) -> Vector:
        """Give the centre after `distance`."""
        return _plus(self.start, self.way, distance)


class Touch(NamedTuple):
    """Where a sphere first touches a polygon."""

    distance: float
    """JKU along the path."""
    normal: Vector
    """Unit, away from what is touched."""
    polygon: Polygon
    on_face: bool


def polygon(surface: int, flags: int, corners: Sequence[Vector]) -> Polygon | None:
    """Build a polygon from its corners; None where they span no area.

    The normal is that of the vector area (Newell) and the plane goes through the corners' mean, so a face that is
    slightly out of plane is met half way.
    """
    first, count = corners[0], len(corners)
    area = (0.0, 0.0, 0.0)
    for i in range(1, count - 1):
        area = _plus(area, cross(_minus(corners[i], first), _minus(corners[i + 1], first)), 1.0)
    normal = _unit(area)
    sides = [(corners[i], corners[(i + 1) % count]) for i in range(count)]
    if normal is None:
        return None
    edges = []
    for start, end in sides:
        along = _unit(_minus(end, start))
        if along is not None:
            edges.append(Edge(start, along, math.dist(start, end), cross(normal, along)))
    x, y, z = (math.fsum(corner[axis] for corner in corners) / count for axis in range(3))
    return Polygon(surface, flags, (x, y, z), normal, tuple(edges))


def inside(face: Polygon, point: Vector) -> float:
    """Give how far a point lies inside a polygon's nearest side, JKU; negative outside."""
    return min(dot(edge.inward, _minus(point, edge.start)) for edge in face.edges)


def above(face: Polygon, point: Vector) -> float:
    """Give a point's height over a polygon's plane, JKU; negative behind."""
    return dot(face.normal, _minus(point, face.point))


def distance(face: Polygon, point: Vector) -> float:
    """Give how far a point lies from a polygon, JKU: from its face if it stands over it, else from its sides."""
    height = above(face, point)
    if inside(face, _plus(point, face.normal, -height)) >= 0:
        return abs(height)
    return min(_from_edge(edge, point) for edge in face.edges)


def _from_edge(edge: Edge, point: Vector) -> float:
    along = min(max(dot(_minus(point, edge.start), edge.along), 0.0), edge.length)
    return math.dist(point, _plus(edge.start, edge.along, along))


def touches(face: Polygon, path: Path) -> Iterator[Touch]:
    """Find where a sphere touches a polygon from its front: its face if it can, else sides and corners."""
    distance = _to_face(face, path)
    if distance is not None:
        if distance <= path.length:
            yield Touch(distance, face.normal, face, on_face=True)
        return
    for edge in face.edges:
        for along, length in ((edge.along, edge.length), ((0.0, 0.0, 0.0), 0.0)):
            touch = _to_round(edge.start, along, length, path)
            if touch and above(face, path.at(touch[0])) >= -TOUCH:
                yield Touch(*touch, face, on_face=False)


def _to_face(face: Polygon, path: Path) -> float | None:
    """Distance to the face; 0 for a sphere that is in it already and moves deeper; None if its way misses it."""
    closing, height = -dot(face.normal, path.way), above(face, path.start)
    if closing * path.length <= GRAZE or height < -TOUCH:
        return None
    distance = max(0.0, (height - path.radius) / closing)
    centre = path.at(distance)
    foot = _plus(centre, face.normal, -above(face, centre))
    return distance if inside(face, foot) >= 0 else None


def _to_round(point: Vector, along: Vector, length: float, path: Path) -> tuple[float, Vector] | None:
    """Distance to an edge (a cylinder of the sphere's radius) or, with no direction, to a corner; and the normal."""
    offset = _minus(path.start, point)
    out = _plus(offset, along, -dot(offset, along))
    way = _plus(path.way, along, -dot(path.way, along))
    speed, nearing = dot(way, way), dot(out, way)
    apart = dot(out, out) - path.radius * path.radius
    reach = nearing * nearing - speed * apart
    if nearing >= 0 or reach <= 0 or speed < GRAZE:
        return None
    distance = max(0.0, (-nearing - math.sqrt(reach)) / speed)
    there = _plus(offset, path.way, distance)
    place = dot(there, along)
    away = _unit(_plus(there, along, -place))
    if distance > path.length or not 0 <= place <= length or away is None:
        return None
    return (distance, away) if -dot(away, path.way) * path.length > GRAZE else None


def dot(a: Vector, b: Vector) -> float:
    """Multiply two vectors to a number."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Multiply two vectors to a vector."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _plus(a: Vector, b: Vector, times: float) -> Vector:
    return (a[0] + b[0] * times, a[1] + b[1] * times, a[2] + b[2] * times)


def _unit(a: Vector) -> Vector | None:
    size = math.hypot(*a)
    return (a[0] / size, a[1] / size, a[2] / size) if size > 0 else None
