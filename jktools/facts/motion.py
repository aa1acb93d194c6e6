"""How actors and players move: speeds, stopping, jumps, from their templates by the engine's rules.

On flat ground without ice, in the level's gravity. A walk, run or crouch is the speed at which drag balances thrust
(research document, "Steady Speed"), which the engine's step reaches exactly. What stops a body is its drag, tick by
tick, and its static drag. A jump ends where the body is as high again as it started. That is not yet the landing, which
depends on the hover height, that of the model: by the research document the body comes down by its sphere, later by
hover height less `movesize`; the decompiled engine takes the floor up to 2 `movesize` + 0.005 less the hover height
earlier, by the sphere that it sweeps (sithPhysics_FindFloor).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from jktools.engine import drag, integration
from jktools.engine.arrays import Bool, Float64
from jktools.engine.body import Body
from jktools.engine.flags import PhysicsFlag
from jktools.engine.gravity import gravity_acceleration
from jktools.engine.jump import apex, flight_seconds, jump_speed
from jktools.engine.profile import Engine
from jktools.engine.simulation import SCHEME_OF
from jktools.engine.thrust import Keys, Support, actor_acceleration, capped, player_thrust, thrust_acceleration
from jktools.model import Level
from jktools.model.resolved import Resolved

BODIES = ("actor", "player")
FPS = 50.0
FPS_RANGE = (10.0, 20.0, 30.0, 50.0, 60.0, 75.0, 100.0, 120.0)
"""Frames a second that `exact` tries."""
LONGEST_STOP = 60.0
"""Seconds after which a body that still moves never stops."""
FORWARD = (0.0, 1.0, 0.0)
TAKES_FLOORS = PhysicsFlag.FLOOR_STICK | PhysicsFlag.WALL_STICK
"""Without either no floor ever holds a body: it does not walk, stop or jump."""
ON_FLOORS = ("walk", "back", "strafe", "run", "crouch")


class Interval(NamedTuple):
    """The least and the greatest over the frame rates that were tried."""

    least: float
    most: float


NO_WAY = Interval(math.nan, math.nan)


class Jump(NamedTuple):
    """One way to jump: JKU."""

    height: Interval
    reach: Interval


class Motion(NamedTuple):
    """One template's motion: JKU and seconds. NaN is not known or not its way to move, infinity has no bound."""

    template: Resolved
    walk: float
    back: float
    strafe: float
    run: float
    crouch: float
    air: float
    """Speed that held keys reach in the air; an AI does not steer there unless it flies."""
    swim: float
    stop_walk: Interval
    """Way from a walk to rest."""
    stop_run: Interval
    jump_height: Interval
    """Of the feet over the floor that they leave."""
    crouched_jump_height: Interval
    jump_reach: Interval
    """Way over level ground of a jump from a walk, keys held."""
    run_jump_reach: Interval


def bodies(level: Level) -> list[Resolved]:
    """The templates of actors and players that move by physics and that the engine keeps."""
    return [held for held in level.resolved_templates.entries if held.dropped is None and is_body(held)]


def is_body(held: Resolved) -> bool:
    """Whether a template or thing is an actor or player that moves by physics."""
    return held.type in BODIES and held.move == "physics"


def gravity_of(level: Level) -> float:
    """The level's gravity, JKU/s^2: that of its header; 0 without one, as in the engine."""
    values = level.header.values.get("gravity", ())
    given = float(np.sum(values))
    return given if math.isfinite(given) else 0.0


class Held(Protocol):
    """A template as the engine holds it, whether resolved from a level's text or read from a compiled one."""

    @property
    def type(self) -> str:
        """As `type` spells it: `actor`."""

    @property
    def move(self) -> str:
        """As `move` spells it: `physics`."""

    def number(self, key: str) -> float:
        """A number that a parameter holds; 0 where nothing sets it."""

    def flags(self, key: str) -> int:
        """The flags that a parameter holds."""

    def name_in(self, key: str) -> str | None:
        """The name that a parameter holds, in lower case."""


