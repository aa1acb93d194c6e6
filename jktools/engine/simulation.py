"""A body stepped through scripted keys over a ground: every rule of motion at work together.

The order of a tick is the decompiled engine's: keys, then forces and drag, then the move with its collisions,
then the search for a floor. The rules are those of the chosen profile. A player's air movement is stepped
like any other body's; neither the fixed 1/50 s substeps of the original's multiplayer code nor walking on walls is
modelled.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from jktools.engine import attachment, drag, gravity, hover, integration, jump, reattach
from jktools.engine.arrays import Float64
from jktools.engine.attachment import Event
from jktools.engine.body import Body
from jktools.engine.flags import PhysicsFlag, SectorFlag, SurfaceFlag
from jktools.engine.ground import TOUCH, UP, Contact, Floor, Ground, Steps, Vector
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.thrust import Keys, Support, capped, player_thrust, thrust_acceleration

SCHEME_OF = {Engine.RESEARCH: Scheme.SEMI_IMPLICIT_EULER, Engine.OPENJKDF2: Scheme.ENGINE}
"""The document assumes Euler, velocity first; the decompiled engine is that with its drag clamped."""

MOST_TICKS = 10_000_000
"""Ticks that one history may hold: half an hour of computing and 1 GB."""

_SLIDES = 5
"""Contacts that one move slides along before it gives up."""


class Phase(NamedTuple):
    """What holds from `start` (seconds) on, until the next phase."""

    start: float
    keys: Keys = Keys()
    ground: Ground | None = None
    """A new ground, None to keep the last."""
    velocity: Vector | None = None
    """Set at once, JKU/s in the body's frame (x right, y forward, z up): what SetThingVel does. None for none."""
    sector_thrust: Vector | None = None
    """JKU/s^2 from now on, in sectors with the flag: what SetSectorThrust does. None to keep the last."""
    extra_speed: float | None = None
    """From now on: what SetActorExtraSpeed does. None to keep the last."""


@dataclass(frozen=True, slots=True)
class World:
    """What surrounds the body, but for its ground."""

    gravity: float = gravity.WORLD_GRAVITY
    sector: int = 0
    """Sector flags."""
    sector_thrust: Vector = (0.0, 0.0, 0.0)
    extra_speed: float = 0.0
    """What SetActorExtraSpeed set."""


class Incident(NamedTuple):
    """Something that happened in the tick that ends at `time`."""

    time: float
    event: Event
    damage: float = 0.0


