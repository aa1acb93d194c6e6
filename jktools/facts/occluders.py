"""Things on the way of a segment: where it meets their bodies, exactly, and what may take them out of the way.

| | `research` | `openjkdf2` |
|---|---|---|
| which | any solid thing | any solid thing of type cog |
| a face (`collide` 3) | from both sides; an end on it is not blocked | from its front, once the segment comes into the sphere of `size`; an end on it is blocked |
| without its model | the sphere | nobody knows: the sphere, and the verdict varies |

Sources: research document, "HasLOS"; `sithCollision_SearchForThingCollisions` and
`sithIntersect_CheckSphereThingIntersection` in the decompiled engine.
"""  # noqa: E501 (a table)

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine import orientation, sight
from jktools.engine.profile import Engine
from jktools.geometry import BLOCKS, SectorMesh
from jktools.geometry.engine_sight import Faces
from jktools.geometry.rest_pose import RestPose, rest_pose
from jktools.model import Level, Thing

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Point = tuple[float, float, float]

FACES = 3
"""`collide` of a thing that collides with the faces of its model."""
_SLACK = 1e-9
"""Of a coordinate: far more than what tells near things from far ones can be off."""
_NUMBER = re.compile(r"\+?\d{1,9}")


class Along(NamedTuple):
    """A place on a segment at t = (-b - sqrt(d)) / a of the way, 0 to 1; a is the segment's squared length."""

    b: Fraction
    d: Fraction
    a: Fraction

    def __float__(self) -> float:
        """The place as a rounded figure."""
        return max(0.0, (-float(self.b) - math.sqrt(self.d)) / float(self.a)) if self.a else 0.0

    def before(self, other: Along) -> bool:
        """Whether it comes strictly before another place on the same segment. Exact."""
        return _sign(other.b - self.b, other.d, self.d) < 0


class Meeting(NamedTuple):
    """Where a segment first meets a thing."""

    thing: Thing
    at: Along
    by_sphere: bool
    """Whether the sphere decided: it is all the thing has, or its model is not at hand."""
    changes: str | None
    """Why the thing may be elsewhere, or not solid, at another time."""


