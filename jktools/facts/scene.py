"""One sight query over a whole level, things included: what HasLOS answers in profile `research`."""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cmp_to_key
from typing import NamedTuple

from jktools.facts.occluders import Along, Meeting, meeting, named_things, sphere_meeting
from jktools.facts.sightline import Sightline, describe, sightline
from jktools.geometry import SectorMesh
from jktools.model import Level


class Verdict(enum.StrEnum):
    """Name what can be said of a query whenever it is asked."""

    VISIBLE = "visible"
    NOT_VISIBLE = "not visible"
    VARIES = "varies"
    """Blocked as the level is placed, but only by things that may be elsewhere, or not solid, at another time."""


class Scene(NamedTuple):
    """A sightline, and the things on its way."""

    line: Sightline
    things: tuple[Meeting, ...]
    """Those met before it ends, nearest first."""
    reached: bool
    """Whether it meets the target's own body: what lies beyond that does not block."""
    unjudged: int
    """Things whose templates are not at hand, so that nothing tells whether they are solid."""
    verdict: Verdict


def scene(level: Level, mesh: SectorMesh, a: str, b: str) -> Scene:
    """Tell whether `b` is seen from `a` among walls and things. Raises EndpointError as `sightline` does.

    Any solid thing blocks at its placed place but the two asked about, and the target is seen once its own sphere is
    reached, even if its centre lies in a wall. Whether a segment meets a wall, a sphere or a face is exact; where a
    wall or a face and the target's sphere lie within rounding of each other, their order is that of the rounded
    figures. What may come into the way later, and walls that COGs open or close, are not foreseen.
    """
    line = sightline(level, mesh, a, b)
    start, end = line.origin.point, line.target.point
    named = named_things(level)
    own = None if line.target.thing is None else sphere_meeting(line.target.thing, start, end)
    wall = None if line.explanation.visible else _at(line, line.explanation.steps[-1].leave)
    limit = min((place for place in (own, wall) if place is not None), key=_ORDER, default=None)
    met, unjudged = [], 0
    for thing in level.things:
        if thing in (line.origin.thing, line.target.thing):
            continue
        unjudged += thing.dropped is None and "collide" not in thing.resolved.values and thing.resolved.leaves_level
        found = meeting(level, thing, start, end, named)
        if found is not None and (limit is None or found.at.before(limit)):
            met.append(found)
    met.sort(key=lambda found: _ORDER(found.at))
    reached = own is not None and (wall is None or not wall.before(own))
    return Scene(line, tuple(met), reached, unjudged, _verdict(wall is not None and not reached, met))


End = int | str | Sequence[float]
"""An end of a query: a thing's number, x y z in JKU, or either as text."""


def sight(level: Level, a: End, b: End, *, things: bool = True) -> Scene:
    """Explain whether `b` is seen from `a`, among walls alone or things too: `scene` for the Python API.

    Raises EndpointError, a ValueError, for an end that names no thing or no point in a sector.
    """
    mesh = SectorMesh.from_level(level)
    if things:
        return scene(level, mesh, _text(a), _text(b))
    line = sightline(level, mesh, _text(a), _text(b))
    return Scene(line, (), False, 0, _verdict(not line.explanation.visible, []))


def _text(end: End) -> str:
    if isinstance(end, (int, str)):
        return str(end)
    return ",".join(repr(float(x)) for x in end)


def tell(level: Level, found: Scene) -> Iterator[str]:
    """Tell a scene, one line a sector and a thing; the verdict stands last."""
    *way, walls = describe(level, found.line)
    yield from way
    if walls == Verdict.NOT_VISIBLE and found.reached:
        yield f"  reaches the body of {found.line.target.title} before that"
    for one in found.things:
        how = f"the sphere of {one.thing.title}" if one.by_sphere else f"a face of {one.thing.title}"
        yield f"  meets {how} at {float(one.at):.4%}" + (f"; {one.changes}" if one.changes else "")
    if found.unjudged and found.verdict is not Verdict.NOT_VISIBLE:
        yield f"  {found.unjudged} things are not judged: their templates are not at hand"
    yield str(found.verdict)


def _verdict(walled: bool, met: list[Meeting]) -> Verdict:
    if walled or any(one.changes is None for one in met):
        return Verdict.NOT_VISIBLE
    return Verdict.VARIES if met else Verdict.VISIBLE


def _at(line: Sightline, part: float) -> Along:
    ends = zip(line.origin.point, line.target.point, strict=True)
    length = sum(((Fraction(q) - Fraction(p)) ** 2 for p, q in ends), Fraction(0))
    return Along(-Fraction(part) * length, Fraction(0), length)


def _compare(one: Along, other: Along) -> int:
    return -1 if one.before(other) else int(other.before(one))


_ORDER = cmp_to_key(_compare)
