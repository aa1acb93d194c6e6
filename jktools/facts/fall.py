"""One fall straight down, told in the level's own words: sectors only, no things."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.facts.sightline import Endpoint, EndpointError, endpoint
from jktools.geometry import Drop, Ending, SectorMesh
from jktools.model import Level


def fall(level: Level, mesh: SectorMesh, text: str) -> tuple[Endpoint, Drop]:
    """Find what is straight below a thing by number, or below `x,y,z`. Raises EndpointError, also outside sectors."""
    top = endpoint(level, mesh, text)
    if top.sector < 0:
        raise EndpointError(f"{top.title} lies in no sector")
    return top, mesh.drop([top.point], [top.sector])


def tell_fall(level: Level, top: Endpoint, found: Drop) -> Iterator[str]:
    """Tell a fall: where it starts, and what ends it."""
    distance, met, sector = float(found.distance[0]), int(found.met[0]), int(found.sector[0])
    at = f"{distance:.6g} JKU below, in sector {sector}"
    yield f"from {top.title} in sector {top.sector}"
    match Ending(found.ending[0]):
        case Ending.FLOOR:
            yield f"floor: {level.surfaces[met].title}, {at}"
        case Ending.SOLID:
            yield f"no floor: {level.surfaces[met].title} is solid, but has no floor flag (0x1), {at}"
        case Ending.WATER if met < 0:
            yield f"no floor: sector {sector} is under water"
        case Ending.WATER:
            yield f"no floor: water behind {level.surfaces[met].title}, {at}"
        case Ending.UNKNOWN:
            yield f"unknown: sector {sector} could not be read"
        case _:
            yield f"no floor: nothing below in sector {sector}"
