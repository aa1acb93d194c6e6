"""Things on the way of a segment: where it meets their bodies, exactly, and what may take them out of the way.

Profile `research` only: any solid thing blocks (research document, "HasLOS").
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine import orientation, sight
from jktools.geometry import BLOCKS, SectorMesh
from jktools.geometry.rest_pose import rest_pose
from jktools.model import Level, Thing

Float64 = npt.NDArray[np.float64]
Point = tuple[float, float, float]

FACES = 3
"""`collide` of a thing that collides with the faces of its model."""
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


def meeting(level: Level, thing: Thing, a: Point, b: Point, named: frozenset[int]) -> Meeting | None:
    """Tell where the segment from a to b (JKU) first meets a thing at its placed place; None where it does not.

    A thing with `collide` 3 whose model is at hand is its faces at rest (geoset 0, both sides), placed in double
    precision; every other solid one is the sphere of its `size`. Touching a sphere from outside, ending on a face and
    sliding along one do not count, as with walls. `named` are the numbers that COGs name: see `named_things`.
    """
    held = thing.resolved
    solid = sight.thing_blocks(held.type == "cog", int(held.number("collide")), held.flags("thingflags"), is_end=False)
    if thing.dropped is not None or not solid or not np.isfinite(thing.position).all():
        return None
    faces = body_mesh(level, thing) if held.number("collide") == FACES else None
    at = sphere_meeting(thing, a, b) if faces is None else _face_meeting(faces, a, b)
    return None if at is None else Meeting(thing, at, faces is None, _changes(thing, named))


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
    name = thing.resolved.name_in("model3d")
    model = None if name is None else level.resources.model(name)
    if model is None:
        return None
    pose = rest_pose(model)
    if not len(pose):
        return None
    if not np.isfinite(thing.angles).all():
        return None
    turn = orientation.matrix(thing.angles)
    vertices = pose.vertices.astype(np.float64) @ turn.T + thing.position.astype(np.float64)
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


def _face_meeting(faces: SectorMesh, a: Point, b: Point) -> Along | None:
    found = faces.explain(0, a, b)
    if found.visible:
        return None
    length = sum(((Fraction(q) - Fraction(p)) ** 2 for p, q in zip(a, b, strict=True)), Fraction(0))
    return Along(-Fraction(found.steps[-1].leave) * length, Fraction(0), length)


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
