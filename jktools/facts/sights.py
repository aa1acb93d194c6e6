"""Sight over a level for the Python API: one query explained, or the verdicts of many, found with less work."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from jktools.engine.profile import Engine
from jktools.facts.level import LevelFacts
from jktools.facts.scene import Scene, Verdict, scene
from jktools.facts.sightline import Endpoint, EndpointError, ends
from jktools.model import Level

SLACK = 1e-9
"""Of a length: far more than a rounded place on a segment can be off."""
ROWS = 256
"""Queries held against all things at a time."""


End = int | str | Sequence[float]
"""An end of a query: a thing's number, x y z in JKU, or either as text."""


def sight(level: Level, a: End, b: End, *, engine: Engine | str = Engine.RESEARCH, things: bool = True) -> Scene:
    """Explain whether `b` is seen from `a`, among walls alone or things too: `scene` for the Python API.

    What is computed about the level is kept with it. Raises EndpointError, a ValueError, for an end that names no
    thing or no point in a sector, and ValueError for an `engine` that does not exist.
    """
    return scene(LevelFacts.of(level), text_of(a), text_of(b), Engine(engine), things=things)


def text_of(end: End) -> str:
    """Spell an end as `scene` reads it."""
    if isinstance(end, (int, str)):
        return str(end)
    return ",".join(repr(float(x)) for x in end)


def sights(
    level: Level, pairs: Iterable[tuple[End, End]], *, engine: Engine | str = Engine.RESEARCH, things: bool = True
) -> list[Verdict]:
    """Tell for many pairs of ends whether the second is seen from the first: the verdicts of `sight`, one a pair.

    In `research` all walls are asked at once, and only queries that a thing may stand in, or that hang on what a COG
    may change, are worked out one by one; in `openjkdf2` all are. Raises EndpointError naming the pair.
    """
    facts, profile = LevelFacts.of(level), Engine(engine)
    asked = [(text_of(a), text_of(b)) for a, b in pairs]
    found: list[Verdict | None] = [None] * len(asked)
    if profile is Engine.RESEARCH and asked:
        found = _plain(facts, [_ends(facts, i, *pair) for i, pair in enumerate(asked)], things=things)
    for i, (verdict, (a, b)) in enumerate(zip(found, asked, strict=True)):
        if verdict is None:
            try:
                found[i] = scene(facts, a, b, profile, things=things).verdict
            except EndpointError as error:
                raise EndpointError(f"pair {i}: {error}") from error
    return [verdict for verdict in found if verdict is not None]


def _ends(facts: LevelFacts, row: int, a: str, b: str) -> tuple[Endpoint, Endpoint]:
    try:
        return ends(facts.level, facts.mesh, a, b)
    except EndpointError as error:
        raise EndpointError(f"pair {row}: {error}") from error


def _plain(facts: LevelFacts, pairs: list[tuple[Endpoint, Endpoint]], *, things: bool) -> list[Verdict | None]:
    """The verdicts of `research` that walls alone decide; None where a thing or a COG may have a say."""
    origins = np.array([a.point for a, _ in pairs], np.float64)
    targets = np.array([b.point for _, b in pairs], np.float64)
    seen = facts.mesh.sight(origins, np.array([a.sector for a, _ in pairs], np.int32), targets)
    named = np.zeros(len(facts.level.surfaces) + 1, np.bool_)
    named[list(facts.changeable_surfaces)] = True
    open_question = np.where(seen.visible, named.any() & (seen.crossed > 1), named[seen.blocker])
    if things:
        for first in range(0, len(pairs), ROWS):
            rows = slice(first, first + ROWS)
            open_question[rows] |= _meets(facts, pairs[rows], origins[rows], targets[rows], seen.visible[rows])
    return [
        None if asked else Verdict.VISIBLE if visible else Verdict.NOT_VISIBLE
        for asked, visible in zip(open_question.tolist(), seen.visible.tolist(), strict=True)
    ]


def _meets(
    facts: LevelFacts,
    pairs: list[tuple[Endpoint, Endpoint]],
    origins: npt.NDArray[np.float64],
    targets: npt.NDArray[np.float64],
    visible: npt.NDArray[np.bool_],
) -> npt.NDArray[np.bool_]:
    """Whether a thing may have a say: one in the way of what is visible, or the target's body before a wall."""
    near = facts.occluders.near(origins, targets)
    for row, ends_of_row in enumerate(pairs):
        for end in ends_of_row:
            if end.thing is not None and end.thing.index in facts.occluders.place:
                near[row, facts.occluders.place[end.thing.index]] = False
    reached = np.zeros(len(pairs), np.bool_)
    for row in np.flatnonzero(~visible).tolist():
        reached[row] = _may_reach(facts, *pairs[row])
    return np.asarray(np.where(visible, near.any(axis=1), reached))


def _may_reach(facts: LevelFacts, a: Endpoint, b: Endpoint) -> bool:
    """Whether the way to a target that is not visible may come to its body before the wall."""
    size = 0.0 if b.thing is None else b.thing.resolved.number("size")
    if not size > 0:
        return False
    leave = facts.mesh.explain(a.sector, a.point, b.point).steps[-1].leave
    length = math.dist(a.point, b.point)
    return not length * (1 - leave) > size + SLACK * (1 + length + size)
