"""The bodies that walk in a level: what differs between its actors and players, as far as floors are concerned."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cache

from jktools.engine.body import Body
from jktools.engine.flags import PhysicsFlag
from jktools.engine.gravity import WORLD_GRAVITY
from jktools.engine.hover import hover_height
from jktools.engine.jump import CROUCHED_JUMP_FACTOR, apex, fall_damage, landing_speed
from jktools.engine.lip import highest_lip
from jktools.engine.profile import Engine
from jktools.engine.reattach import reattach_distance
from jktools.facts.motion import Held, body_of
from jktools.model import Level
from jktools.model.insert_offset import insert_offset
from jktools.model.resolved import Resolved

FULL_HEALTH = 100.0
"""Points of a player who starts; shields and actors' own health are not looked at."""
MOST_DROP = 1000.0
"""JKU: no level is deeper."""
DROP_STEP = 1e-4

PLAYER = "player"
TYPES = ("actor", PLAYER)


@dataclass(frozen=True, slots=True)
class Walker:
    """A body that sticks to floors, and the templates and things that have it."""

    body: Body
    hovers: bool
    """Whether its hover height is known: without it nothing can be said."""
    gravity: float
    """JKU/s^2, of the level."""
    names: tuple[str, ...] = ()
    """Of templates, in lower case."""

    @property
    def title(self) -> str:
        """For messages, with a verb in the singular: its first template, and how many more have the same body."""
        more = f" (and {len(self.names) - 1} more)" if len(self.names) > 1 else ""
        return f"{self.names[0]}{more}"

    @property
    def comes_down(self) -> bool:
        """Whether it falls once it has let go of its floor: not in a level whose gravity is 0 or less."""
        return self.gravity > 0

    def hover(self, engine: Engine) -> float:
        """JKU of its centre over its floor."""
        b = self.body
        return float(hover_height(b.insert_offset_z, b.movesize, height=b.height, engine=engine))

    def reattach(self, engine: Engine) -> float:
        """The deepest drop that it takes without falling, JKU."""
        b = self.body
        offset = b.height or b.insert_offset_z  # the document has no word on `height`, which takes its place
        return float(reattach_distance(offset, b.movesize, height=b.height, engine=engine))

    def clearance(self, engine: Engine) -> float:
        """JKU under its sphere: the highest step that it passes over."""
        return self.hover(engine) - self.body.movesize

    def lip(self, engine: Engine) -> float:
        """The highest step that it surely walks up, sliding over the edge, JKU. Simulated once for each body."""
        return highest_lip(self.body, self.gravity, engine)

    def apex(self, *, crouching: bool = False) -> float:
        """How high it jumps, JKU; without gravity as far as the air lets it, under a negative one without end."""
        speed = self.body.jumpspeed * (CROUCHED_JUMP_FACTOR if crouching else 1.0)
        if not speed > 0:
            return 0.0
        if not self.comes_down:
            drifts = self.gravity == 0 and self.body.airdrag > 0
            return speed / self.body.airdrag if drifts else math.inf
        return float(apex(speed, self.body.airdrag, self.gravity).height)

    def deadly_drop(self) -> float:
        """The least drop, JKU, whose landing costs all of `FULL_HEALTH`; infinite where none does.

        For a fall without a speed along z at its start.
        """
        return _deadly_drop(self.body.airdrag, self.gravity)

    def jump(self, engine: Engine) -> float:
        """The highest floor that it jumps onto, JKU."""
        return self.apex() + self.clearance(engine)


@cache
def _deadly_drop(airdrag: float, gravity: float) -> float:
    def damage(drop: float) -> float:
        return float(fall_damage(landing_speed(drop, 0.0, airdrag, gravity)))

    low, high = 0.0, MOST_DROP
    if not gravity > 0 or damage(high) < FULL_HEALTH:
        return math.inf
    while high - low > DROP_STEP:
        middle = (low + high) / 2
        low, high = (low, middle) if damage(middle) >= FULL_HEALTH else (middle, high)
    return high


def walkers(level: Level, reached: Iterable[Resolved] | None = None) -> tuple[Walker, ...]:
    """The distinct bodies among the actors and players of a level, players first, then in the order of the file.

    `reached` are the templates that can come into play, by default all; placed things count in any case. Bodies that
    do not stick to floors (0x40), that fly (0x2000) or that have no movesize are none.
    """
    found: dict[tuple[object, ...], Walker] = {}
    templates = level.resolved_templates.entries if reached is None else reached
    things = (thing.resolved for thing in level.things if thing.dropped is None)
    for held in (*templates, *things):
        walker = _walker(level, held)
        if walker is None:
            continue
        key = (
            walker.body.movesize, walker.body.insert_offset_z, walker.body.height, walker.body.jumpspeed,
            walker.body.physflags, walker.body.player, walker.hovers,
        )  # fmt: skip
        known = found.setdefault(key, walker)
        if walker.names[0] not in known.names:
            found[key] = replace(known, names=(*known.names, *walker.names))
    return tuple(sorted(found.values(), key=lambda w: not w.body.player))


def _walker(level: Level, held: Resolved) -> Walker | None:
    flags = held.flags("physflags")
    if held.dropped is not None or held.type not in TYPES or held.move != "physics":
        return None
    if not flags & PhysicsFlag.FLOOR_STICK or flags & PhysicsFlag.FLIES or held.number("movesize") <= 0:
        return None
    body, hovers = hovering_body(held, insert_z_of(level))
    gravity = level.header.values.get("gravity", (WORLD_GRAVITY,))
    name = str(getattr(held.owner, "template_name", held.owner.name)).lower()
    return Walker(body, hovers, float(gravity[0]), (name,))


def hovering_body(held: Held, insert_z: Callable[[str], float | None]) -> tuple[Body, bool]:
    """What the engine moves of a template, with its model's insert offset; and whether its hover height is known.

    `insert_z` gives that offset's z, JKU, of a model by its name; None where nothing tells it.
    """
    body = body_of(held)
    if body.height:
        return body, True
    offset = insert_z(held.name_in("model3d") or "")
    return replace(body, insert_offset_z=offset or 0.0), offset is not None


def insert_z_of(level: Level) -> Callable[[str], float | None]:
    """Tell the z of the insert offset of each model that a level's files, or the table of known ones, tell."""

    def insert_z(model: str) -> float | None:
        offset = insert_offset(level.resources, model)
        return None if offset is None else offset.z

    return insert_z
