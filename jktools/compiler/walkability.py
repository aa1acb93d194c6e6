"""The columns on how bodies walk: ledges and basins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.sections import Columns, NotNeeded, Strings
from jktools.compiler.settings import CompileSettings
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.basins import Basin
from jktools.facts.bodies import Walker
from jktools.facts.ledges import Kind, Ledges

NARROW, AI_STOPS = 0x1, 0x2

STAYS_ON = (Kind.LEVEL, Kind.SEAMLESS, Kind.STEP, Kind.LIP, Kind.JUMP, Kind.WALL)
"""Kinds beyond which a body is still on the thing if it is on that thing's faces; FALL and UNKNOWN are not."""

NO_BODY = "no actor or player template that sticks to floors is reachable"
NO_FLOOR = "the level has no floor"


def ledges(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """Each body's intervals of edges, as far as they are listed (see `_kept`)."""
    why_not = _nothing(facts)
    if why_not:
        return NotNeeded(why_not)
    engine, bodies = Engine(settings.engine), facts.bodies
    kept = [(found, _kept(found)) for found in _known(facts, settings)]
    kept_of = iter(kept)
    lengths = [len(next(kept_of)[1]) if body.hovers else 0 for body in bodies]
    return {
        "body_movesize": np.array([b.body.movesize for b in bodies]),
        "body_hover": _of_known(bodies, [b.hover(engine) for b in bodies]),
        "body_reattach": _of_known(bodies, [b.reattach(engine) for b in bodies]),
        "body_step": _of_known(bodies, [b.clearance(engine) for b in bodies]),
        "body_jump": _of_known(bodies, [b.jump(engine) for b in bodies]),
        "body_physics_flags": np.array([b.body.physflags & 0xFFFFFFFF for b in bodies]),
        "body_player": np.array([b.body.player for b in bodies]),
        "body_name_start": _starts([len(b.names) for b in bodies]),
        "body_name": strings.indices(name for b in bodies for name in b.names),
        "body_ledge_start": _starts(lengths),
        **{name: np.concatenate([np.zeros(0), *columns]) for name, columns in _rows(kept).items()},
    }


def basins(facts: LevelFacts, _: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """Each body's basins."""
    found = list(_basins(facts, settings))
    if not found:
        return NotNeeded(_nothing(facts) or "no body whose hover height is known comes down to where every way goes up")
    return {
        "body": np.array([body for body, _ in found]),
        "surface_start": _starts([len(basin.surfaces) for _, basin in found]),
        "surface": np.array([surface for _, basin in found for surface in basin.surfaces]),
        "shallowest": np.array([basin.shallowest for _, basin in found]),
        "deepest": np.array([basin.deepest for _, basin in found]),
        "entered": np.array([int(basin.entered) for _, basin in found]),
        "left": np.array([int(basin.left) for _, basin in found]),
    }


def _kept(found: Ledges) -> npt.NDArray[np.intp]:
    """The rows that are listed, by their surfaces: those of things, which have none (-1), come first.

    Not listed are level ones, and those of a thing's edges beyond which its own faces go on or stop the body: that
    follows from its model alone, and nobody comes off it there.
    """
    own = (found.carrier_thing >= 0) & (found.onto == found.carrier_thing)
    stays = own & np.isin(found.kind, STAYS_ON) & np.isin(found.other, STAYS_ON)
    rows = np.flatnonzero((found.kind != Kind.LEVEL) & ~stays)
    return rows[np.argsort(found.surface[rows], kind="stable")]


def _nothing(facts: LevelFacts) -> str:
    if not facts.bodies:
        return NO_BODY
    return "" if len(facts.edges.surface) else NO_FLOOR


def _known(facts: LevelFacts, settings: CompileSettings) -> Iterator[Ledges]:
    for body in facts.bodies:
        if body.hovers:
            yield facts.ledges(body, Engine(settings.engine), settings.accuracy)


def _basins(facts: LevelFacts, settings: CompileSettings) -> Iterator[tuple[int, Basin]]:
    for number, body in enumerate(facts.bodies):
        if body.hovers:
            yield from ((number, each) for each in facts.basins(body, Engine(settings.engine), settings.accuracy))


def _of_known(bodies: Sequence[Walker], values: Sequence[float]) -> npt.NDArray[np.float64]:
    return np.where([body.hovers for body in bodies], values, np.nan)


def _rows(kept: Sequence[tuple[Ledges, npt.NDArray[np.intp]]]) -> dict[str, list[npt.NDArray[Any]]]:
    columns: dict[str, list[npt.NDArray[Any]]] = {
        name: []
        for name in (
            "surface", "corner", "start", "end", "kind", "other_kind", "below", "thing", "drop_start", "drop_end",
            "traits", "carrier", "carrier_frame", "carrier_face", "onto", "onto_face",
        )
    }  # fmt: skip
    for found, rows in kept:
        traits = found.narrow * NARROW | found.ai_stops * AI_STOPS
        whole: dict[str, npt.NDArray[Any]] = {
            "surface": found.surface, "corner": found.corner, "start": found.start, "end": found.end,
            "kind": found.kind, "other_kind": found.other, "below": found.below, "thing": found.thing,
            "drop_start": found.drop_start, "drop_end": found.drop_end, "traits": traits,
            "carrier": found.carrier_thing, "carrier_frame": found.carrier_frame, "carrier_face": found.carrier_face,
            "onto": found.onto, "onto_face": found.onto_face,
        }  # fmt: skip
        for name, values in whole.items():
            columns[name].append(values[rows])
    return columns


def _starts(lengths: Sequence[int]) -> npt.NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(np.array(lengths, np.int64))])
