"""Basins: floors that a body can come down to and whose every way out goes up.

The research document calls them pits; in the game's own words a pit is a sector that kills (0x40).
"""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.engine.flags import SectorFlag, SurfaceFlag
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.floors import PLACED
from jktools.facts.ledges import Kind, Ledges, Limits
from jktools.facts.openings import MOVEMENT
from jktools.geometry.components import components
from jktools.geometry.mesh import SectorMesh
from jktools.model import Level

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]
Int32 = npt.NDArray[np.int32]
UInt8 = npt.NDArray[np.uint8]

PIT = 0x40
"""Sector flag: whoever falls in dies."""
_FALLS = (Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.FALL)
_LIFTS = SectorFlag.THRUST | SectorFlag.NO_GRAVITY
"""Sector flags under which a body may come up without a floor."""


class Way(enum.IntFlag):
    """How a basin is left."""

    WALK = 0x1
    """Up a lip: by walking into it fast enough."""
    JUMP = 0x2
    MOVER = 0x4
    """A thing that bodies can stand on comes there."""
    WATER = 0x8
    DEADLY = 0x10
    UNKNOWN = 0x20
    """A sector that lifts, a script that may do anything there, a slope that is no floor, or a lip that is climbed at
    times."""


class Entry(enum.IntFlag):
    """How a basin is come into."""

    WALK = 0x1
    """Down a step that cannot be walked up."""
    FALL = 0x2
    JUMP = 0x4
    """Over a wall."""
    START = 0x8
    """A player starts in it."""


@dataclass(frozen=True, slots=True)
class Basin:
    """One basin of one body."""

    surfaces: tuple[int, ...]
    """The floors, ascending."""
    shallowest: float
    deepest: float
    """Least and greatest height of the rim over the floors, JKU: of all edges that lead in."""
    entered: Entry
    left: Way
    rows: tuple[int, ...]
    """The ledges that lead in, rows of `Ledges`."""
    share: float
    """Of the area of all floors of the level, seen from above."""

    @property
    def is_inescapable(self) -> bool:
        """Whether a body that comes in is stuck, and does not start there."""
        return not self.left and not self.entered & Entry.START


class Touched(NamedTuple):
    """What a script may change: (sectors,) and (surfaces,)."""

    sectors: Bool
    surfaces: Bool


class _Ways(NamedTuple):
    """Ways from floor to floor, (n,) each: surfaces by their index, then the faces of things as they are placed."""

    row: npt.NDArray[np.intp]
    """Of `Ledges`; twice where the way leads back."""
    here: Int32
    there: Int32
    """-1 for a way to nothing that carries."""
    kind: UInt8
    back: Bool
    """Whether it is the way back up to the edge of a thing, which no edge of a floor tells."""
    narrow: Bool
    """Whether it leads down where no body fits in."""


