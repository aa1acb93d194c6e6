"""One sight query over a whole level, things included: what HasLOS answers, by profile."""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cmp_to_key
from typing import TYPE_CHECKING, NamedTuple

from jktools.engine import sight as rules
from jktools.engine.profile import Engine
from jktools.facts.occluders import Along, Meeting, Point, place_on, sphere_meeting
from jktools.facts.sightline import (
    Endpoint,
    NoThingError,
    Sightline,
    describe,
    endpoint,
    ends,
    sightline,
)
from jktools.geometry.engine_sight import Cut, Way, engine_way
from jktools.geometry.mesh import Explanation
from jktools.model import Level, Thing

if TYPE_CHECKING:
    from jktools.facts.level import LevelFacts


class Verdict(enum.StrEnum):
    """Name what can be said of a query whenever it is asked."""

    VISIBLE = "visible"
    NOT_VISIBLE = "not visible"
    VARIES = "varies"
    """As the level is placed it is one of the two, but by what may be elsewhere, or otherwise, at another time."""
    NULL_THING = "null thing"
    """`openjkdf2`: an end is no thing, and HasLOS answers -1, which scripts take for true."""


class Scene(NamedTuple):
    """A sightline, and the things on its way."""

    line: Sightline
    """With NULL_THING both ends in no sector, and no steps."""
    things: tuple[Meeting, ...]
    """Those met before it ends, nearest first."""
    reached: bool
    """Whether it meets the target's own body: what lies beyond that does not block."""
    unjudged: int
    """Things whose templates are not at hand, so that nothing tells whether they are solid."""
    verdict: Verdict
    openable: tuple[int, ...] = ()
    """Surfaces that decide how far it goes, and that a COG may make see-through or solid."""
    touching: tuple[int, ...] = ()
    """Blocking surfaces within 1e-5 JKU of the target."""
    cut: Cut | None = None
    """`openjkdf2`: why the search ends early, in the last sector, and calls the rest clear."""

    @property
    def is_visible(self) -> bool:
        """Whether it is seen whatever may be elsewhere or changed of what stands there."""
        return self.verdict is Verdict.VISIBLE and not self.unjudged and not self.touching

    @property
    def is_hidden(self) -> bool:
        """Whether it is not seen, whatever may be elsewhere or changed of what stands there."""
        return self.verdict is Verdict.NOT_VISIBLE and not self.touching

    @property
    def blockers(self) -> Sequence[Thing]:
        """The things that hide it, and that nothing is known to move; none where a wall does."""
        walled = not self.line.explanation.visible and not self.reached
        return () if walled else [one.thing for one in self.things if one.changes is None]


def scene(facts: LevelFacts, a: str, b: str, engine: Engine = Engine.RESEARCH, *, things: bool = True) -> Scene:
    """Tell whether `b` is seen from `a` among walls and things. Raises EndpointError as `sightline` does.

    Any solid thing that the profile counts blocks at its placed place but the two asked about, and the target is seen
    once its own sphere is reached, even if its centre lies in a wall. Whether a segment meets a wall, a sphere or a
    face is exact; in `research`, where a wall or a face and the target's sphere lie within rounding of each other,
    their order is that of the rounded figures. A verdict varies where it hangs on things that may be elsewhere, or on
    surfaces that COGs may open or close (`LevelFacts.changeable_surfaces`). What may come into the way later is not
    foreseen. In `openjkdf2` an end that is a number and no thing of the level is the null thing.
    """
    if engine is Engine.RESEARCH:
        line = sightline(facts.level, facts.mesh, a, b)
        steps = line.explanation.steps
        wall = None if line.explanation.visible else place_on(*_points(line), Fraction(steps[-1].leave))
        way = None
    else:
        try:
            origin, target = ends(facts.level, facts.mesh, a, b)
        except NoThingError:
            return _null(facts, a, b)
        way = engine_way(facts.sight_faces(engine), origin.sector, origin.point, target.point)
        line = Sightline(origin, target, way.explanation)
        wall = None if way.explanation.visible else place_on(origin.point, target.point, way.at)
    return _judged(facts, line, wall, way, engine, things=things)