class Occluders:
    """The solid things of a level at their placed places; bodies are made when they are first asked for."""

    def __init__(self, level: Level) -> None:
        """Find them."""
        self.level = level
        self.named = named_things(level)
        self.things = tuple(thing for thing in level.things if _is_solid(thing, Engine.RESEARCH))
        self.place = {thing.index: i for i, thing in enumerate(self.things)}
        """Where a thing stands in `things`, by its index."""
        self.unjudged = tuple(
            thing
            for thing in level.things
            if thing.dropped is None and "collide" not in thing.resolved.values and thing.resolved.leaves_level
        )
        """Those whose templates are not at hand, so that nothing tells whether they are solid."""
        self._bodies: dict[int, SectorMesh | None] = {}
        self._fronts: dict[int, Faces | None] = {}

    @cached_property
    def _balls(self) -> tuple[Float64, Float64]:
        """Where each of `things` is, (n, 3), and a radius that holds its body, (n,) JKU."""
        places = np.array([thing.position for thing in self.things], np.float64).reshape(-1, 3)
        return places, np.array([self._reach(thing) for thing in self.things], np.float64)

    def _reach(self, thing: Thing) -> float:
        size = thing.resolved.number("size")
        reach = size if size > 0 else 0.0
        front = self.front(thing) if thing.resolved.number("collide") == FACES else None
        if front is None:
            return reach
        return max(reach, float(np.linalg.norm(front.corners - thing.position, axis=2).max(initial=0.0)))

    def near(self, a: npt.ArrayLike, b: npt.ArrayLike) -> Bool:
        """Tell which of `things` segments from a to b, (n, 3) JKU, may meet: (n, things), never too few."""
        start, end = (np.asarray(points, np.float64).reshape(-1, 1, 3) for points in (a, b))
        places, reach = self._balls
        along, off = end - start, places - start
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            part = np.clip((off * along).sum(axis=2) / (along * along).sum(axis=2), 0, 1)
            apart = np.linalg.norm(off - along * np.nan_to_num(part)[..., None], axis=2)
            slack = _SLACK * (1 + np.abs(start).max(axis=2) + np.abs(end).max(axis=2) + np.abs(places).max(axis=1))
            return np.asarray(~(apart > reach * (1 + _SLACK) + slack))

    def body(self, thing: Thing) -> SectorMesh | None:
        """Take a thing's faces from both sides: `body_mesh`."""
        if thing.index not in self._bodies:
            self._bodies[thing.index] = body_mesh(self.level, thing)
        return self._bodies[thing.index]

    def front(self, thing: Thing) -> Faces | None:
        """Take a thing's faces from their fronts; None without them."""
        if thing.index not in self._fronts:
            self._fronts[thing.index] = _front_faces(self.level, thing)
        return self._fronts[thing.index]

    def meetings(self, a: Point, b: Point, engine: Engine) -> Iterator[Meeting]:
        """Find where the segment from a to b (JKU) first meets each thing, in the order of the level."""
        for i in np.flatnonzero(self.near(a, b)[0]).tolist():
            found = self.meeting(self.things[i], a, b, engine)
            if found is not None:
                yield found

    def meeting(self, thing: Thing, a: Point, b: Point, engine: Engine = Engine.RESEARCH) -> Meeting | None:
        """Tell where the segment from a to b (JKU) first meets a thing at its placed place; None where it does not.

        A thing with `collide` 3 whose model is at hand is its faces at rest (geoset 0), placed in double precision;
        every other solid one is the sphere of its `size`. Touching a sphere from outside and sliding along a face do
        not count.
        """
        if not _is_solid(thing, engine):
            return None
        if thing.resolved.number("collide") != FACES:
            at, by_sphere, changes = sphere_meeting(thing, a, b), True, None
        elif engine is Engine.RESEARCH:
            body = self.body(thing)
            at, by_sphere = sphere_meeting(thing, a, b) if body is None else _face_meeting(body, a, b), body is None
            changes = None
        else:
            front, at = self.front(thing), sphere_meeting(thing, a, b)
            by_sphere = front is None
            changes = (
                None if front is not None else "its model is not at hand, so that nobody knows where its faces are"
            )
            if front is not None and at is not None:
                at = _front_meeting(front, a, b)
        return None if at is None else Meeting(thing, at, by_sphere, changes or _changes(thing, self.named))


def _is_solid(thing: Thing, engine: Engine) -> bool:
    held = thing.resolved
    solid = sight.thing_blocks(
        held.type == "cog", int(held.number("collide")), held.flags("thingflags"), is_end=False, engine=engine
    )
    return thing.dropped is None and bool(solid) and bool(np.isfinite(thing.position).all())


def sphere_meeting(thing: Thing, a: Point, b: Point) -> Along | None:
    """Tell where the segment from a to b enters the sphere of a thing's `size`; its start, if that lies within."""
    size = thing.resolved.number("size")
    if not size > 0:
        return None
    place = [Fraction(float(x)) for x in thing.position]
    along = [Fraction(q) - Fraction(p) for p, q in zip(a, b, strict=True)]
    off = [Fraction(p) - c for p, c in zip(a, place, strict=True)]
    length = sum((x * x for x in along), Fraction(0))
    towards = sum((x * y for x, y in zip(off, along, strict=True)), Fraction(0))
    if math.isinf(size):
        return Along(Fraction(0), Fraction(0), length)
    outside = sum((x * x for x in off), Fraction(0)) - Fraction(size) ** 2
    if outside < 0:
        return Along(Fraction(0), Fraction(0), length)
    root = towards * towards - length * outside
    ends_outside = outside + 2 * towards + length >= 0
    if towards >= 0 or root <= 0 or (-towards >= length and ends_outside):
        return None
    return Along(towards, root, length)


def body_mesh(level: Level, thing: Thing) -> SectorMesh | None:
    """Take the faces of a thing's model at rest, at its placed pose, both sides, as one sector; None without them.

    Vertices are turned and moved in double precision; answers about them are exact from there.
    """
    pose = model_pose(level, thing)
    if pose is None or not np.isfinite(thing.angles).all():
        return None
    return faces_mesh(placed_vertices(pose, thing.position, thing.angles), pose)


