"""Falls straight down through a level, things included, and one of them told in the level's own words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from jktools.facts.floors import Below
from jktools.facts.level import LevelFacts
from jktools.facts.sightline import Endpoint, EndpointError, endpoint
from jktools.geometry import Accuracy, Ending
from jktools.geometry.drop import NO_LIMIT
from jktools.model import Level


def drop(
    level: Level,
    points: npt.ArrayLike,
    sectors: npt.ArrayLike | None = None,
    max_distance: npt.ArrayLike = NO_LIMIT,
    *,
    things: bool = True,
    own: npt.ArrayLike = -1,
    accuracy: Accuracy = "balanced",
    threads: int = 0,
) -> Below:
    """Find the floor below points, (n, 3) JKU, among sectors and things: `Floors.below` for the Python API.

    `sectors`, (n,), are those that hold the points, by default the first that does. What is computed about the level
    is kept with it. Raises ValueError naming the point that lies in no sector, and as `SectorMesh.drop` does.
    """
    facts = LevelFacts.of(level)
    top = np.ascontiguousarray(points, np.float64).reshape(-1, 3)
    inside = facts.mesh.locate(top) if sectors is None else np.ascontiguousarray(sectors, np.int32)
    nowhere = np.flatnonzero(inside < 0)
    if len(nowhere):
        raise ValueError(f"point {nowhere[0]} lies in no sector")
    floors = facts.floors if things else facts.bare_floors
    return floors.below(facts.mesh, top, inside, max_distance, own=own, accuracy=accuracy, threads=threads)


def fall(level: Level, text: str, *, things: bool = True) -> tuple[Endpoint, Below]:
    """Find what is straight below a thing by number, or below `x,y,z`. Raises EndpointError, also outside sectors."""
    top = endpoint(level, LevelFacts.of(level).mesh, text)
    if top.sector < 0:
        raise EndpointError(f"{top.title} lies in no sector")
    own = -1 if top.thing is None else top.thing.index
    return top, drop(level, [top.point], [top.sector], things=things, own=own)


def tell_fall(level: Level, top: Endpoint, found: Below) -> Iterator[str]:
    """Tell a fall: where it starts, what ends it, and what may be there at another time."""
    yield f"from {top.title} in sector {top.sector}"
    if found.other[0] >= 0:
        other, frame = level.things[int(found.other[0])], int(found.frame[0])
        yield f"  at its frame {frame}, {other.title} is a floor {float(found.other_distance[0]):.6g} JKU below"
    yield _end(level, found)


def _end(level: Level, found: Below) -> str:
    distance, met, sector = float(found.distance[0]), int(found.met[0]), int(found.sector[0])
    thing = None if found.thing[0] < 0 else level.things[int(found.thing[0])]
    at = f"{distance:.6g} JKU below, in sector {sector}"
    match Ending(found.ending[0]):
        case Ending.FLOOR if thing is not None:
            return f"floor: face {int(found.face[0])} of {thing.title}, {distance:.6g} JKU below"
        case Ending.FLOOR:
            return f"floor: {level.surfaces[met].title}, {at}"
        case Ending.SOLID:
            return f"no floor: {level.surfaces[met].title} is solid, but has no floor flag (0x1), {at}"
        case Ending.WATER if met < 0:
            return f"no floor: sector {sector} is under water"
        case Ending.WATER:
            return f"no floor: water behind {level.surfaces[met].title}, {at}"
        case Ending.UNKNOWN if thing is not None:
            return f"unknown: {thing.title} may be a floor here, but its model is not at hand"
        case Ending.UNKNOWN:
            return f"unknown: sector {sector} could not be read"
        case _:
            return f"no floor: nothing below in sector {sector}"