def body_of(held: Held) -> Body:
    """What the engine moves of a template; the hover height, which the model gives, is left out."""
    return Body(
        maxthrust=held.number("maxthrust"),
        surfdrag=held.number("surfdrag"),
        airdrag=held.number("airdrag"),
        staticdrag=held.number("staticdrag"),
        mass=held.number("mass"),
        movesize=held.number("movesize"),
        height=held.number("height"),
        jumpspeed=held.number("jumpspeed"),
        buoyancy=held.number("buoyancy"),
        maxvel=held.number("maxvel"),
        physflags=held.flags("physflags"),
        player=held.type == "player",
    )


def motions(
    templates: Sequence[Resolved],
    gravity: float,
    *,
    engine: Engine = Engine.RESEARCH,
    accuracy: str = "balanced",
    fps: float = FPS,
) -> list[Motion]:
    """Work out the motion of templates in a gravity, JKU/s^2.

    Stopping and jumps: `fast` by the closed form, `balanced` by the engine's step at `fps`, `exact` by that step over
    10 to 120 frames a second.
    """
    held = [body_of(template) for template in templates]
    speeds = [_speeds(body, engine) for body in held]
    from_walk, from_run = (
        _stops(held, [each[gait] for each in speeds], engine, accuracy, fps) for gait in ("walk", "run")
    )
    jumps = [
        _jumps(held, gravity, [each[gait] for each in speeds], engine, accuracy, fps, crouching=crouching)
        for gait, crouching in (("walk", False), ("run", False), ("crouch", True))
    ]
    return [
        Motion(
            template,
            each["walk"],
            each["back"],
            each["strafe"],
            each["run"],
            each["crouch"],
            each["air"],
            each["swim"],
            stop_walk,
            stop_run,
            walk.height if body.physflags & TAKES_FLOORS else NO_WAY,
            crouch.height if body.player and body.physflags & TAKES_FLOORS else NO_WAY,
            walk.reach,
            run.reach,
        )
        for template, body, each, stop_walk, stop_run, walk, run, crouch in zip(
            templates, held, speeds, from_walk, from_run, *jumps, strict=True
        )
    ]


def _speeds(body: Body, engine: Engine) -> dict[str, float]:
    found = _player_speeds(body, engine) if body.player else _actor_speeds(body, engine)
    return found if body.physflags & TAKES_FLOORS else found | dict.fromkeys(ON_FLOORS, math.nan)


def _player_speeds(body: Body, engine: Engine) -> dict[str, float]:
    gaits = {
        "walk": Keys(forward=1.0),
        "back": Keys(forward=-1.0),
        "strafe": Keys(strafe=1.0),
        "run": Keys(forward=1.0, run=True),
        "crouch": Keys(forward=1.0, crouch=True),
    }
    found = {name: _steady(body, keys, Support.SURFACE, engine) for name, keys in gaits.items()}
    found["air"] = _steady(body, Keys(forward=1.0), Support.AIR, engine)
    found["swim"] = _steady(body, Keys(forward=1.0), Support.WATER, engine)
    return found


def _steady(body: Body, keys: Keys, support: Support, engine: Engine) -> float:
    if not body.physflags & PhysicsFlag.USES_THRUST:
        return 0.0
    thrust = player_thrust(body, keys, support, engine=engine)
    attached = support is Support.SURFACE
    thrust = thrust_acceleration(thrust, crouching=keys.crouch, attached=attached, engine=engine)
    if attached and engine is Engine.OPENJKDF2:
        thrust = capped(thrust, body.maxvel, 1.0 / FPS)
    pull = drag.coefficients(body, support, thrusting=True, engine=engine)
    size = float(np.linalg.norm(thrust))
    return float(integration.steady_speed(size, pull.drag))


