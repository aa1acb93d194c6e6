"""The sectors of a level as a mesh: which sector holds a point, and what sees what."""

from __future__ import annotations

from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_geometry import Faller, Viewer  # noqa: TID251 (this package is the door)
from jktools._native_geometry import visibility as native_visibility  # noqa: TID251 (this package is the door)
from jktools.geometry.drop import CARRIES, NO_LIMIT, Drop, Ending, Ground, ground
from jktools.geometry.plan import Plan, plan_of
from jktools.geometry.visibility import Progress, VisibleSectors
from jktools.model import Level

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]

Accuracy = Literal["fast", "balanced", "exact"]

BLOCKS = -1
"""What a surface leads to when sight does not pass it."""

ADJOIN_VISIBLE = 0x1
"""Adjoin flag: sight passes (sithCollision_HasLos in the decompiled engine)."""


class Sight(NamedTuple):
    """What each query found, (n,) each."""

    visible: Bool
    crossed: Int32
    """Sectors on the way that decided, the first and the last included; 0 where the first sector is unknown."""
    blocker: Int32
    """The surface that blocks, -1 where none does."""


class Location(NamedTuple):
    """Where each point lies, (n,) each."""

    sector: Int32
    """The first sector that holds the point inside, else the first on whose boundary it lies, else -1."""
    inside: Int32
    """How many sectors hold the point inside: more than one overlap there."""
    touching: Int32
    """On how many sectors' boundaries it lies: two on a shared face."""


class Step(NamedTuple):
    """One sector on the way of a segment, and how the segment leaves it."""

    sector: int
    surface: int
    """-1 where the segment ends in the sector."""
    leave: float
    """How far along the segment, 0 to 1."""


class Explanation(NamedTuple):
    """One query step by step: the way that decided it."""

    visible: bool
    steps: tuple[Step, ...]

    @property
    def blocker(self) -> int:
        """The surface that blocks, -1 when the target is visible."""
        return -1 if self.visible else self.steps[-1].surface


