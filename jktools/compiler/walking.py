"""What a compiled level says of where bodies walk and fall: the ledges beyond an edge, and basins."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.compiler.leaving import GREATEST, Point, leaving
from jktools.compiler.queries import Columns, plan_of
from jktools.geometry.drop import CARRIES, ground

LEVEL, UNKNOWN = 0, 9
"""Kinds of a ledge, as `jktools.facts.ledges.Kind` numbers them."""
_DETACHES = (2, 3, 4)
PLACED = -1
"""In place of a frame: where the level places a thing. A frame at which it is as it is placed counts as that."""


class Ledge(NamedTuple):
    """A part of a floor's edge, and what a body comes onto beyond it; grammars/level.fbs tells more of each."""

    start: float
    end: float
    """0 .. 1 along the edge."""
    kind: int
    """A `jktools.facts.ledges.Kind`, by the engine profile of the file."""
    other_kind: int
    """By the other profile."""
    below: int
    """The surface come onto, or that blocks; -1 for none."""
    thing: int
    """Source index of the thing that makes it unknown, or -1."""
    drop_start: float
    drop_end: float
    """From the edge down at both ends, JKU; NaN for none."""
    traits: int
    """0x1 the place below is narrower than the body, 0x2 the engine's AI stops."""
    onto: int = -1
    """Source index of the thing come onto, or that blocks; -1 for none, and in files up to format 1.1."""
    onto_face: int = -1
    """The face of its model at rest, or -1."""

    def holds(self, place: float) -> bool:
        """Whether a place along the edge, 0 .. 1, lies in it."""
        return self.start <= place <= self.end

    def drop(self, place: float) -> float:
        """From the edge down at a place that it holds, JKU: the double nearest to it. NaN for none."""
        known = all(map(math.isfinite, (self.drop_start, self.drop_end, self.start, self.end)))
        if not known or not self.holds(place):
            return math.nan
        if self.start == self.end:
            return self.drop_start
        start, end, at = Fraction(self.start), Fraction(self.end), Fraction(place)
        over = Fraction(self.drop_start) * (end - at) + Fraction(self.drop_end) * (at - start)
        return float(over / (end - start))


class ThingFace(NamedTuple):
    """A face of a thing that a body stands on."""

    thing: int
    """Source index."""
    frame: int
    """PLACED, or the number of its frame."""
    face: int
    """Of its model at rest."""
    corners: Sequence[Point]
    """Where the thing is, JKU, in the order of the model. The file does not hold models."""


class Leave(NamedTuple):
    """What comes of a body's way over a floor."""

    corner: int
    """Of the edge by which it leaves, from this corner of the floor to the next; -1 where it stays."""
    along: float
    """How far along the way that is, 0 .. 1: the nearest double."""
    place: float
    """How far along the edge."""
    drop: float
    """JKU down from the edge there, the nearest double: negative for up, NaN for none and unknown."""
    ledge: Ledge
    """What it comes onto; where none is listed, from the ledge before to the one after."""

    @property
    def kind(self) -> int:
        """LEVEL where the body stays or the floor goes on, UNKNOWN where the file does not say.

        Over an edge of a thing LEVEL comes with a drop of NaN, since also the thing's own faces may go on there or stop
        the body, which its model tells.
        """
        return self.ledge.kind

    @property
    def detaches(self) -> bool:
        """Whether a body that walks there lets go of the floor and falls."""
        return self.kind in _DETACHES


class Basin(NamedTuple):
    """Floors that a body can come down to and whose every way out goes up."""

    surfaces: tuple[int, ...]
    shallowest: float
    deepest: float
    """Least and greatest height of the edges that lead in, JKU."""
    entered: int
    """0x1 walk, 0x2 fall, 0x4 jump, 0x8 a player starts there."""
    left: int
    """0x1 walk, 0x2 jump, 0x4 mover, 0x8 water, 0x10 deadly, 0x20 unknown; 0: inescapable where no player starts."""


Edge = tuple[int, ...]
"""Surface and corner, or thing, frame, face and corner."""
_NOWHERE = Ledge(0.0, 1.0, UNKNOWN, UNKNOWN, -1, -1, math.nan, math.nan, 0)
_STAYS = Ledge(0.0, 1.0, LEVEL, LEVEL, -1, -1, 0.0, 0.0, 0)