def _actor_speeds(body: Body, engine: Engine) -> dict[str, float]:
    """An AI's speeds at its instincts' speed of 1; it has no keys to run or crouch with.

    In the decompiled engine an AI adds to the velocity before the frame's drag is taken (sithAI_Tick comes before
    sithPhysics_ThingTick), which leaves it slower by what it adds in a frame.
    """
    thrust = float(np.linalg.norm(actor_acceleration(body, FORWARD)))
    found = dict.fromkeys(("run", "crouch", "air"), math.nan)
    ways = {Support.SURFACE: ("walk", "back", "strafe"), Support.WATER: ("swim",)}
    if body.physflags & PhysicsFlag.FLIES:
        ways[Support.AIR] = ("air",)
    for support, gaits in ways.items():
        pull = drag.coefficients(body, support, thrusting=True, engine=engine)
        speed = float(integration.steady_speed(thrust, pull.drag))
        if engine is Engine.OPENJKDF2:
            speed = max(0.0, speed - thrust / FPS)
        found |= dict.fromkeys(gaits, speed)
    return found


def _stops(held: Sequence[Body], speeds: Sequence[float], engine: Engine, accuracy: str, fps: float) -> list[Interval]:
    start = np.array(speeds, np.float64)
    pulls = [drag.coefficients(body, Support.SURFACE, engine=engine) for body in held]
    k = np.array([pull.drag for pull in pulls], np.float64)
    static = np.array([pull.static for pull in pulls], np.float64)
    if accuracy == "fast":
        tries = [_closed_stop(start, k, static, engine)]
    else:
        rates = FPS_RANGE if accuracy == "exact" else (fps,)
        tries = [stopping_distance(start, k, static, 1.0 / rate, engine) for rate in rates]
    return [Interval(float(least), float(most)) for least, most in zip(np.min(tries, 0), np.max(tries, 0), strict=True)]


def _closed_stop(speed: Float64, k: Float64, static: Float64, engine: Engine) -> Float64:
    """Speed falls by k for each JKU of way, down to what stops the body at once."""
    end = np.maximum(static, drag.REST_SPEED[engine])
    lost = np.maximum(speed - end, 0.0)
    way = np.divide(lost, k, out=np.full(len(k), np.inf), where=k > 0)
    return np.where(np.isnan(speed), np.nan, np.where(lost == 0, 0.0, way))


def stopping_distance(
    speed: Float64, k: Float64, static: Float64, dt: float, engine: Engine = Engine.RESEARCH
) -> Float64:
    """Step bodies on a floor to rest, keys released: (n,) JKU; infinite for one that moves after a minute.

    `speed` (n,) JKU/s, `k` (n,) drag in 1/s, `static` (n,) JKU/s, `dt` in s. As `Simulation` steps: static drag first,
    then the profile's scheme, then what is too slow to count.
    """
    known = np.isfinite(speed)
    velocity = np.zeros((len(speed), 3))
    velocity[:, 1] = np.where(known, speed, 0.0)
    way = np.zeros_like(velocity)
    k3 = k[:, None]
    for _ in range(math.ceil(LONGEST_STOP / dt)):
        velocity[drag.stops(velocity, static, engine)] = 0.0
        if not velocity.any():
            break
        moved = integration.step(SCHEME_OF[engine], way, velocity, np.zeros(3), k3, dt)
        way, velocity = moved.position, np.where(k3 > 0, drag.rest(moved.velocity, engine), moved.velocity)
    stopped = np.where(velocity.any(axis=1), np.inf, np.abs(way[:, 1]))
    return np.where(known, stopped, np.where(np.isnan(speed), np.nan, np.inf))


