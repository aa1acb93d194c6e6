"""Attachment: when a body attaches to a surface or a thing, stays and detaches, and what the attach flags mean.

Research document, "Attachment" and "Detecting Detachment"; sithPhysics_FindFloor, sithThing_AttachToSurface
and sithThing_LandThing in the decompiled engine.
"""

from __future__ import annotations

import enum

import numpy.typing as npt

from jktools.engine.bounds import bounded
from jktools.engine.flags import PhysicsFlag, SurfaceFlag, WeaponFlag
from jktools.engine.profile import Engine

FACE_NORMAL_Z = 0.6
"""Least z of a thing's face on which a body with floor stick lands."""
STICK_VELOCITY = (-2.0, 0.2)
"""JKU/s: the velocities along z at which an unattached body with floor stick looks for a floor."""
STANDABLE = 0x40
"""Thing flag of what can be stood on."""


class Reading(enum.StrEnum):
    """The two documents that define the attach flags (Tables 15 and 16)."""

    DATAMASTER = "DataMaster"
    JKSPECS = "JKSpecs"


READING_OF = {Engine.RESEARCH: Reading.DATAMASTER, Engine.OPENJKDF2: Reading.JKSPECS}
"""The research document trusts DataMaster without a test of its own; the decompiled engine follows JKSpecs."""

ATTACH_FLAGS = {
    Reading.DATAMASTER: {
        0x1: "attached to a surface",
        0x2: "takes the look vector of the object (with 0x4)",
        0x4: "takes the movement of the object",
        0x8: "attached by relative position (with 0x4)",
    },
    Reading.JKSPECS: {
        0x0: "not attached",
        0x1: "attached to a world surface",
        0x2: "attached to the face of a thing",
        0x4: "attached to a thing, not to a face",
        0x8: "no move relative to the attached thing",
    },
}


class Event(enum.StrEnum):
    """What a search for the floor changes."""

    STAYS = "stays"
    ATTACHES = "attaches"
    DETACHES = "detaches"
    NOTHING = "nothing"


def describe_attachment(flags: int, reading: Reading) -> tuple[str, ...]:
    """List what an attach flag word says in one document's reading, lowest bit first."""
    table = ATTACH_FLAGS[reading]
    if flags == 0:
        return (table[0],) if 0 in table else ()
    return tuple(text for bit, text in table.items() if bit & flags)


def takes_floor(physflags: int, surface: int, normal_z: float = 1.0) -> bool:
    """Say whether a body can attach to a world surface with these flags.

    Floor stick needs the surface's floor flag and a surface that faces up; wall stick takes any solid
    surface.
    """
    if physflags & PhysicsFlag.WALL_STICK:
        return bool(surface & SurfaceFlag.COLLISION)
    return bool(physflags & PhysicsFlag.FLOOR_STICK and surface & SurfaceFlag.FLOOR) and normal_z > 0


def takes_face(physflags: int, thing_flags: int, normal_z: float) -> bool:
    """Say whether a body can land on a face of a thing of type cog: standable, and not too steep for floor stick."""
    if physflags & PhysicsFlag.WALL_STICK:
        return True
    return bool(physflags & PhysicsFlag.FLOOR_STICK and thing_flags & STANDABLE) and normal_z >= FACE_NORMAL_Z


def weapon_sticks(typeflags: int, *, to_thing: bool) -> bool:
    """Say whether a shot sticks to a level surface (0x80) or to a thing (0x800)."""
    needed = WeaponFlag.ATTACH_TO_THINGS if to_thing else WeaponFlag.ATTACH_TO_SURFACES
    return bool(typeflags & needed)


def looks_for_floor(
    physflags: int,
    velocity: npt.ArrayLike,
    *,
    attached: bool,
    moved: bool,
    engine: Engine = Engine.RESEARCH,
) -> bool:
    """Say whether a body with velocity `(3,)` searches for its floor this tick.

    An attached body searches only when it moved, so a stationary one notices no change under it (research
    document, "Surface Flags"). An unattached one lands by its collision sphere ("Insert Offset"); in
    `openjkdf2` one with floor stick also searches while its velocity along z is in `STICK_VELOCITY`, JKU/s.
    """
    if attached or engine is Engine.RESEARCH:
        return attached and moved
    low, high = STICK_VELOCITY
    return bool(physflags & PhysicsFlag.FLOOR_STICK) and moved and bool(low <= bounded(velocity)[2] <= high)


def event(*, attached: bool, searched: bool, found: bool) -> Event:
    """Say what follows from a search: nothing found detaches, whatever was found first attaches.

    A body that walks from surface to surface stays attached throughout: no falling animation, no landing
    sound.
    """
    if not searched:
        return Event.STAYS if attached else Event.NOTHING
    if found:
        return Event.STAYS if attached else Event.ATTACHES
    return Event.DETACHES if attached else Event.NOTHING