def basins_of(level: Level, mesh: SectorMesh, ledges: Ledges, touched: Touched) -> tuple[Basin, ...]:
    """The basins of one body, by their first floors.

    Floors are surfaces and the faces of things as they are placed; a basin without a surface is left out.
    """
    count, ways = len(level.surfaces), _ways(level, mesh, ledges)
    falls = np.isin(ways.kind, _FALLS) & (ways.there >= 0) & ~ways.narrow
    region = components(count + len(ledges.edges.solids.face_solid), ways.here[falls], ways.there[falls])
    here = region[ways.here]
    lands = (ways.there >= 0) & np.isin(ways.kind, (*_FALLS, Kind.LIP, Kind.JUMP)) & ~ways.narrow
    there = np.where(lands, region[ways.there], -1)
    apart = lands & (there != here)
    leaves_down = np.zeros(len(region), np.bool_)
    leaves_down[here[apart & falls]] = True
    deep = (ledges.deepest[ways.row] > 0) & ~ledges.narrow[ways.row] & ~ways.back
    entering = apart & np.isin(ways.kind, (Kind.SEAMLESS, Kind.FALL, Kind.JUMP)) & deep
    starting, found = set(starts(level)), []
    floor_area = _areas(level, np.flatnonzero(ledges.edges.floors))
    of_things = np.ones(len(region), np.bool_)
    of_things[region[np.flatnonzero(ledges.edges.floors)]] = False
    for number in sorted(set(there[entering & ~leaves_down[there]].tolist())):
        surfaces = np.flatnonzero(ledges.edges.floors & (region[:count] == number))
        if not len(surfaces):
            continue
        into = entering & (there == number)
        inner = [
            top for top in set(here[into & of_things[here]].tolist()) if _only_from(here, there, apart, top, number)
        ]
        rows = ways.row[into & ~np.isin(here, inner)]
        if not len(rows):
            continue  # from things that stand on it
        drops = np.concatenate([ledges.drop_start[rows], ledges.drop_end[rows]])
        shallowest, deepest = max(0.0, float(drops.min())), float(drops.max())
        entered = _entered(ledges.kind[rows])
        if starting & set(level.surface_sector[surfaces].tolist()):
            entered |= Entry.START
        left = Way.DEADLY if _kills(level, ledges, rows) else Way(0)
        own = (here == number) & ~ways.narrow
        onto = own & apart & of_things[there]
        if onto.any() and not _leads_on(here, there, apart, of_things, number):
            helps = _tops_help(level, ledges, surfaces, rows)
            own = own & ~onto if not helps else own
        left |= _left(level, ways.kind[own], apart[own], surfaces, touched)
        left |= _left_above(level, surfaces, deepest)
        if _comes_to(level, ledges, surfaces):
            left |= Way.MOVER
        open_by = ledges.thing[ways.row[own & (ways.kind == Kind.UNKNOWN)]]
        left |= (Way.MOVER if (open_by >= 0).any() else Way(0)) | (Way.UNKNOWN if (open_by < 0).any() else Way(0))
        share = float(_areas(level, surfaces).sum() / max(floor_area.sum(), np.finfo(np.float64).tiny))
        found.append(Basin(tuple(surfaces.tolist()), shallowest, deepest, entered, left, tuple(rows.tolist()), share))
    return tuple(sorted(found, key=lambda basin: basin.surfaces))