def _jumps(
    held: Sequence[Body],
    gravity: float,
    run_up: Sequence[float],
    engine: Engine,
    accuracy: str,
    fps: float,
    *,
    crouching: bool,
) -> list[Jump]:
    """Jumps with the forward key held, from a run-up in JKU/s."""
    if not held:
        return []
    speed = np.array([jump_speed(body, crouching=crouching) for body in held])
    pull = np.array([-gravity_acceleration(body, gravity=gravity) for body in held])
    drags = np.array([body.airdrag for body in held])
    steering = np.array([_steering(body, engine) for body in held])
    start = np.array(run_up, np.float64)
    if accuracy == "fast":
        tries = [_closed_jump(speed, pull, drags, start, steering)]
    else:
        rates = FPS_RANGE if accuracy == "exact" else (fps,)
        tries = [jump_flight(speed, pull, drags, start, steering, 1.0 / rate, engine) for rate in rates]
    found = np.array(tries)
    least, most = found.min(axis=0), found.max(axis=0)
    return [
        Jump(
            Interval(float(least[0, i]), float(most[0, i])),
            Interval(float(least[1, i]), float(most[1, i])),
        )
        for i in range(len(held))
    ]


def _steering(body: Body, engine: Engine) -> float:
    """What the forward key adds in the air, JKU/s^2; an AI does not steer there."""
    if not body.player or not body.physflags & PhysicsFlag.USES_THRUST:
        return 0.0
    return float(player_thrust(body, Keys(forward=1.0), Support.AIR, engine=engine)[1])


def _closed_jump(
    speed: Float64, pull: Float64, k: Float64, start: Float64, steering: Float64
) -> tuple[Float64, Float64]:
    """Height and reach of jumps by the closed form."""
    falls, jumps = pull > 0, speed > 0
    safe = np.where(falls, pull, 1.0)
    height = apex(speed, k, safe).height
    seconds = flight_seconds(speed, 0.0, k, safe)
    way = integration.closed_form(0.0, np.nan_to_num(start, posinf=0.0), steering, k, seconds).position
    return _told(jumps, falls, start, height, way)


def jump_flight(
    speed: Float64, pull: Float64, k: Float64, start: Float64, steering: Float64, dt: float,
    engine: Engine = Engine.RESEARCH,
) -> tuple[Float64, Float64]:  # fmt: skip
    """Step jumps until they are as high again as they started: greatest height and way over the ground, (n,) JKU each.

    `speed` (n,) upwards and `start` (n,) forward, JKU/s; `pull` (n,) gravity and `steering` (n,) forward, JKU/s^2; `k`
    (n,) air drag in 1/s, `dt` in s. As `Simulation` steps: velocity, then position; within the last frame the body goes
    straight. Infinite height and way where nothing pulls down, or for a flight of more than a minute.
    """
    falls, jumps = pull > 0, speed > 0
    flying = falls & jumps
    velocity = np.stack([np.zeros_like(speed), np.nan_to_num(start, posinf=0.0), speed], axis=1)
    push = np.stack([np.zeros_like(speed), steering, -pull], axis=1)
    place, top, way = np.zeros_like(velocity), np.zeros_like(speed), np.full_like(speed, np.inf)
    for _ in range(math.ceil(LONGEST_STOP / dt)):
        if not flying.any():
            break
        moved = integration.step(SCHEME_OF[engine], place, velocity, push, k[:, None], dt)
        landed = flying & (moved.position[:, 2] <= 0)
        drop = place[:, 2] - moved.position[:, 2]
        part = np.divide(place[:, 2], drop, out=np.zeros_like(drop), where=landed & (drop > 0))
        forward = place[:, 1] + (moved.position[:, 1] - place[:, 1]) * part
        way = np.where(landed, forward, way)
        flying &= ~landed
        top = np.where(flying, np.maximum(top, moved.position[:, 2]), top)
        place, velocity = moved.position, moved.velocity
    return _told(jumps, falls & ~flying, start, top, way)


def _told(jumps: Bool, falls: Bool, start: Float64, height: Float64, way: Float64) -> tuple[Float64, Float64]:
    """Jumps that none make are 0, those that nothing ends infinite; the way from a speed that is not known is not."""
    reach = np.where(jumps, np.where(falls & np.isfinite(start), way, np.inf), 0.0)
    return np.where(jumps, np.where(falls, height, np.inf), 0.0), np.where(np.isnan(start), np.nan, reach)