def _judged(
    facts: LevelFacts, line: Sightline, wall: Along | None, way: Way | None, engine: Engine, *, things: bool
) -> Scene:
    start, end = _points(line)
    own = None if line.target.thing is None or not things else sphere_meeting(line.target.thing, start, end)
    reached = own is not None and (wall is None or not wall.before(own))
    limit = own if reached else wall
    met = _met(facts, line, limit, way, engine) if things else []
    openable = _openable(facts, line, own if reached else None, way)
    unjudged = len([one for one in facts.occluders.unjudged if one not in _end_things(line)]) if things else 0
    sectors = {line.explanation.steps[-1].sector, *([line.target.sector] if line.target.sector >= 0 else [])}
    touching = tuple(facts.sight_faces(engine).touched(sorted(sectors), end))
    verdict = _verdict(walled=wall is not None and not reached, met=met, openable=openable)
    return Scene(line, tuple(met), reached, unjudged, verdict, openable, touching, way.cut if way else None)


def _met(facts: LevelFacts, line: Sightline, limit: Along | None, way: Way | None, engine: Engine) -> list[Meeting]:
    """The things on the way before its end, nearest first; in `openjkdf2` only those in sectors that it comes to."""
    met = [
        found
        for found in facts.occluders.meetings(*_points(line), engine)
        if found.thing not in _end_things(line)
        and (limit is None or found.at.before(limit))
        and (way is None or found.thing.sector_index in way.entered)
    ]
    return sorted(met, key=lambda found: _ORDER(found.at))


def _openable(facts: LevelFacts, line: Sightline, body: Along | None, way: Way | None) -> tuple[int, ...]:
    """The surfaces that a COG may make see-through or solid, as far as that decides anything.

    Where a wall ends the way that is the wall alone: what shuts before it changes nothing. `body` is where the way
    meets the target's own.
    """
    named, level = facts.changeable_surfaces, facts.level
    steps = line.explanation.steps
    if line.explanation.visible or body is not None:
        last = 1.0 if body is None else float(body)
        deciding = [step.surface for step in steps if step.surface >= 0 and step.leave <= last]
    else:
        deciding = [steps[-1].surface]
    if way is None:  # without an adjoin a surface blocks for ever
        return tuple(s for s in deciding if s in named and level.surfaces[s].adjoin is not None)
    if line.explanation.visible and way.cut is None:
        deciding += facts.sight_faces(Engine.OPENJKDF2).holes(steps[-1].sector, *_points(line))
    return tuple(s for s in deciding if s in named)


def _verdict(*, walled: bool, met: list[Meeting], openable: tuple[int, ...]) -> Verdict:
    if any(one.changes is None for one in met):
        return Verdict.NOT_VISIBLE
    return Verdict.VARIES if openable or (met and not walled) else Verdict.NOT_VISIBLE if walled else Verdict.VISIBLE


def _null(facts: LevelFacts, a: str, b: str) -> Scene:
    nan = float("nan")
    found = []
    for text in (a, b):
        try:
            found.append(endpoint(facts.level, facts.mesh, text))
        except NoThingError as error:
            found.append(Endpoint(str(error), (nan, nan, nan), -1))
    line = Sightline(found[0], found[1], Explanation(True, ()))
    return Scene(line, (), False, 0, Verdict.NULL_THING)


def tell(level: Level, found: Scene) -> Iterator[str]:
    """Tell a scene, one line a sector and a thing; the verdict stands last."""
    if found.verdict is Verdict.NULL_THING:
        for end in (found.line.origin, found.line.target):
            if end.sector < 0 and end.thing is None:
                yield end.title
        yield f"{found.verdict}: HasLOS answers {rules.NO_THING}, which scripts take for true"
        return
    *way, walls = describe(level, found.line)
    yield from way
    if found.cut is not None:
        yield f"  sector {found.line.explanation.steps[-1].sector}: {found.cut.value}; the rest counts as clear"
    if walls == Verdict.NOT_VISIBLE and found.reached:
        yield f"  reaches the body of {found.line.target.title} before that"
    for one in found.things:
        how = f"the sphere of {one.thing.title}" if one.by_sphere else f"a face of {one.thing.title}"
        yield f"  meets {how} at {float(one.at):.4%}" + (f"; {one.changes}" if one.changes else "")
    for surface in found.openable:
        yield f"  a placed COG may change {level.surfaces[surface].title}"
    for surface in found.touching:
        yield f"  {found.line.target.title} touches {level.surfaces[surface].title}, within {rules.TOUCHING:g} JKU"
    if found.unjudged and found.verdict is not Verdict.NOT_VISIBLE:
        yield f"  {found.unjudged} things are not judged: their templates are not at hand"
    yield str(found.verdict)


def _points(line: Sightline) -> tuple[Point, Point]:
    return line.origin.point, line.target.point


def _end_things(line: Sightline) -> tuple[object, object]:
    return line.origin.thing, line.target.thing


def _compare(one: Along, other: Along) -> int:
    return -1 if one.before(other) else int(other.before(one))


_ORDER = cmp_to_key(_compare)