class SectorMesh:
    """Convex sectors bounded by polygons, glued by adjoins; immutable.

    A surface is the fan of its vertices as written; triangles whose three corners lie exactly on one line are
    dropped. Whether a level keeps to convex sectors and planar surfaces does not matter: answers are about what is
    written.
    """

    def __init__(self, viewer: Viewer, known: Bool, leads_to: Int32, behind: Int32, ground: Ground) -> None:
        """Use `from_level` or `from_arrays`."""
        self._viewer = viewer
        self._known = known
        self._leads_to = leads_to
        self._behind = behind
        self._ground = ground

    @classmethod
    def from_level(cls, level: Level) -> SectorMesh:
        """Take the sectors of a level, in the float32 coordinates that the engine holds.

        An unsound sector (see `Level.sound_sectors`) is left out: adjoins into it block, and a query that starts in
        it is answered with crossed 0. An adjoin with no sector behind it blocks as well.
        """
        return cls.from_plan(plan_of(level))

    @classmethod
    def from_plan(cls, plan: Plan) -> SectorMesh:
        """Take the geometry of a level, whether as written or compiled; the rest as `from_level`."""
        arrays = plan_arrays(plan)
        return cls(Viewer(*arrays), plan.sound_sectors, arrays[3], _sector_behind(plan, 0), ground(plan))

    @classmethod
    def from_arrays(
        cls,
        positions: npt.ArrayLike,
        surface_start: npt.ArrayLike,
        surface_vertex: npt.ArrayLike,
        leads_to: npt.ArrayLike,
        sector_first: npt.ArrayLike,
        sector_count: npt.ArrayLike,
        passes_to: npt.ArrayLike | None = None,
        under_water: npt.ArrayLike | None = None,
    ) -> SectorMesh:
        """Take a mesh as arrays: positions (n, 3) float64, JKU, used as they are; the rest integers.

        Surface i has the vertices `surface_vertex[surface_start[i]:surface_start[i + 1]]`, counter-clockwise seen
        from inside its sector, and leads into the sector `leads_to[i]`, or BLOCKS. Sector i owns `sector_count[i]`
        surfaces from `sector_first[i]` on. `passes_to` tells what a falling body meets at each surface, as in `Ground`
        (by default it passes where sight does and is carried everywhere else), `under_water` which sectors are (by
        default none). Raises ValueError naming the index that is out of bounds, or a position that is not finite or
        has a coordinate of 2^150 JKU or more.
        """
        leads = _integers(leads_to)
        viewer = Viewer(
            _points(positions), _integers(surface_start), _integers(surface_vertex), leads,
            _integers(sector_first), _integers(sector_count),
        )  # fmt: skip
        everywhere = np.ones(len(_integers(sector_first)), np.bool_)
        ground = Ground(
            np.where(leads == BLOCKS, CARRIES, leads).astype(np.int32) if passes_to is None else _integers(passes_to),
            ~everywhere if under_water is None else np.ascontiguousarray(under_water, np.bool_),
        )
        mesh = cls(viewer, everywhere, leads, leads, ground)
        if passes_to is not None or under_water is not None:
            _ = mesh._faller  # checks them
        return mesh

    @property
    def native(self) -> Viewer:
        """The native mesh, for the other modules of this package."""
        return self._viewer

    @cached_property
    def _faller(self) -> Faller:
        return Faller(self._viewer, self._ground.passes_to, self._ground.under_water.view(np.uint8))

    @property
    def memory(self) -> int:
        """Bytes of native memory held."""
        return self._viewer.memory

    def locate(self, points: npt.ArrayLike, accuracy: Accuracy = "balanced", threads: int = 0) -> Int32:
        """Find the sector of each point, (n, 3) JKU, or -1; `location` tells the points in several."""
        return self.location(points, accuracy, threads).sector

    def location(self, points: npt.ArrayLike, accuracy: Accuracy = "balanced", threads: int = 0) -> Location:
        """Find the sectors that hold each point, (n, 3) JKU.

        A sector holds a point inside when its triangles wind around it, whatever their shape. A sector that is not
        closed holds the points that lie behind none of its triangles. A point on a face that sectors share belongs
        to the first of them, unless another sector holds it inside.

        `balanced` and `exact` are exact in float64; `fast` counts what is straight above the point in plain doubles,
        and takes every sector for closed. threads 0 means one a core. Raises ValueError naming the point that is not
        finite or has a coordinate of 2^150 JKU or more.
        """
        return Location(*self._viewer.locate(_points(points), accuracy, threads))

    def sight(
        self,
        origins: npt.ArrayLike,
        sectors: npt.ArrayLike,
        targets: npt.ArrayLike,
        accuracy: Accuracy = "balanced",
        threads: int = 0,
    ) -> Sight:
        """Ask whether targets, (n, 3) JKU, are seen from origins, (n, 3) JKU, in their sectors, (n,).

        Walls only: things do not block, and every surface without a see-through adjoin does (research document).
        `balanced` and `exact` are exact in float64, `fast` is not: plain doubles, without a check. Exactness costs
        nothing here (benchmarks/bench_sight.py): `balanced` looks at segments eight at a time in float32 and is the
        fastest of the three in a batch. threads 0 means one a core; the answers are the same for any number. Raises
        ValueError naming the row whose sector does not exist or whose coordinate is not finite or 2^150 JKU or more.
        """
        first = _integers(sectors)
        visible, crossed, blocker = self._viewer.sight(_points(origins), first, _points(targets), accuracy, threads)
        found = Sight(visible.view(np.bool_), crossed, blocker)
        return found if self._known.all() else self._without_unknown(found, first)

    def sees(
        self,
        origins: npt.ArrayLike,
        sectors: npt.ArrayLike,
        targets: npt.ArrayLike,
        target_sectors: npt.ArrayLike,
        visible: VisibleSectors | None = None,
        threads: int = 0,
    ) -> Bool:
        """Ask whether targets are seen in their own sectors, (n,): visible as `sight` says, on a way that enters them.

        That differs from `sight` only where the target lies outside the sector given, or the segment slips past it by
        a gap between surfaces; a target in no sector, -1, is not seen. `visible`, from `visible_sectors`, answers many
        queries without a walk and changes no answer. The rest as for `sight`, exact.
        """
        first, aims = _integers(sectors), _integers(target_sectors)
        rows = np.empty(0, np.uint8) if visible is None else np.ascontiguousarray(visible.rows).reshape(-1)
        found = self._viewer.sees(_points(origins), first, _points(targets), aims, rows, threads).view(np.bool_)
        return found & self._known[first]

    def _without_unknown(self, found: Sight, first: Int32) -> Sight:
        known = self._known[first]
        return Sight(found.visible & known, np.where(known, found.crossed, 0), found.blocker)

    def visibility(self, accuracy: Accuracy = "balanced", threads: int = 0, open_surfaces: npt.ArrayLike = ()) -> Bool:
        """Tell which sectors can be seen from which, (n, n): the matrix of `visible_sectors`."""
        return self.visible_sectors(accuracy, threads, open_surfaces).matrix

    def visible_sectors(
        self,
        accuracy: Accuracy = "balanced",
        threads: int = 0,
        open_surfaces: npt.ArrayLike = (),
        progress: Progress | None = None,
    ) -> VisibleSectors:
        """Find which sectors a segment from each sector can enter, by the rules of sight, walls only.

        A pair that is not visible is certain, whatever shape the sectors have; one that is visible may not be.
        `fast` floods through portals that face each other, `balanced` clips along each chain of portals in float64
        with a bound of the rounding, `exact` does that with 106 bits. A segment that slips past the edge of a sector
        by a gap between surfaces stays, by those rules, in the last sector that it entered, and counts as that
        sector's wherever it goes.

        `open_surfaces` are indices of surfaces whose adjoins may come to be see-through and count so; they lead to
        the sector behind them, if there is one. threads 0 means one a core; the answer is the same for any number.
        Raises ValueError naming a surface that does not exist, and what `progress` raises.
        """
        leads_to = self._leads_to.copy()
        chosen = _integers(open_surfaces).reshape(-1)
        wrong = chosen[(chosen < 0) | (chosen >= len(leads_to))]
        if len(wrong):
            raise ValueError(f"surface {wrong[0]} is out of bounds: there are {len(leads_to)}")
        leads_to[chosen] = self._behind[chosen]
        rows, portals, cut_short = native_visibility(self._viewer, leads_to, accuracy, threads, progress)
        count = len(self._known)
        return VisibleSectors(rows.reshape(count, (count + 7) // 8), portals, cut_short)

    def doubts(self, origins: npt.ArrayLike, sectors: npt.ArrayLike, targets: npt.ArrayLike) -> tuple[int, int]:
        """Count the sectors, and the whole queries, that `balanced` must search completely: for benchmarks."""
        found = self._viewer.doubts(_points(origins), _integers(sectors), _points(targets))
        return found[0], found[1]

    def drop(
        self,
        points: npt.ArrayLike,
        sectors: npt.ArrayLike,
        max_distance: npt.ArrayLike = NO_LIMIT,
        accuracy: Accuracy = "balanced",
        threads: int = 0,
    ) -> Drop:
        """Find the floor below points, (n, 3) JKU, in their sectors, (n,): straight down, by sector.

        The way goes down through adjoins with movement (0x2), however they are seen, and ends at the first surface
        that stops a body, at the water, or `max_distance` JKU (one for all or (n,)) further down. Things are no part
        of it. A floor that the point lies behind, by however little, is not below it; one that it lies on is at
        distance 0. Above an edge or a corner the highest floor counts, and where a floor and a passage meet at one
        height, the floor; native/geometry/landing.hpp has the rule in full.

        `balanced` and `exact` are exact in float64, and their distance is the double nearest to the true one; `fast`
        is not. `threads` and errors as for `sight`, and ValueError naming the row whose distance is negative or not
        a number.
        """
        first, at = _integers(sectors), _points(points)
        limits = np.ascontiguousarray(np.broadcast_to(np.asarray(max_distance, np.float64), first.shape))
        ending, met, sector, distance = self._faller.drop(at, first, limits, accuracy, threads)
        known = self._known[sector]
        if not known.all():
            ending[~known], distance[~known], met[~known] = Ending.UNKNOWN, np.nan, -1
        return Drop(np.where(ending == Ending.FLOOR, met, -1), distance, ending, met, sector)

    def explain(self, sector: int, origin: npt.ArrayLike, target: npt.ArrayLike) -> Explanation:
        """Answer one query, exactly, with each sector on its way. Raises ValueError as `sight` does."""
        visible, sectors, surfaces, leave = self._viewer.explain(_points(origin), sector, _points(target))
        steps = zip(sectors.tolist(), surfaces.tolist(), leave.tolist(), strict=True)
        return Explanation(visible, tuple(Step(*step) for step in steps))


def mesh_arrays(level: Level) -> tuple[Float64, Int32, Int32, Int32, Int32, Int32]:
    """Give the arguments of `from_arrays` for a level, positions flat; unsound surfaces and sectors are empty."""
    return plan_arrays(plan_of(level))


def plan_arrays(plan: Plan) -> tuple[Float64, Int32, Int32, Int32, Int32, Int32]:
    """The same of a plan."""
    sound = plan.sound_sectors
    keep = np.repeat(plan.sound_surfaces, np.diff(plan.corner_start))
    corners = np.where(plan.sound_surfaces, np.diff(plan.corner_start), 0)
    return (
        np.where(np.isfinite(plan.positions), plan.positions, 0).astype(np.float64).ravel(),
        np.concatenate([[0], np.cumsum(corners)]).astype(np.int32),
        np.ascontiguousarray(plan.corner_vertex[keep], np.int32),
        _sector_behind(plan, ADJOIN_VISIBLE),
        np.where(sound, plan.first_surface, 0).astype(np.int32),
        np.where(sound, plan.surface_count, 0).astype(np.int32),
    )


def _sector_behind(plan: Plan, flags: int) -> Int32:
    """The sound sector behind each surface whose adjoin has these flags; else BLOCKS."""
    behind = plan.adjoin_sector
    shows = (behind >= 0) & ((plan.adjoin_flags & flags) == flags)
    shows[shows] &= plan.sound_sectors[behind[shows]]
    return plan.by_adjoin(np.where(shows, behind, BLOCKS).astype(np.int32), BLOCKS)


def _points(points: npt.ArrayLike) -> Float64:
    return np.ascontiguousarray(points, np.float64).reshape(-1)


def _integers(values: npt.ArrayLike) -> Int32:
    return np.ascontiguousarray(values, np.int32)