@dataclass(frozen=True, slots=True)
class History:
    """A simulated motion: row 0 is the start, then one row a tick; `(n,)` seconds and `(n, 3)` JKU."""

    time: Float64
    thrust: Float64
    """As GetThingThrust would read it in that tick, in the body's frame."""
    velocity: Float64
    position: Float64
    attached: np.ndarray[tuple[int], np.dtype[np.bool_]]
    incidents: tuple[Incident, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(slots=True)
class Simulation:
    """One body on its way. It looks along y; `velocity` in JKU/s."""

    body: Body
    ground: Ground = field(default_factory=Steps.flat)
    world: World = World()
    engine: Engine = Engine.RESEARCH
    scheme: Scheme | None = None
    """Defaults to the profile's own."""
    position: Float64 = field(default_factory=lambda: np.zeros(3))
    velocity: Float64 = field(default_factory=lambda: np.zeros(3))
    floor: Floor | None = None
    force_applied: bool = False

    def rest_on_ground(self) -> None:
        """Set the body down where it is: at its hover height on a floor, at its sphere's on any other surface."""
        radius = self.body.movesize
        under = self.ground.floor_below(self._place(), np.inf, 0.0, int(SurfaceFlag.COLLISION))
        if under is None:
            return
        self.floor = under if attachment.takes_floor(self.body.physflags, under.surface) else None
        self.position[2] = under.point[2] + (radius if self.floor is None else self.hover_height())

    def hover_height(self, *, crouching: bool = False) -> float:
        """Give the height at which the body rests over a floor, JKU."""
        b = self.body
        return float(
            hover.hover_height(b.insert_offset_z, b.movesize, height=b.height, crouching=crouching, engine=self.engine)
        )

    def launch(self, velocity: Vector) -> None:
        """Give the body a velocity, JKU/s in its own frame: x right, y forward, z up."""
        self.velocity = np.array(velocity, np.float64)

    def push(self, force: Vector) -> None:
        """Apply a force (mass JKU/s): changes velocity at once, may lift the body off, spares it one tick's drag."""
        effect = gravity.apply_force(self.body, force)
        self.velocity = self.velocity + effect.velocity_change
        self.force_applied |= effect.skips_drag
        if effect.detaches:
            self.floor = None

    def tick(self, keys: Keys, dt: float, *, jumps: bool = False) -> tuple[Float64, list[tuple[Event, float]]]:
        """Advance by `dt` seconds; gives the thrust vector `(3,)` and what happened, with the fall's damage."""
        events: list[tuple[Event, float]] = []
        if self._lifts_off(keys, jumps):
            events.append((Event.DETACHES, 0.0))
        support = self.support()
        surface = self.floor.surface if self.floor else 0
        extra = self.world.extra_speed
        thrust = player_thrust(self.body, keys, support, surface, extra_speed=extra, engine=self.engine)
        before, impact = self.position, self.velocity
        contacts = self._move(self._displacement(thrust, keys, support, dt))
        moved = bool((self.position != before).any())
        events += self._find_floor(contacts, moved, impact)
        return thrust, events

    def support(self) -> Support:
        """Say what carries the body now."""
        if self.floor is not None:
            return Support.SURFACE
        return Support.WATER if self.world.sector & SectorFlag.UNDERWATER else Support.AIR

    def _lifts_off(self, keys: Keys, jumps: bool) -> bool:
        if self.floor is None:
            return False
        lifted = bool(self.world.sector & SectorFlag.THRUST) and gravity.sector_thrust_detaches(
            self.body, self.world.sector_thrust, gravity=self.world.gravity, engine=self.engine
        )
        if jumps:
            self.velocity = self.velocity + np.array([0.0, 0.0, jump.jump_speed(self.body, crouching=keys.crouch)])
        if jumps or lifted:
            self.floor = None
        return self.floor is None

    def _displacement(self, thrust: Float64, keys: Keys, support: Support, dt: float) -> Float64:
        """Step the velocity and give the way of this tick, before collisions."""
        acceleration = self._acceleration(thrust, keys, support, dt)
        pull = drag.coefficients(
            self.body,
            support,
            self.floor.surface if self.floor else 0,
            thrusting=bool(thrust.any()),
            sector_thrust=bool(self.world.sector & SectorFlag.THRUST),
            force_applied=self.force_applied,
            engine=self.engine,
        )
        self.force_applied = False if support is Support.SURFACE else self.force_applied
        if drag.stops(self.velocity, pull.static, self.engine):
            self.velocity = np.zeros(3)
        scheme = self.scheme or SCHEME_OF[self.engine]
        motion = integration.step(scheme, np.zeros(3), self.velocity, acceleration, pull.drag, dt)
        way, self.velocity = motion.position, self._rested(motion.velocity, acceleration, pull.drag)
        if self.floor is None:
            return way
        normal = np.array(self.floor.normal)
        self.velocity = self.velocity - normal * (normal @ self.velocity)
        way = np.where(self.velocity.any(), way - normal * (normal @ way), np.zeros(3))
        return way + self._settling(keys.crouch, dt)

    def _acceleration(self, thrust: Float64, keys: Keys, support: Support, dt: float) -> Float64:
        b, world = self.body, self.world
        normal = self.floor.normal if self.floor else UP
        sector = gravity.sector_acceleration(b, world.sector_thrust, support, sector=world.sector, normal=normal)
        fall = gravity.gravity_acceleration(b, support, sector=world.sector, gravity=world.gravity)
        if self.floor and self.engine is Engine.OPENJKDF2:
            grip = drag.friction(self.floor.surface)
            fall = gravity.slope_acceleration(b, grip, moving=bool(self.velocity.any()), gravity=world.gravity)
        total: Float64 = self._own_acceleration(thrust, keys.crouch, dt) + sector
        return np.add(total, (0.0, 0.0, fall))

    def _own_acceleration(self, thrust: Float64, crouching: bool, dt: float) -> Float64:
        if not self.body.physflags & PhysicsFlag.USES_THRUST:
            return np.zeros(3)
        attached, engine = self.floor is not None, self.engine
        grip = drag.friction(self.floor.surface) if self.floor else 1.0
        own = thrust_acceleration(thrust, friction=grip, crouching=crouching, attached=attached, engine=engine)
        return capped(own, self.body.maxvel, dt) if attached and engine is Engine.OPENJKDF2 else own

    def _rested(self, velocity: Float64, acceleration: Float64, pull: float) -> Float64:
        """What is left of a velocity too slow to count: the engine always looks, the document at rest only."""
        if self.engine is Engine.RESEARCH and (acceleration.any() or not pull):
            return velocity
        return drag.rest(velocity, self.engine)

    def _settling(self, crouching: bool, dt: float) -> Float64:
        """This tick's way towards the hover height: along z for bodies kept upright, else along the normal."""
        assert self.floor is not None
        normal = np.array(self.floor.normal)
        along = np.array(UP) if self.body.physflags & PhysicsFlag.KEEP_UPRIGHT else normal
        height = float((self.position - np.array(self.floor.point)) @ normal) / float(along @ normal)
        error = height - self.hover_height(crouching=crouching)
        # A rounding error is no movement: a body at rest must not look for its floor because of one.
        return along * (0.0 if abs(error) < TOUCH else float(hover.settle(error, dt)) - error)

    def _move(self, way: Float64) -> list[Contact]:
        """Move the sphere, sliding along what it touches; velocity loses what runs into it."""
        contacts: list[Contact] = []
        for _ in range(_SLIDES):
            motion = (float(way[0]), float(way[1]), float(way[2]))
            contact = self.ground.sweep(self._place(), motion, self.body.movesize)
            if contact is None:
                self.position = self.position + way
                break
            contacts.append(contact)
            size = float(np.linalg.norm(way))
            free = contact.distance if contact.distance > TOUCH else 0.0
            self.position = self.position + way * (free / size)
            normal = np.array(contact.normal)
            rest = way * (1 - free / size)
            way = rest - normal * min(0.0, float(normal @ rest))
            self.velocity = self.velocity - normal * min(0.0, float(normal @ self.velocity))
        return contacts

    def _find_floor(self, contacts: Sequence[Contact], moved: bool, impact: Float64) -> list[tuple[Event, float]]:
        """Attach, stay or detach after a move; a landing comes with its damage."""
        was = self.floor is not None
        landed = next((c.floor for c in contacts if c.floor and self._takes(c.floor)), None)
        searched = attachment.looks_for_floor(
            self.body.physflags, self.velocity, attached=was, moved=moved, engine=self.engine
        )
        if searched:
            self.floor = self._search(was) or (landed if not was else None)
        elif not was and moved:
            self.floor = landed
        event = attachment.event(attached=was, searched=searched or moved, found=self.floor is not None)
        if event is Event.ATTACHES and self.floor is not None:
            speed = -float(np.array(self.floor.normal) @ impact)
            return [(event, float(jump.fall_damage(speed, self.floor.surface)))]
        return [(event, 0.0)] if event is Event.DETACHES else []

    def _takes(self, floor: Floor) -> bool:
        return attachment.takes_floor(self.body.physflags, floor.surface, floor.normal[2])

    def _search(self, attached: bool) -> Floor | None:
        b = self.body
        sticks = bool(b.physflags & (PhysicsFlag.FLOOR_STICK | PhysicsFlag.WALL_STICK))
        far = float(
            reattach.search_distance(
                b.insert_offset_z,
                b.movesize,
                height=b.height,
                attached=attached,
                sticks=sticks,
                engine=self.engine,
            )
        )
        found = self.ground.floor_below(self._place(), far, 0.0, SurfaceFlag.FLOOR)
        if found is None and self.engine is Engine.OPENJKDF2:
            found = self.ground.floor_below(self._place(), far, b.movesize, SurfaceFlag.FLOOR)
        return found if found and self._takes(found) else None

    def _place(self) -> Vector:
        return (float(self.position[0]), float(self.position[1]), float(self.position[2]))


def simulate(simulation: Simulation, phases: Sequence[Phase], seconds: float, dt: float) -> History:
    """Run a body through phases, in order of their start, for `seconds` at a fixed `dt`; it starts where it is.

    A jump key acts in its phase's first tick only, as a key press does. Raises ValueError for a dt that is
    not positive, phases out of order, or more than `MOST_TICKS` ticks.
    """
    if not dt > 0 or [p.start for p in phases] != sorted(p.start for p in phases):
        raise ValueError("dt must be positive and the phases in order of their start")
    if not seconds / dt <= MOST_TICKS:
        raise ValueError(f"{seconds:g} s at {dt:g} s a tick are more than {MOST_TICKS} ticks")
    count = round(seconds / dt)
    rows = np.zeros((count + 1, 3, 3))
    attached = np.zeros(count + 1, np.bool_)
    incidents: list[Incident] = []
    rows[0, 1:], attached[0] = (simulation.velocity, simulation.position), simulation.floor is not None
    active, keys = 0, Keys()
    for i in range(count):
        pressed = False
        # Half a tick of slack: a phase that starts at 10 * dt starts there although 10 * dt is not a float.
        while active < len(phases) and phases[active].start <= (i + 0.5) * dt:
            keys, pressed = phases[active].keys, pressed or phases[active].keys.jump
            _begin(simulation, phases[active])
            active += 1
        thrust, events = simulation.tick(keys, dt, jumps=pressed)
        rows[i + 1] = thrust, simulation.velocity, simulation.position
        attached[i + 1] = simulation.floor is not None
        incidents += [Incident((i + 1) * dt, event, damage) for event, damage in events]
    time: Float64 = np.arange(count + 1, dtype=np.float64) * dt
    return History(time, rows[:, 0], rows[:, 1], rows[:, 2], attached, tuple(incidents), _warnings(simulation, dt))


def _begin(simulation: Simulation, phase: Phase) -> None:
    simulation.ground = phase.ground or simulation.ground
    if phase.velocity is not None:
        simulation.launch(phase.velocity)
    if phase.sector_thrust is not None:
        simulation.world = replace(simulation.world, sector_thrust=phase.sector_thrust)
    if phase.extra_speed is not None:
        simulation.world = replace(simulation.world, extra_speed=phase.extra_speed)


def _warnings(simulation: Simulation, dt: float) -> tuple[str, ...]:
    scheme = simulation.scheme or SCHEME_OF[simulation.engine]
    drags = {"surfdrag": simulation.body.surfdrag, "airdrag": simulation.body.airdrag}
    said = ((name, integration.instability(scheme, value, dt)) for name, value in drags.items())
    return tuple(f"{name}: {text}" for name, text in said if text)
