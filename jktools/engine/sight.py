"""What blocks HasLOS: which surfaces and things, by profile. Geometry asks; nothing here walks a level.

Sources: research document, "HasLOS" (its basic implementation: any solid thing or surface blocks);
`sithCollision_HasLos` and `sithCollision_SearchRadiusForThings` in the decompiled engine.
"""

from __future__ import annotations

import enum

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Bool
from jktools.engine.profile import Engine

SURFACE_COLLISION = 0x4
ADJOIN_VISIBLE = 0x1
ADJOIN_MOVEMENT = 0x2
THING_WILL_BE_REMOVED = 0x2
THING_DISABLED = 0x80000

MAX_SECTORS = 64
"""Sectors that the decompiled engine searches; beyond them all counts as clear."""
TOUCHING = 1e-5
"""JKU: an end this near a blocking face is called touching; a face farther behind the start is unseen."""
NO_THING = -1
"""What HasLOS answers in the decompiled engine for a null thing; a script takes it for true."""


class ThingType(enum.StrEnum):
    """Name the thing types that sight tells apart; every other type is OTHER."""

    ACTOR = "actor"
    PLAYER = "player"
    COG = "cog"
    OTHER = "other"


class Through(enum.IntFlag):
    """Name the adjoin flag that lets a ray pass: HasLOS asks for visibility, explosions for movement."""

    SIGHT = ADJOIN_VISIBLE
    BLAST = ADJOIN_MOVEMENT


def surface_blocks(
    surface_flags: npt.ArrayLike,
    adjoin_flags: npt.ArrayLike,
    has_adjoin: npt.ArrayLike,
    engine: Engine = Engine.RESEARCH,
    through: Through = Through.SIGHT,
) -> Bool:
    """Tell which surfaces block a ray: (...) bool, from integer flags (...).

    An adjoin blocks unless its flag 0x1 is set (0x2 for a blast). A surface without one blocks in `research`,
    and in `openjkdf2` only with the collision flag 0x4. `adjoin_flags` count only where `has_adjoin` is set.
    """
    closed = (np.asarray(adjoin_flags) & int(through)) == 0
    wall = np.ones_like(closed)
    if engine is Engine.OPENJKDF2:
        wall = (np.asarray(surface_flags) & SURFACE_COLLISION) != 0
    return np.asarray(np.where(np.asarray(has_adjoin, np.bool_), closed, wall))


def thing_blocks(
    is_cog: npt.ArrayLike,
    collide: npt.ArrayLike,
    thing_flags: npt.ArrayLike,
    is_end: npt.ArrayLike,
    engine: Engine = Engine.RESEARCH,
) -> Bool:
    """Tell which things can block HasLOS: (...) bool.

    `collide` is the template parameter: 0 is not solid. In `research` any solid thing blocks, in `openjkdf2`
    only one of type cog (`is_cog`). Disabled things and those about to be removed do not collide; the two
    things asked about (`is_end`) never block.
    """
    gone = (np.asarray(thing_flags) & (THING_DISABLED | THING_WILL_BE_REMOVED)) != 0
    solid = (np.asarray(collide) != 0) & ~gone & ~np.asarray(is_end, np.bool_)
    return np.asarray(solid & np.asarray(is_cog, np.bool_) if engine is Engine.OPENJKDF2 else solid)


def end_on_face_blocks(engine: Engine = Engine.RESEARCH) -> bool:
    """Tell whether a ray that ends on a blocking face is blocked: in `openjkdf2` only."""
    return engine is Engine.OPENJKDF2


def face_is_seen(distance: npt.ArrayLike, engine: Engine = Engine.RESEARCH) -> Bool:
    """Tell which faces a ray can hit, by the distance (...) of its start before their plane, JKU.

    In `openjkdf2` one that the start lies more than 1e-5 behind is passed over.
    """
    before = np.asarray(distance, np.float64)
    return np.asarray(before >= -TOUCHING if engine is Engine.OPENJKDF2 else np.ones(before.shape, np.bool_))


def sector_is_skipped(
    box_low: npt.ArrayLike, box_high: npt.ArrayLike, end: npt.ArrayLike, engine: Engine = Engine.RESEARCH
) -> Bool:
    """Tell which sectors are passed with no face tested: (...) bool.

    `box_low` and `box_high` are (..., 3), the sector's COLLIDEBOX, JKU, NaN without one; `end` is (..., 3).
    In `openjkdf2` a sector whose box strictly holds the end of the ray is skipped whole: a bug that levels
    can hit.
    """
    point = np.asarray(end, np.float64)
    inside = ((np.asarray(box_low) < point) & (point < np.asarray(box_high))).all(axis=-1)
    return np.asarray(inside & (engine is Engine.OPENJKDF2))
