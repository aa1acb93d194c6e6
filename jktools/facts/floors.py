"""The floor below points, among sectors and the things that bodies stand on.

A thing of type cog with thing flag 0x40 and `collide` 3 is a floor on the faces of its model whose normals stand up by
0.6 or more (`sithPhysics_FindFloor` in the decompiled engine): where it is placed, and at each of its frames. Whether a
point is above a face, and how far, is decided as by `SectorMesh.drop`, about vertices that are turned and moved in
double precision.

Limits: a thing carries wherever its faces are, of whatever sector it is. Between two frames it is nowhere. The frames
of a template's own path are not worked out (`Floors.strayed`). Without its model a thing may be a floor anywhere in the
sphere of its `size`, and of UNKNOWN_SIZE if it has none.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine import orientation, sight
from jktools.engine.attachment import FACE_NORMAL_Z
from jktools.facts.occluders import FACES, model_pose, placed_vertices
from jktools.geometry import BLOCKS, CARRIES, Accuracy, Drop, Ending, SectorMesh
from jktools.geometry.drop import NO_LIMIT
from jktools.geometry.ledges import Solids
from jktools.geometry.rest_pose import RestPose
from jktools.model import Level, Thing
from jktools.syntax.template.parameters import Scope

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

STANDABLE = 0x40
"""Thing flag: bodies stand on it."""
FARTHEST = 2.0**140
"""JKU: frames beyond are no places; geometry is exact below 2^150."""
UNKNOWN_SIZE = 2.0
"""JKU: taken for the size of a thing that neither says it nor has its model at hand; that of a large lift."""
PLACED = -1
"""In place of a frame: where the level places the thing."""
GONE = -2
"""In place of a frame: at none of the places that are known."""
Point = tuple[float, float, float]


class Below(NamedTuple):
    """What is straight below each point, (n,) each: the first five as in `Drop`."""

    surface: Int32
    distance: Float64
    ending: UInt8
    """FLOOR on a thing too; UNKNOWN beneath a thing whose model is not at hand."""
    met: Int32
    sector: Int32
    """With a thing, where the fall would end without it."""
    thing: Int32
    """Index of the thing that carries where it is placed, or that makes it UNKNOWN; -1 for none."""
    face: Int32
    """The face that carries, counted over those of the model at rest (`RestPose`); -1 for none."""
    other: Int32
    """Index of a thing that carries nearer to the point at one of its frames; the nearest; -1 for none."""
    frame: Int32
    """Which frame of it, -1 for none."""
    other_distance: Float64
    """JKU, not a number for none."""


@dataclass(frozen=True, slots=True)
class Platform:
    """A thing at one place: the faces of it that bodies stand on."""

    thing: Thing
    frame: int
    """PLACED, or which of its frames."""
    mesh: SectorMesh
    faces: Int32
    """Of the model at rest, one a surface of the mesh."""
    low: Float64
    high: Float64
    """(3,) JKU: the box around them."""
    pose: RestPose
    vertices: Float64
    """(n, 3) JKU: those of the model at rest, where the thing is."""

    def over(self, points: Float64) -> npt.NDArray[np.intp]:
        """Which points, (n, 3), may lie above it."""
        inside = (self.low[:2] <= points[:, :2]) & (points[:, :2] <= self.high[:2])
        return np.flatnonzero(inside.all(axis=1) & (points[:, 2] >= self.low[2]))


class Ball(NamedTuple):
    """A place of a thing whose model is not at hand."""

    thing: Thing
    centre: Point
    radius: float

    def crossed(self, top: Point, bottom: float) -> bool:
        """Whether the way straight down from a point to a height comes through its inside. Exact."""
        across = sum(
            ((Fraction(p) - Fraction(c)) ** 2 for p, c in zip(top[:2], self.centre[:2], strict=True)), Fraction()
        )
        square = Fraction(self.radius) ** 2 - across
        if square <= 0:
            return False
        over = Fraction(self.centre[2]) - Fraction(top[2])
        if over > 0 and over * over >= square:
            return False
        under = 1 if bottom == -np.inf else Fraction(self.centre[2]) - Fraction(bottom)
        return under > 0 or under * under < square


class Scene(NamedTuple):
    """One way in which the things of a level can be."""

    thing: int
    """Index of the one that is not as it is placed; -1 where all are."""
    frame: int
    """Where it is."""
    present: Bool
    """(platforms,): those that are there."""
    moved: Bool
    """(platforms,): those that make the difference: of the thing, where it is placed and where it is."""


@dataclass(slots=True)
class Floors:
    """The things of a level that bodies stand on, at all their places."""

    platforms: list[Platform] = field(default_factory=list)
    """Those whose models are at hand; one without a face that stands up is left out."""
    balls: list[Ball] = field(default_factory=list)
    """The places of those whose models are not."""
    strayed: list[Thing] = field(default_factory=list)
    """Those with frames of their templates, whose places on the way are not worked out."""
    moves: dict[int, list[int]] = field(default_factory=dict)
    """By the index of a thing whose model is at hand, the frames at which it is not as it is placed; GONE for one that
    comes to be at places that are not worked out."""

    @classmethod
    def of(cls, level: Level) -> Floors:
        """Find them."""
        found = cls()
        for thing in level.things:
            if not carries(thing):
                continue
            places = [(PLACED, thing.position.astype(np.float64), thing.angles.astype(np.float64)), *_frames(thing)]
            strays = len(places) == 1 and "frame" in thing.resolved.values
            if strays:
                found.strayed.append(thing)
            pose = model_pose(level, thing)
            if pose is None:
                found.balls += [_ball(thing, position) for _, position, _ in places]
                continue
            moves = [GONE] if strays or thing.resolved.move == "physics" else []
            for frame, position, angles in places:
                if frame != PLACED:
                    if np.array_equal(position, places[0][1]) and np.array_equal(angles, places[0][2]):
                        continue
                    moves.append(frame)
                platform = _platform(thing, frame, pose, position, angles)
                if platform is not None:
                    found.platforms.append(platform)
            if moves:
                found.moves[thing.index] = moves
        return found

    def scenes(self) -> Iterator[Scene]:
        """How the things can be: all as they are placed, then each moving one at each of its frames."""
        each = np.arange(len(self.platforms), dtype=np.int32)
        thing, frame = self.thing_of(each), self.frame_of(each)
        placed = frame == PLACED
        yield Scene(-1, PLACED, placed, ~placed & False)
        for index, frames in self.moves.items():
            for number in frames:
                here = (thing == index) & (frame == number)
                yield Scene(index, number, placed & (thing != index) | here, (thing == index) & placed | here)

    def thing_of(self, platforms: Int32) -> Int32:
        """The index of the thing of each platform; -1 for -1."""
        return np.array([*(platform.thing.index for platform in self.platforms), -1], np.int32)[platforms]

    def frame_of(self, platforms: Int32) -> Int32:
        """Where the thing of each platform is; PLACED for -1."""
        return np.array([*(platform.frame for platform in self.platforms), PLACED], np.int32)[platforms]

    def boxes(self) -> tuple[Float64, Float64]:
        """The least and greatest corners, (n, 3) JKU, of the boxes in which a thing may carry, at all places."""
        centre = np.array([ball.centre for ball in self.balls], np.float64).reshape(-1, 3)
        radius = np.array([ball.radius for ball in self.balls], np.float64).reshape(-1, 1)
        low = np.array([platform.low for platform in self.platforms], np.float64).reshape(-1, 3)
        high = np.array([platform.high for platform in self.platforms], np.float64).reshape(-1, 3)
        return np.concatenate([low, centre - radius]), np.concatenate([high, centre + radius])

    def solids(self) -> Solids:
        """All faces of the platforms, in their order."""
        if not self.platforms:
            return Solids.none()
        corners: list[npt.NDArray[Any]] = []
        starts: list[npt.NDArray[Any]] = [np.zeros(1, np.int32)]
        solid, carries, first, last = [], [], 0, 0
        for number, platform in enumerate(self.platforms):
            pose = platform.pose
            corners.append(pose.corner_vertex + first)
            starts.append(pose.corner_start[1:] + last)
            solid.append(np.full(len(pose), number))
            carries.append(_faces_up(platform))
            first, last = first + len(platform.vertices), last + int(pose.corner_start[-1])
        return Solids(
            np.concatenate([platform.vertices for platform in self.platforms]),
            np.concatenate(starts).astype(np.int32), np.concatenate(corners).astype(np.int32),
            np.concatenate(solid).astype(np.int32), np.concatenate(carries), len(self.platforms),
        )  # fmt: skip

    def below(
        self,
        mesh: SectorMesh,
        points: npt.ArrayLike,
        sectors: npt.ArrayLike,
        max_distance: npt.ArrayLike = NO_LIMIT,
        *,
        own: npt.ArrayLike = -1,
        accuracy: Accuracy = "balanced",
        threads: int = 0,
    ) -> Below:
        """Find the floor below points, (n, 3) JKU, in their sectors, (n,): `mesh.drop`, and things.

        A thing carries that is nearer than what ends the fall in the sectors, the nearest of them, at equal distance
        the first; `own` is the index of a thing that does not count for a point, one for all or (n,). Tiers, threads
        and errors as for `drop`.
        """
        top = np.ascontiguousarray(points, np.float64).reshape(-1, 3)
        found = mesh.drop(top, sectors, max_distance, accuracy, threads)
        apart = np.broadcast_to(np.asarray(own, np.int64), (len(top),))
        limit = np.where(found.ending == Ending.FAR, np.nextafter(found.distance, np.inf), found.distance)
        placed = self._nearest(top, limit, apart, accuracy, threads, placed=True)
        end, limit = (np.where(placed.thing >= 0, placed.distance, each) for each in (found.distance, limit))
        moved = self._nearest(top, limit, apart, accuracy, threads, placed=False)
        carried = placed.thing >= 0
        below = Below(
            np.where(carried, -1, found.surface).astype(np.int32), end,
            np.where(carried, Ending.FLOOR, found.ending).astype(np.uint8),
            np.where(carried, -1, found.met).astype(np.int32), found.sector,
            placed.thing, placed.face, moved.thing, moved.frame, moved.distance,
        )  # fmt: skip
        self._doubt(top, apart, below)
        return below

    def _nearest(
        self, top: Float64, end: Float64, own: npt.NDArray[np.int64], accuracy: Accuracy, threads: int, *, placed: bool
    ) -> _Nearest:
        """The nearest platform nearer than `end`, of those where things are placed, or at frames."""
        best = _Nearest.none(len(top))
        for platform in self.platforms:
            if (platform.frame == PLACED) != placed:
                continue
            rows = platform.over(top)
            rows = rows[own[rows] != platform.thing.index]
            if not len(rows):
                continue
            fall: Drop = platform.mesh.drop(top[rows], np.zeros(len(rows), np.int32), NO_LIMIT, accuracy, threads)
            nearer = (fall.ending == Ending.FLOOR) & (fall.distance < end[rows])
            nearer &= (best.thing[rows] < 0) | (fall.distance < best.distance[rows])
            rows, faces = rows[nearer], fall.surface[nearer]
            best.thing[rows], best.frame[rows] = platform.thing.index, platform.frame
            best.face[rows], best.distance[rows] = platform.faces[faces], fall.distance[nearer]
        return best

    def _doubt(self, top: Float64, own: npt.NDArray[np.int64], below: Below) -> None:
        """Take the answer from points beneath which a thing lies whose model is not at hand."""
        for ball in self.balls:
            reach = ball.radius * (1 + 1e-9) + 1e-9
            near = (np.abs(top[:, :2] - ball.centre[:2]) <= reach).all(axis=1) & (own != ball.thing.index)
            for row in np.flatnonzero(near & (below.ending != Ending.UNKNOWN)).tolist():
                x, y, z = top[row].tolist()
                if ball.crossed((x, y, z), z - float(below.distance[row])):
                    below.ending[row], below.distance[row], below.thing[row] = Ending.UNKNOWN, np.nan, ball.thing.index
                    for column in (below.surface, below.met, below.face, below.other, below.frame):
                        column[row] = -1
                    below.other_distance[row] = np.nan


class _Nearest(NamedTuple):
    """The nearest platform so far below each point."""

    thing: Int32
    face: Int32
    frame: Int32
    distance: Float64

    @classmethod
    def none(cls, count: int) -> _Nearest:
        thing, face, frame = (np.full(count, -1, np.int32) for _ in range(3))
        return cls(thing, face, frame, np.full(count, np.nan))


def carries(thing: Thing) -> bool:
    """Whether bodies stand on the faces of a thing."""
    held = thing.resolved
    collide, flags = int(held.number("collide")), held.flags("thingflags")
    solid = sight.thing_blocks(held.type == "cog", collide, flags, is_end=False)
    return (
        held.type == "cog"
        and bool(flags & STANDABLE)
        and collide == FACES
        and bool(solid)
        and thing.dropped is None
        and bool(np.isfinite(thing.position).all() and np.isfinite(thing.angles).all())
    )


def _frames(thing: Thing) -> Iterator[tuple[int, Float64, Float64]]:
    """The frames of a thing's own path: number, position and angles."""
    frames = thing.resolved.values.get("frame")
    if frames is None or frames.use.scope is not Scope.PATH or not isinstance(frames.value, tuple):
        return
    if any(origin.owner != thing for origin in frames.origins):
        return
    for i, frame in enumerate(frames.value):
        place = np.array(frame, np.float64) if isinstance(frame, tuple) else np.full(6, np.nan)
        if (np.abs(place) < FARTHEST).all():
            yield i, place[:3], place[3:]


