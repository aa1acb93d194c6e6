"""The flag words that motion reads, in the engine's own numbering.

Sources: research document, "Attachment / Flags" (Tables 15 and 16); the decompiled engine for what it does
with them.

Enumerations of bits, not flag types: they are masks for plain flag words, and an IntFlag builds an object at every
test of a bit, which was a tenth of a simulated tick.
"""

from __future__ import annotations

import enum


class SurfaceFlag(enum.IntEnum):
    """Surface flags (`surfflags` of a JKL surface) that change how a body moves."""

    FLOOR = 0x1
    COLLISION = 0x4
    NO_FALL_DAMAGE = 0x80
    ICY = 0x1000
    VERY_ICY = 0x2000
    DEEP_WATER = 0x20000
    SHALLOW_WATER = 0x40000
    VERY_DEEP_WATER = 0x100000


class SectorFlag(enum.IntEnum):
    """Sector flags that change how a body moves."""

    NO_GRAVITY = 0x1
    UNDERWATER = 0x2
    THRUST = 0x8


class PhysicsFlag(enum.IntEnum):
    """Physics flags (`physflags` of a template). Where the community's documents differ, the engine is followed."""

    GRAVITY = 0x1
    USES_THRUST = 0x2
    ALIGN_TO_SURFACE = 0x10
    FLOOR_STICK = 0x40
    WALL_STICK = 0x80
    ORIENTATION_SETTLED = 0x100
    """Cleared at each new attachment and set once the body is upright: DataMaster's "attached"."""
    KEEP_UPRIGHT = 0x800
    """Stay upright and measure height along z. DataMaster: gravity while attached, which the engine contradicts."""
    FLIES = 0x2000
    FEELS_BLAST = 0x4000
    """Pushed by explosions, in the air too. DataMaster: when attached, which the engine contradicts."""
    FORCE_APPLIED = 0x8000
    CROUCHING = 0x10000
    HALF_GRAVITY = 0x40000
    HALF_THRUST = 0x200000
    """Cleared in every attached tick."""
    NO_SECTOR_THRUST = 0x400000


class WeaponFlag(enum.IntEnum):
    """Weapon type flags that make a shot stick (research document, "Weapon Flags")."""

    ATTACH_TO_SURFACES = 0x80
    ATTACH_TO_THINGS = 0x800


class AttachFlag(enum.IntEnum):
    """Attach flags of a thing at run time as the engine uses them, which is JKSpecs' reading (Table 16)."""

    WORLD_SURFACE = 0x1
    THING_FACE = 0x2
    THING = 0x4
    NO_MOVE = 0x8