class Walking:
    """The ledges and basins of a compiled level, found by edge, by floor and by the way over it."""

    def __init__(self, geometry: Columns, ledges: Columns | None, basins: Columns | None) -> None:
        """Take the sections of a file; None for one that it does not have."""
        self._geometry = geometry
        self._ledges = ledges
        self._basins = basins

    @property
    def bodies(self) -> int:
        """How many bodies the file has."""
        return 0 if self._ledges is None else len(self._ledges.body_movesize)

    def body_of(self, template: str, strings: Sequence[str]) -> int:
        """Number of the body of a template, by its name in any case. Raises KeyError for one that has none."""
        for body, (first, end) in enumerate(pairwise(() if self._ledges is None else self._ledges.body_name_start)):
            if template.lower() in (strings[i].lower() for i in self._ledges.body_name[first:end]):  # type: ignore[union-attr]
                return body
        raise KeyError(f"no body is of the template {template!r}")

    def at(self, body: int, edge: Edge, place: float | None = None) -> list[Ledge]:
        """The ledges of an edge along it; with `place` the first that holds it. Raises IndexError for no such body."""
        found = self._rows(body).get(edge, [])
        return found[:] if place is None else [each for each in found if each.holds(place)][:1]

    def knows(self, body: int, floor: int | ThingFace) -> bool:
        """Whether the edges of a floor were looked at for a body.

        A thing that has no ledge at a frame is no floor then, its model was not at hand, it is never there, or it lies
        level among others: the file does not tell these apart.
        """
        if self._ledges is None or np.isnan(self._ledges.body_hover[body]):
            return False
        if isinstance(floor, ThingFace):
            return floor[:2] in self._places[body] and all(map(_taken, floor.corners))
        return 0 <= floor < len(self._floors) and bool(self._floors[floor])

    def leave(self, body: int, floor: int | ThingFace, origin: Point, target: Point) -> Leave:
        """What comes of a body that moves straight over a floor; see `CompiledLevel.leave`."""
        self._check(body)
        unknown = Leave(-1, 1.0, 0.0, math.nan, _NOWHERE)
        if not (_taken(origin) and _taken(target) and self.knows(body, floor)):
            return unknown
        found = leaving(self._corners(floor), origin, target)
        if not found.starts_inside:
            return unknown
        if found.corner < 0:
            return Leave(-1, 1.0, 0.0, 0.0, _STAYS)
        key = (*floor[:3], found.corner) if isinstance(floor, ThingFace) else (floor, found.corner)
        edge = self.at(body, key)
        for each in edge:
            if each.holds(found.place):
                return Leave(found.corner, found.along, found.place, each.drop(found.place), each)
        goes_on = _STAYS if isinstance(floor, int) else _STAYS._replace(drop_start=math.nan, drop_end=math.nan)
        start = max((each.end for each in edge if each.end < found.place), default=0.0)
        end = min((each.start for each in edge if each.start > found.place), default=1.0)
        return Leave(found.corner, found.along, found.place, goes_on.drop_start, goes_on._replace(start=start, end=end))

    def basins_of(self, body: int) -> Iterator[Basin]:
        """The basins of a body."""
        if self._basins is None:
            return
        for row in np.flatnonzero(self._basins.body == body).tolist():
            surfaces = self._basins.surface[self._basins.surface_start[row] : self._basins.surface_start[row + 1]]
            figures = (getattr(self._basins, name)[row].item() for name in Basin._fields[1:])
            yield Basin(tuple(surfaces.tolist()), *figures)

    def _check(self, body: int) -> None:
        if not 0 <= body < self.bodies:
            raise IndexError(f"body {body} does not exist: there are {self.bodies}")

    def _rows(self, body: int) -> Mapping[Edge, list[Ledge]]:
        self._check(body)
        return self._edges[body]

    @cached_property
    def _edges(self) -> list[dict[Edge, list[Ledge]]]:
        """Of each body, the ledges of each edge along it."""
        ledges = self._ledges
        assert ledges is not None
        columns = [getattr(ledges, name).tolist() for name in Ledge._fields if hasattr(ledges, name)]
        rows = [Ledge(*row) for row in zip(*columns, strict=True)]
        places = [name for name in ("carrier", "carrier_frame", "carrier_face") if hasattr(ledges, name)]
        keys = np.stack([getattr(ledges, name) for name in (*places, "surface", "corner")], axis=1).tolist()
        found: list[dict[Edge, list[Ledge]]] = []
        for first, end in pairwise(ledges.body_ledge_start.tolist()):
            found.append({})
            for row in range(first, end):
                *thing, surface, corner = keys[row]
                edge = (surface, corner) if surface >= 0 else (*thing, corner)
                found[-1].setdefault(edge, []).append(rows[row])
        return found

    @cached_property
    def _places(self) -> list[frozenset[tuple[int, int]]]:
        """Of each body, the things that have a ledge, with the frame."""
        return [frozenset((edge[0], edge[1]) for edge in edges if len(edge) > 2) for edges in self._edges]

    @cached_property
    def _floors(self) -> npt.NDArray[np.bool_]:
        """Which surfaces carry bodies, and can be computed with."""
        plan = plan_of(self._geometry)
        return np.asarray((ground(plan).passes_to == CARRIES) & plan.sound_surfaces)

    def _corners(self, floor: int | ThingFace) -> Sequence[Point]:
        if isinstance(floor, ThingFace):
            return floor.corners
        start = self._geometry.surface_corner_start
        rows: Any = self._geometry.vertices[self._geometry.corner_vertex[start[floor] : start[floor + 1]]]
        found: list[list[float]] = rows.astype(np.float64).tolist()
        return found


def _taken(point: Point) -> bool:
    return all(abs(x) < GREATEST for x in point)