def _platform(thing: Thing, frame: int, pose: RestPose, position: Float64, angles: Float64) -> Platform | None:
    upright = (pose.normal.astype(np.float64) @ orientation.matrix(angles).T)[:, 2]
    faces = np.flatnonzero(upright >= FACE_NORMAL_Z).astype(np.int32)
    if not len(faces):
        return None
    vertices = placed_vertices(pose, position, angles)
    rings = [pose.corner_vertex[pose.corner_start[f] : pose.corner_start[f + 1]] for f in faces.tolist()]
    corners = np.concatenate(rings)
    start = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])])
    mesh = SectorMesh.from_arrays(
        vertices, start, corners, [BLOCKS] * len(faces), [0], [len(faces)], passes_to=[CARRIES] * len(faces)
    )
    used = vertices[corners]
    return Platform(thing, frame, mesh, faces, used.min(axis=0), used.max(axis=0), pose, vertices)


def _faces_up(platform: Platform) -> Bool:
    """Which faces of the model bodies stand on: upright ones whose corners turn so that they face up."""
    pose, vertices = platform.pose, platform.vertices
    owner = np.repeat(np.arange(len(pose)), np.diff(pose.corner_start))
    after = np.arange(1, len(owner) + 1)
    after[pose.corner_start[1:] - 1] = pose.corner_start[:-1]
    here = vertices[pose.corner_vertex] - vertices[pose.corner_vertex[pose.corner_start[owner]]]
    turn = here[:, 0] * here[after, 1] - here[:, 1] * here[after, 0]
    up: Bool = np.bincount(owner, weights=turn, minlength=len(pose)) > 0
    upright = np.zeros(len(pose), np.bool_)
    upright[platform.faces] = True
    return up & upright


def _ball(thing: Thing, position: Float64) -> Ball:
    size = thing.resolved.values.get("size")
    radius = size.value if size is not None and isinstance(size.value, float) else UNKNOWN_SIZE
    x, y, z = position.tolist()
    return Ball(thing, (x, y, z), min(max(radius, 0.0), np.finfo(np.float64).max) if radius == radius else UNKNOWN_SIZE)