def _areas(level: Level, surfaces: npt.NDArray[np.intp]) -> Float64:
    """Of surfaces seen from above, JKU squared."""
    found = []
    for surface in surfaces.tolist():
        x, y = level.surfaces[surface].positions[:, :2].astype(np.float64).T
        found.append(abs(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2)
    return np.array(found, np.float64)


def _only_from(here: Int32, there: npt.NDArray[Any], apart: Bool, top: int, number: int) -> bool:
    """Whether nobody gets onto a thing but from a basin: then it is no way in."""
    return not (apart & (there == top) & (here != number)).any()


def _leads_on(here: Int32, there: npt.NDArray[Any], apart: Bool, of_things: Bool, number: int) -> bool:
    """Whether a way from things that a body gets onto from a basin leads to other floors of the level."""
    seen, waiting = {number}, [number]
    while waiting:
        at = waiting.pop()
        for after in sorted(set(there[apart & (here == at)].tolist()) - seen):
            if not of_things[after]:
                if at != number:
                    return True
                continue
            seen.add(after)
            waiting.append(after)
    return False


def _tops_help(level: Level, ledges: Ledges, surfaces: npt.NDArray[np.intp], rows: npt.NDArray[np.intp]) -> bool:
    """Whether a jump from the highest thing that a body gets onto in a basin, from one to the next, reaches the rim.

    However far they are from each other and from the rim: a jump over a gap is not followed.
    """
    here, there = ledges.edges.ends(ledges.edge[rows])
    rim = float(np.minimum(here[:, 2], there[:, 2]).min())
    corners = np.concatenate([level.surfaces[surface].positions for surface in surfaces.tolist()])
    low, high = corners.min(axis=0)[:2], corners.max(axis=0)[:2]
    placed = [each for each in ledges.floors.platforms if each.frame == PLACED]
    over = [each for each in placed if (each.low[:2] <= high).all() and (each.high[:2] >= low).all()]
    jump, height = ledges.walker.jump(ledges.engine), float(corners[:, 2].max())
    for top in sorted(float(each.high[2]) for each in over):
        if top <= height + jump:
            height = max(height, top)
    return rim <= height + jump


def _ways(level: Level, mesh: SectorMesh, ledges: Ledges) -> _Ways:
    count = len(level.surfaces)
    rows = np.flatnonzero(ledges.carrier_frame == PLACED)
    surface, face = ledges.surface[rows], ledges.edges.face[ledges.edge[rows]]
    here = np.where(surface >= 0, surface, count + face)
    below, onto = ledges.below[rows], ledges.face[rows]
    there = np.where(below >= 0, below, np.where(onto >= 0, count + onto, -1))
    kind = ledges.kind[rows]
    back = np.flatnonzero((face >= 0) & (there >= 0) & np.isin(kind, (Kind.SEAMLESS, Kind.FALL)))
    gaps, across, rises = _across(mesh, ledges, np.flatnonzero(ledges.narrow[rows]), rows)
    limits = Limits.of(ledges.walker, ledges.engine, lips=bool(len(back) + len(gaps)))
    rises = np.concatenate([ledges.least[rows[back]], rises])
    up = np.select(
        [rises <= 0, rises <= limits.clearance, rises <= limits.lip, rises <= limits.jump, rises <= limits.hover],
        [Kind.LEVEL, Kind.STEP, Kind.LIP, Kind.JUMP, Kind.UNKNOWN], Kind.WALL,
    )  # fmt: skip
    more = np.concatenate([rows[back], rows[gaps]])
    return _Ways(
        np.concatenate([rows, more]),
        np.concatenate([here, there[back], here[gaps]]).astype(np.int32),
        np.concatenate([there, here[back], across]).astype(np.int32),
        np.concatenate([kind, up.astype(np.uint8)]),
        np.arange(len(rows) + len(more)) >= len(rows),
        np.concatenate([ledges.narrow[rows], np.zeros(len(more), np.bool_)]),
    )


def _across(
    mesh: SectorMesh, ledges: Ledges, narrow: npt.NDArray[np.intp], rows: npt.NDArray[np.intp]
) -> tuple[npt.NDArray[np.intp], Int32, Float64]:
    """What lies across gaps that no body fits in, one and two radii past the middle of each: floors of the level.

    Which of the narrow rows, the surface, and how much higher it is, JKU.
    """
    start, end = ledges.edges.ends(ledges.edge[rows[narrow]])
    along = end - start
    outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
    outward /= np.maximum(np.linalg.norm(outward, axis=1), np.finfo(np.float64).tiny)[:, None]
    middle = start + along * ((ledges.start + ledges.end)[rows[narrow]] / 2)[:, None]
    hover = ledges.walker.hover(ledges.engine)
    found: list[tuple[npt.NDArray[np.intp], Int32, Float64]] = []
    for radii in (1, 2):
        points = middle + np.array([0.0, 0.0, hover])
        points[:, :2] += outward * radii * ledges.walker.body.movesize
        sectors = mesh.locate(points)
        inside = np.flatnonzero(sectors >= 0)
        fall = mesh.drop(points[inside], sectors[inside], hover + ledges.walker.reattach(ledges.engine))
        lands = np.flatnonzero(fall.surface >= 0)
        found.append((narrow[inside[lands]], fall.surface[lands], hover - fall.distance[lands]))
    gaps, across, rises = (np.concatenate(column) for column in zip(*found, strict=True))
    return gaps, across, rises


def starts(level: Level) -> list[int]:
    """The sectors in which players are placed."""
    return [t.sector_index for t in level.things if t.dropped is None and t.resolved.type == "player"]


def _kills(level: Level, ledges: Ledges, rows: npt.NDArray[np.intp]) -> bool:
    """Whether every way in ends in a fall that kills a body of full health."""
    deadly = ledges.walker.deadly_drop()
    soft = (np.append(level.document.surfaces.flags, 0)[ledges.below[rows]] & SurfaceFlag.NO_FALL_DAMAGE) != 0
    return bool((~soft & (ledges.least[rows] >= deadly)).all())


def _entered(kinds: npt.NDArray[np.uint8]) -> Entry:
    entry = Entry(0)
    for kind, way in ((Kind.SEAMLESS, Entry.WALK), (Kind.FALL, Entry.FALL), (Kind.JUMP, Entry.JUMP)):
        if (kinds == kind).any():
            entry |= way
    return entry


def _left(level: Level, kinds: UInt8, leads: Bool, surfaces: npt.NDArray[np.intp], touched: Touched) -> Way:
    left = Way(0)
    for kind, way in ((Kind.LIP, Way.WALK), (Kind.JUMP, Way.JUMP)):
        if (leads & (kinds == kind)).any():
            left |= way
    for kind, way in ((Kind.WATER, Way.WATER), (Kind.NONE, Way.UNKNOWN)):
        if (kinds == kind).any():
            left |= way
    sectors = np.unique(level.surface_sector[surfaces])
    flags = level.document.sectors.flags[sectors]
    if (flags & PIT).any():
        left |= Way.DEADLY
    if (flags & SectorFlag.UNDERWATER).any():
        left |= Way.WATER
    if (flags & _LIFTS).any() or touched.sectors[sectors].any() or touched.surfaces[surfaces].any():
        left |= Way.UNKNOWN
    return left


def _left_above(level: Level, surfaces: npt.NDArray[np.intp], deepest: float) -> Way:
    """What the sectors do that lie over the floors and below the rim, through adjoins that let bodies pass."""
    corners = np.concatenate([level.surfaces[surface].positions for surface in surfaces.tolist()])
    low, high = corners.min(axis=0), corners.max(axis=0) + np.array([0.0, 0.0, deepest])
    document, left = level.document, Way(0)
    seen = set(level.surface_sector[surfaces].tolist())
    waiting = list(seen)
    while waiting:
        sector = waiting.pop()
        flags = document.sectors.flags[sector]
        left |= (Way.DEADLY if flags & PIT else Way(0)) | (Way.UNKNOWN if flags & _LIFTS else Way(0))
        for surface in np.flatnonzero(level.surface_sector == sector).tolist():
            adjoin = int(document.surfaces.adjoin[surface])
            if not 0 <= adjoin < len(document.adjoins) or not document.adjoins.flags[adjoin] & MOVEMENT:
                continue
            after, opening = int(level.adjoin_sector[adjoin]), level.surfaces[surface].positions
            least, most = opening.min(axis=0), opening.max(axis=0)
            over = bool((least < high).all() and (most > low).all())
            if over and after >= 0 and after not in seen:
                seen.add(after)
                waiting.append(after)
    return left


def _comes_to(level: Level, ledges: Ledges, surfaces: npt.NDArray[np.intp]) -> bool:
    """Whether a thing that bodies can stand on comes over one of the floors, at any of its places.

    One that moves, or whose model is not at hand, no higher than the body jumps: where it stays still it is a way.
    """
    floors = ledges.floors
    low, high = floors.boxes()
    moves = [platform.thing.index in floors.moves for platform in floors.platforms]
    reach = np.where([*moves, *(True for _ in floors.balls)], ledges.walker.jump(ledges.engine), 0.0)
    for surface in surfaces.tolist():
        corners = level.surfaces[surface].positions
        top = np.repeat(corners.max(axis=0)[None], len(low), axis=0)
        top[:, 2] += reach
        if ((high >= corners.min(axis=0)) & (low <= top)).all(axis=1).any():
            return True
    return False


def touched_by_scripts(level: Level, instances: Sequence[InstanceFacts]) -> Touched:
    """What placed scripts name: any sector, surface or thing's sector, and the surfaces around.

    Of a script that is not at hand every number counts as each of the three.
    """
    sectors, surfaces = np.zeros(len(level.sectors), np.bool_), np.zeros(len(level.surfaces), np.bool_)
    number_of = {thing.number: thing.sector_index for thing in level.things if thing.dropped is None}
    for each in instances:
        if each.script is None:
            values = [(kind, text) for text in each.cog.values for kind in ("sector", "surface", "thing")]
        else:
            values = [(str(value.slot.type), value.text) for value in each.values]
        for kind, text in values:
            if not text.lstrip("-").isdecimal():
                continue
            number = int(text)
            if kind == "sector" and 0 <= number < len(sectors):
                sectors[number] = True
            elif kind == "surface" and 0 <= number < len(surfaces):
                surfaces[number] = True
                owner = int(level.surface_sector[number])
                sectors[owner] |= owner >= 0
            elif kind == "thing" and 0 <= number_of.get(number, -1) < len(sectors):
                sectors[number_of[number]] = True
    return Touched(sectors, surfaces)