def faces_mesh(vertices: Float64, pose: RestPose) -> SectorMesh:
    """Take the faces of a model, from both sides, as one sector; its vertices as they are placed, (n, 3) JKU."""
    counts = np.diff(pose.corner_start)
    flipped = [pose.corner_vertex[s:e][::-1] for s, e in zip(pose.corner_start, pose.corner_start[1:], strict=False)]
    start = np.concatenate([[0], np.cumsum(np.concatenate([counts, counts]))])
    return SectorMesh.from_arrays(
        vertices,
        start,
        np.concatenate([pose.corner_vertex, *flipped]),
        [BLOCKS] * (2 * len(pose)),
        [0],
        [2 * len(pose)],
    )


def model_pose(level: Level, thing: Thing) -> RestPose | None:
    """The faces of a thing's model at rest; None where the model is not at hand or has none."""
    name = thing.resolved.name_in("model3d")
    model = None if name is None else level.resources.model(name)
    if model is None:
        return None
    pose = rest_pose(model)
    return pose if len(pose) else None


def placed_vertices(pose: RestPose, position: npt.ArrayLike, angles: npt.ArrayLike) -> Float64:
    """Give the vertices of a model in the level, (n, 3) JKU, at a position, (3,) JKU, and pitch, yaw, roll, degrees."""
    turn = orientation.matrix(angles)
    return np.asarray(pose.vertices.astype(np.float64) @ turn.T + np.asarray(position, np.float64))


def fan_corners(vertices: Float64, pose: RestPose) -> tuple[Float64, list[int]]:
    """Cut the faces of a model into triangles, (n, 3, 3) JKU, each with its face."""
    rings = [pose.corner_vertex[s:e] for s, e in zip(pose.corner_start, pose.corner_start[1:], strict=False)]
    fans = [(face, (r[0], r[i], r[i + 1])) for face, r in enumerate(rings) for i in range(1, len(r) - 1)]
    corners = vertices[np.array([fan for _, fan in fans], np.intp).reshape(-1, 3)]
    return corners, [face for face, _ in fans]


def _front_faces(level: Level, thing: Thing) -> Faces | None:
    pose = model_pose(level, thing)
    if pose is None or not np.isfinite(thing.angles).all():
        return None
    return Faces(*fan_corners(placed_vertices(pose, thing.position, thing.angles), pose))


def _face_meeting(faces: SectorMesh, a: Point, b: Point) -> Along | None:
    found = faces.explain(0, a, b)
    return None if found.visible else place_on(a, b, Fraction(found.steps[-1].leave))


def _front_meeting(front: Faces, a: Point, b: Point) -> Along | None:
    at = front.first(a, b)
    return None if at is None else place_on(a, b, at)


def place_on(a: Point, b: Point, part: Fraction) -> Along:
    """Give the place at a part, 0 to 1, of the segment from a to b."""
    length = sum(((Fraction(q) - Fraction(p)) ** 2 for p, q in zip(a, b, strict=True)), Fraction(0))
    return Along(-part * length, Fraction(0), length)


def named_things(level: Level) -> frozenset[int]:
    """Give the numbers that a value of a placed COG can name as a thing, as long as its script is not asked."""
    return frozenset(int(value) for value in level.document.cogs.values if _NUMBER.fullmatch(value))


def _changes(thing: Thing, named: frozenset[int]) -> str | None:
    held = thing.resolved
    if held.move == "physics":
        return "it moves by physics"
    if "frame" in held.values:
        return "it has frames to move to"
    if held.name_in("cog") is not None:
        return f"it has a COG of its own ({held.name_in('cog')})"
    return "a placed COG may name it" if thing.number in named else None


def _sign(x: Fraction, p: Fraction, q: Fraction) -> int:
    """The sign of x + sqrt(p) - sqrt(q), exactly."""
    roots = (p > q) - (p < q)
    whole = (x > 0) - (x < 0)
    if roots * whole >= 0:
        return roots or whole
    # Of opposite signs: |sqrt(p) - sqrt(q)| against |x|, squared twice.
    rest = p + q - x * x
    if rest < 0:
        return whole
    square, other = rest * rest, 4 * p * q
    return roots if square > other else whole if square < other else 0
