"""The part of a template that decides how its body moves."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Body:
    """A moving body: JKU and seconds; a parameter that no template sets is 0, as in the engine."""

    maxthrust: float = 0.0
    surfdrag: float = 0.0
    airdrag: float = 0.0
    staticdrag: float = 0.0
    mass: float = 0.0
    movesize: float = 0.0
    insert_offset_z: float = 0.0
    """From the 3DO; x and y have no effect on walking (research document, "Insert Offset")."""
    height: float = 0.0
    """Overrides the hover height when it is not 0."""
    jumpspeed: float = 0.0
    buoyancy: float = 0.0
    maxvel: float = 0.0
    physflags: int = 0
    player: bool = False


WALKPLAYER = Body(
    maxthrust=2.0,
    surfdrag=3.0,
    airdrag=0.5,
    staticdrag=0.3,
    mass=150.0,
    movesize=0.065,
    insert_offset_z=0.120114,
    jumpspeed=1.5,
    maxvel=1.0,
    physflags=0x4A4F,
    player=True,
)
"""The player on foot: drags and thrust from Table 1 of the research document, its insert offset and movesize
from "Insert Offset" and "Descending From Height"; mass, jumpspeed, maxvel and physflags from the `_actor`
template that levels carry."""
