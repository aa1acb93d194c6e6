"""How actors and players move: speeds, stopping, jumps, from their templates by the engine's rules.

On flat ground without ice, in the level's gravity. A walk, run or crouch is the speed at which drag balances thrust
(research document, "Steady Speed"), which the engine's step reaches exactly. What stops a body is its drag, tick by
tick, and its static drag.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from jktools.engine import drag, integration
from jktools.engine.arrays import Float64
from jktools.engine.body import Body
from jktools.engine.flags import PhysicsFlag
from jktools.engine.gravity import gravity_acceleration
from jktools.engine.jump import apex, jump_speed, reach
from jktools.engine.profile import Engine
from jktools.engine.simulation import SCHEME_OF
from jktools.engine.thrust import Keys, Support, actor_acceleration, capped, player_thrust
from jktools.model import Level
from jktools.model.templates import Resolved

BODIES = ("actor", "player")
FPS = 50.0
FPS_RANGE = (10.0, 20.0, 30.0, 50.0, 60.0, 75.0, 100.0, 120.0)
"""Frames a second that `exact` tries."""
LONGEST_STOP = 60.0
"""Seconds after which a body that still moves never stops."""
FORWARD = (0.0, 1.0, 0.0)


class Interval(NamedTuple):
    """The least and the greatest over the frame rates that were tried."""

    least: float
    most: float


class Motion(NamedTuple):
    """One template's motion: JKU and seconds. NaN is not known or not its way to move, infinity has no bound."""

    template: Resolved
    walk: float
    back: float
    strafe: float
    run: float
    crouch: float
    air: float
    """Speed that held keys reach in the air; an AI does not steer there."""
    swim: float
    stop_walk: Interval
    """Way from a walk to rest."""
    stop_run: Interval
    jump_height: float
    """Of the feet over the floor that they leave."""
    crouched_jump_height: float
    jump_reach: float
    """Way over level ground of a jump from a walk, keys held."""
    run_jump_reach: float


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


def body_of(held: Resolved) -> Body:
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

    Stopping: `fast` by the closed form, `balanced` by the engine's step at `fps`, `exact` over 10 to 120 frames a
    second.
    """
    held = [(template, body_of(template)) for template in templates]
    speeds = [_speeds(body, engine) for _, body in held]
    from_walk, from_run = (
        _stops([body for _, body in held], [each[gait] for each in speeds], engine, accuracy, fps)
        for gait in ("walk", "run")
    )
    return [
        _motion(template, body, each, stop_walk, stop_run, gravity)
        for (template, body), each, stop_walk, stop_run in zip(held, speeds, from_walk, from_run, strict=True)
    ]


def _motion(
    template: Resolved, body: Body, speeds: dict[str, float], stop_walk: Interval, stop_run: Interval, gravity: float
) -> Motion:
    pull = -gravity_acceleration(body, gravity=gravity)
    steering = float(player_thrust(body, Keys(forward=1.0), Support.AIR)[1]) if body.player else 0.0
    return Motion(
        template,
        speeds["walk"],
        speeds["back"],
        speeds["strafe"],
        speeds["run"],
        speeds["crouch"],
        speeds["air"],
        speeds["swim"],
        stop_walk,
        stop_run,
        _jump_height(body, pull, crouching=False),
        _jump_height(body, pull, crouching=True) if body.player else math.nan,
        _jump_reach(body, pull, speeds["walk"], steering),
        _jump_reach(body, pull, speeds["run"], steering),
    )


def _speeds(body: Body, engine: Engine) -> dict[str, float]:
    if not body.player:
        return _actor_speeds(body)
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
    if support is Support.SURFACE and engine is Engine.OPENJKDF2:
        thrust = capped(thrust, body.maxvel, 1.0 / FPS)
    pull = drag.coefficients(body, support, thrusting=True, engine=engine)
    size = float(np.linalg.norm(thrust))
    return float(integration.steady_speed(size, pull.drag))


def _actor_speeds(body: Body) -> dict[str, float]:
    """An AI's speeds at its instincts' speed of 1; it has no keys to run or crouch with."""
    found = dict.fromkeys(("run", "crouch", "air"), math.nan)
    thrust = float(np.linalg.norm(actor_acceleration(body, FORWARD)))
    surface = drag.coefficients(body, Support.SURFACE, thrusting=True)
    water = drag.coefficients(body, Support.WATER, thrusting=True)
    walk = float(integration.steady_speed(thrust, surface.drag))
    return found | {
        "walk": walk,
        "back": walk,
        "strafe": walk,
        "swim": float(integration.steady_speed(thrust, water.drag)),
    }


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


def _jump_height(body: Body, pull: float, *, crouching: bool) -> float:
    speed = jump_speed(body, crouching=crouching)
    if speed <= 0:
        return 0.0
    return float(apex(speed, body.airdrag, pull).height) if pull > 0 else math.inf


def _jump_reach(body: Body, pull: float, run_up: float, steering: float) -> float:
    if math.isnan(run_up) or jump_speed(body) <= 0:
        return math.nan if math.isnan(run_up) else 0.0
    if pull <= 0 or math.isinf(run_up):
        return math.inf
    return float(reach(body, run_up, steering=steering, gravity=pull))
