"""One sight query over a level, told in the level's own words: walls only."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from jktools.geometry.mesh import Explanation, SectorMesh
from jktools.model import Level, Thing


class EndpointError(ValueError):
    """An end that names no thing, or no point in a sector."""


class NoThingError(EndpointError):
    """An end that names no thing of the level, though it is a number."""


class Endpoint(NamedTuple):
    """One end of a sightline."""

    title: str
    point: tuple[float, float, float]
    """JKU."""
    sector: int
    """-1 for a point outside every sector."""
    thing: Thing | None = None


class Sightline(NamedTuple):
    """Two ends, and what lies between them."""

    origin: Endpoint
    target: Endpoint
    explanation: Explanation


def endpoint(level: Level, mesh: SectorMesh, text: str) -> Endpoint:
    """Read an end: a thing's number as COGs use it, or `x,y,z` in JKU.

    A thing is in the sector that it names, a point in the first that holds it. Raises EndpointError.
    """
    if "," in text:
        return _point(mesh, text)
    table = level.document.things
    places = np.flatnonzero(table.number == (int(text) if text.isdecimal() else -1))
    if not len(places):
        if re.fullmatch(r"-?[0-9]+", text):
            raise NoThingError(f"the level has no thing with number {text}")
        raise EndpointError(f"{text} is neither the number of a thing nor x,y,z")
    thing = level.things[int(places[0])]
    if thing.dropped is not None or not np.isfinite(thing.position).all():
        raise NoThingError(f"{thing.title} is not in the level: {thing.dropped or 'it has no position'}")
    x, y, z = (float(value) for value in thing.position)
    return Endpoint(thing.title, (x, y, z), thing.sector_index, thing)


def _point(mesh: SectorMesh, text: str) -> Endpoint:
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise EndpointError(f"{text} is not a point x,y,z: expected three numbers") from None
    if not np.isfinite((x, y, z)).all():
        raise EndpointError(f"{text} is not a point x,y,z: a number is not finite")
    sector = int(mesh.locate([[x, y, z]])[0])
    return Endpoint(f"({x:g}, {y:g}, {z:g})", (x, y, z), sector)


def sightline(level: Level, mesh: SectorMesh, a: str, b: str) -> Sightline:
    """Explain whether `b` is seen from `a`. Raises EndpointError, also when `a` is in no sound sector."""
    origin, target = ends(level, mesh, a, b)
    return Sightline(origin, target, mesh.explain(origin.sector, origin.point, target.point))


def ends(level: Level, mesh: SectorMesh, a: str, b: str) -> tuple[Endpoint, Endpoint]:
    """Read both ends of a query. Raises EndpointError, also when `a` is in no sound sector."""
    origin, target = endpoint(level, mesh, a), endpoint(level, mesh, b)
    if origin.sector < 0:
        raise EndpointError(f"{origin.title} lies in no sector")
    if not level.sound_sectors[origin.sector]:
        raise EndpointError(f"{origin.title} is in sector {origin.sector}, which could not be read")
    return origin, target


def describe(level: Level, line: Sightline) -> Iterator[str]:
    """Tell a sightline, one line a sector."""
    where = f"sector {line.target.sector}" if line.target.sector >= 0 else "no sector"
    yield f"from {line.origin.title} in sector {line.origin.sector} to {line.target.title} in {where}"
    *crossed, last = line.explanation.steps
    for step in crossed:
        adjoin = level.surfaces[step.surface].adjoin_index
        yield f"  sector {step.sector}: through surface {step.surface}, adjoin {adjoin}, at {step.leave:.4%}"
    if line.explanation.visible:
        yield f"  sector {last.sector}: ends here"
        yield "visible"
        return
    yield f"  sector {last.sector}: blocked by {_why(level, last.surface)} at {last.leave:.4%}"
    yield "not visible"


def _why(level: Level, index: int) -> str:
    surface = level.surfaces[index]
    if surface.adjoin is None:
        return f"{surface.title}, which has no adjoin"
    if not surface.adjoin.flags & 0x1:
        return f"{surface.title}, whose adjoin {surface.adjoin_index} is not see-through (flag 0x1)"
    return f"{surface.title}, whose adjoin {surface.adjoin_index} leads into no sector that could be read"
