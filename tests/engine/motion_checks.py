"""What holds the motion values of golden.toml: one check a finding, which names the keys that it reads.

`test_golden_motion.py` runs them and asks that no key is left out; `test_mutation_motion.py` perturbs every
key and every formula and asks that a check notices. Where an experiment's outcome does not hang on a small
change of its input (a pit of 0.11 is as seamless as one of 0.112), the check states the document's input as
well.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from jktools.engine import (
    body,
    drag,
    gravity,
    integration,
    orientation,
    thrust,
)
from jktools.engine.flags import PhysicsFlag, SectorFlag, SurfaceFlag
from jktools.engine.ground import SURFACES, Steps
from jktools.engine.profile import Engine
from jktools.engine.simulation import History, Phase, Simulation, World, simulate
from jktools.engine.thrust import Keys, Support

Golden = dict[str, Any]
Check = Callable[[Golden], None]

CHECKS: dict[str, Check] = {}
"""Key pattern (fnmatch on dotted paths, list entries by index) -> what holds it."""

FLOOR, NON_FLOOR, ICY, VERY_ICY = (SURFACES[name] for name in ("floor", "non-floor", "icy", "very-icy"))
WALK, RUN = Keys(forward=1), Keys(forward=1, run=True)


def holds(*patterns: str) -> Callable[[Check], Check]:
    def register(check: Check) -> Check:
        for pattern in patterns:
            assert pattern not in CHECKS
            CHECKS[pattern] = check
        return check

    return register


def exactly(value: float) -> Any:
    """The document's decimals: equal but for float64's rounding."""
    return pytest.approx(value, rel=1e-12, abs=1e-15)


def run(
    phases: list[Phase],
    seconds: float,
    *,
    dt: float = 0.02,
    surface: int = FLOOR,
    engine: Engine = Engine.RESEARCH,
    of: body.Body | None = None,
    world: World | None = None,
    start: tuple[float, float, float] = (0.0, 0.0, 0.0),
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ground: Steps | None = None,
) -> History:
    simulation = Simulation(
        of or body.WALKPLAYER,
        ground or Steps.flat(surface),
        world or World(),
        engine,
        position=np.array(start),
        velocity=np.array(velocity),
    )
    if start[2] == 0:
        simulation.rest_on_ground()
    return simulate(simulation, phases, seconds, dt)


def changed(**parameters: float) -> body.Body:
    return dataclasses.replace(body.WALKPLAYER, **parameters)


@holds("walkplayer.*")
def walkplayer(golden: Golden) -> None:
    for name, value in golden["walkplayer"].items():
        assert getattr(body.WALKPLAYER, name) == value, name


DIRECTIONS = {
    "forward": Keys(forward=1),
    "backward": Keys(forward=-1),
    "strafe_left": Keys(strafe=-1),
    "strafe_right": Keys(strafe=1),
}


@holds("thrust.forward.*", "thrust.backward.*", "thrust.strafe_left.*", "thrust.strafe_right.*")
def movement_table(golden: Golden) -> None:
    for name, keys in DIRECTIONS.items():
        row = golden["thrust"][name]
        for engine in Engine:
            vector = thrust.player_thrust(body.WALKPLAYER, keys, engine=engine)
            expected = [0.0, 0.0, 0.0]
            expected["xyz".index(row["axis"])] = row["walk"]
            assert vector == exactly(expected), (name, engine)
            assert row["walk"] == exactly(row["factor"] * body.WALKPLAYER.maxthrust)


@holds("thrust.frame")
def thrust_follows_the_look(golden: Golden) -> None:
    assert golden["thrust"]["frame"] == "look direction"
    forward = thrust.player_thrust(body.WALKPLAYER, WALK)
    for engine in Engine:
        to_the_left = thrust.thrust_acceleration(forward, orientation.matrix((0, 90, 0)), engine=engine)
        assert to_the_left == exactly([-2.0, 0.0, 0.0])


@holds("thrust.gravity_changes_thrust")
def falling_shows_no_thrust(golden: Golden) -> None:
    fall = run([], 1.0, start=(0, 0, 50), surface=0)
    assert fall.velocity[-1, 2] < -1
    assert bool(fall.thrust.any()) is golden["thrust"]["gravity_changes_thrust"]


@holds("thrust.unattached_factor")
def unattached_thrust(golden: Golden) -> None:
    factor = golden["thrust"]["unattached_factor"]
    deep = SURFACES["deep-water"]
    for engine in Engine:
        for keys in (WALK, RUN, Keys(forward=1, crouch=True)):
            vector = thrust.player_thrust(body.WALKPLAYER, keys, Support.AIR, deep, extra_speed=1.0, engine=engine)
            assert vector == exactly([0.0, (2.0 + 1.0) * factor, 0.0]), (engine, keys)


@holds("thrust.run_factor", "thrust.crouch_factor")
def gaits(golden: Golden) -> None:
    rules = golden["thrust"]
    for engine in Engine:
        for name, walk in DIRECTIONS.items():
            base = thrust.player_thrust(body.WALKPLAYER, walk, engine=engine)
            running, crouching = dataclasses.replace(walk, run=True), dataclasses.replace(walk, crouch=True)
            both = dataclasses.replace(crouching, run=True)
            assert thrust.player_thrust(body.WALKPLAYER, running, engine=engine) == exactly(
                base * rules["run_factor"]
            ), name
            for keys in (crouching, both):
                vector = thrust.player_thrust(body.WALKPLAYER, keys, engine=engine)
                assert vector == exactly(base * rules["crouch_factor"]), name


@holds("thrust.icy_changes_thrust", "thrust.shallow_water_factor")
def surfaces_and_thrust(golden: Golden) -> None:
    rules = golden["thrust"]
    on_floor = np.array([0.0, 2.0, 0.0])
    for engine in Engine:
        for surface in (ICY, VERY_ICY):
            vector = thrust.player_thrust(body.WALKPLAYER, WALK, surface=surface, engine=engine)
            assert bool((vector != on_floor).any()) is rules["icy_changes_thrust"]
        shallow = thrust.player_thrust(body.WALKPLAYER, WALK, surface=SURFACES["shallow-water"], engine=engine)
        assert shallow == exactly(on_floor * rules["shallow_water_factor"])


@holds("thrust.flags.*", "flags.surface.*")
def surface_flags(golden: Golden) -> None:
    for name, bit in {**golden["thrust"]["flags"], **golden["flags"]["surface"]}.items():
        assert SurfaceFlag[name.upper()] == bit


@holds(
    "actor_thrust.powerdroid_maxthrust",
    "actor_thrust.robotsentry_maxthrust",
    "actor_thrust.moves_before_facing",
)
def actors_accelerate_at_maxthrust(golden: Golden) -> None:
    rules = golden["actor_thrust"]
    assert (rules["powerdroid_maxthrust"], rules["robotsentry_maxthrust"]) == (0.2, 0.8)
    for maxthrust in (0.2, 0.8):
        actor = body.Body(maxthrust=maxthrust)
        ways = [thrust.actor_acceleration(actor, way) for way in ((0, 1, 0), (0, -3, 0), (2, 0, 0), (3, 4, 9))]
        # Every way at full strength, the look not asked for: an actor may walk where it does not look.
        assert np.linalg.norm(ways, axis=1) == exactly([maxthrust] * 4)
        assert bool(ways[1] @ (0.0, -1.0, 0.0) > 0) is rules["moves_before_facing"]


@holds("actor_thrust.uses_thrust_physflag", "actor_thrust.get_thing_thrust")
def actors_read_no_thrust(golden: Golden) -> None:
    rules = golden["actor_thrust"]
    assert rules["uses_thrust_physflag"] == PhysicsFlag.USES_THRUST
    assert rules["get_thing_thrust"] == thrust.ACTOR_READABLE_THRUST
    without = run([Phase(0, WALK)], 1.0, of=changed(physflags=body.WALKPLAYER.physflags & ~PhysicsFlag.USES_THRUST))
    assert without.position[-1, 1] == 0.0


@holds("steady_speed.*")
def steady_speeds(golden: Golden) -> None:
    tables = golden["steady_speed"]
    assert [row["tolerance"] for row in tables.values()] == [0.03, 0.02]
    places = (
        (Support.SURFACE, FLOOR, tables["walk_floor"]),
        (Support.AIR, NON_FLOOR, tables["walk_non_floor"]),
    )
    for support, surface, row in places:
        force = thrust.player_thrust(body.WALKPLAYER, WALK, support)[1]
        pull = drag.coefficients(body.WALKPLAYER, support, thrusting=True).drag
        assert (force, pull) == exactly((row["thrust"], row["drag"]))
        assert float(integration.steady_speed(force, pull)) == pytest.approx(row["speed"], abs=row["tolerance"])
        for engine in Engine:
            walked = run([Phase(0, WALK)], 30.0, surface=surface, engine=engine).velocity[-1, 1]
            assert walked == pytest.approx(row["speed"], abs=row["tolerance"])


@holds("dynamic_drag.decay_time.*", "dynamic_drag.fit.*")
def decay_times(golden: Golden) -> None:
    fit, table = golden["dynamic_drag"]["fit"], golden["dynamic_drag"]["decay_time"]
    assert fit["rest_speed"] == drag.REST_SPEED[Engine.RESEARCH]
    seconds = np.array([row["seconds"] for row in table])
    frames = drag.decay_frames([row["surfdrag"] for row in table], fit["frame_seconds"])
    errors = {lost: float(np.abs((frames - lost) * fit["frame_seconds"] / seconds - 1).max()) for lost in range(5)}
    bound = fit["max_relative_error"]
    assert [lost for lost, error in errors.items() if error < bound] == [fit["frames_lost"]]
    assert math.ceil(errors[2] * 1000) / 1000 == bound
    # The document's own percentages come from times that it had rounded to 0.01 s.
    percent = 100 * np.round(seconds, 2) / round(seconds[0], 2)
    assert percent == pytest.approx([row["percent_of_normal"] for row in table], rel=1e-3)


@holds("dynamic_drag.single_step.*", "dynamic_drag.fit.frame_seconds")
def single_step(golden: Golden) -> None:
    row = golden["dynamic_drag"]["single_step"]
    # The last digit that each figure is printed with is the tolerance. Tables 13 and 14 use dt rounded to
    # 0.001 s.
    dt = golden["dynamic_drag"]["fit"]["frame_seconds"]
    assert row["t1"] - row["t0"] == pytest.approx(dt, abs=2e-6)
    assert drag.apply_drag([0.0, row["v0"], 0.0], 3.0, 0.0, dt)[1] == pytest.approx(row["v1"], abs=5e-7)
    assert row["acceleration"] == pytest.approx(-row["v0"] * body.WALKPLAYER.surfdrag, abs=5e-7)
    assert row["dv"] == pytest.approx(row["acceleration"] * dt, abs=5e-10)
    # Table 13 divides its dv, rounded to -0.0548, by dt and then by each end's velocity.
    slope = round(row["v1"] - row["v0"], 4) / dt
    assert slope / row["v0"] == pytest.approx(row["coefficient_from_v0"], abs=5e-4)
    assert slope / row["v1"] == pytest.approx(row["coefficient_from_v1"], abs=5e-4)


FRICTIONLESS = {"surfdrag": 0.0, "airdrag": 0.0, "staticdrag": 0.0}


@holds("no_drag.*")
def no_drag(golden: Golden) -> None:
    rules = golden["no_drag"]
    for engine in Engine:
        free = run([Phase(0, WALK), Phase(5, Keys())], 10.0, of=changed(**FRICTIONLESS), engine=engine)
        gained = np.diff(free.velocity[:251, 1])
        assert (rules["growth"] == "linear under thrust") is bool(np.allclose(gained, 2.0 * 0.02, rtol=1e-9))
        kept = bool((free.velocity[251:, 1] == free.velocity[251, 1]).all())
        assert kept is rules["kept_without_thrust"]
    assert math.isinf(integration.steady_speed(2.0, 0.0)) is (rules["limit"] == "none")


@holds("only_airdrag.*")
def only_airdrag(golden: Golden) -> None:
    rules = golden["only_airdrag"]
    assert rules == {"non_floor": "air drag acts", "floor": "no drag at all"}
    airy = changed(surfdrag=0.0, staticdrag=0.0)
    for engine in Engine:
        assert drag.coefficients(airy, Support.AIR, engine=engine) == (0.5, 0.0)
        assert drag.coefficients(airy, Support.SURFACE, FLOOR, engine=engine) == (0.0, 0.0)


@holds("static_drag.*")
def static_drag(golden: Golden) -> None:
    rules = golden["static_drag"]
    assert rules["thresholds"] == [0.15, 0.3, 0.6]  # half, normal and double
    assert rules["applies_when"] == "attached to a surface, no acceleration, speed <= staticdrag"
    for engine in Engine:
        for threshold in rules["thresholds"]:
            _stops_at(threshold, engine)
        air = drag.coefficients(changed(staticdrag=rules["infinite"]), Support.AIR, engine=engine)
        assert (air.static != 0) is rules["applies_on_non_floor"]
        _infinite(rules["infinite"], engine)
    assert drag.stops([0.0, 0.3, 0.0], 0.3)


def _stops_at(threshold: float, engine: Engine) -> None:
    of = changed(staticdrag=threshold)
    for surface in (FLOOR, NON_FLOOR):
        speed = run([], 4.0, velocity=(0, 1, 0), of=of, engine=engine, surface=surface).velocity[:, 1]
        if surface == NON_FLOOR:
            assert speed[-1] > 0  # sliding on, with airdrag alone
            continue
        last = int(np.flatnonzero(speed)[-1])
        # The frame that first shows a speed at or below the threshold is the last to move.
        assert speed[last] <= threshold < speed[last - 1]
        assert speed[last] == pytest.approx((1 - 3 * 0.02) ** last, rel=1e-12)


def _infinite(threshold: float, engine: Engine) -> None:
    assert threshold == 999.0
    walk = run([Phase(0, WALK), Phase(2, Keys())], 3.0, of=changed(staticdrag=threshold), engine=engine).velocity[:, 1]
    usual = run([Phase(0, WALK)], 2.0, engine=engine).velocity[:, 1]
    assert (walk[:101] == usual).all()
    assert not walk[101:].any()


@holds("gravity.*")
def gravity_and_mass(golden: Golden) -> None:
    rules = golden["gravity"]
    falls = [run([], 2.0, start=(0, 0, 9), surface=0, of=changed(mass=mass)).position for mass in (0.1, 1000.0)]
    assert bool((falls[0] != falls[1]).any()) is rules["mass_changes_fall"]
    assert falls[0][-1, 2] < falls[0][0, 2] - 1
    light, heavy = (gravity.apply_force(body.Body(mass=mass), (1, 0, 0)).velocity_change[0] for mass in (0.1, 1000.0))
    assert bool(heavy < light) is rules["heavy_is_harder_to_push"]
    assert (light, heavy) == exactly((10.0, 0.001))


@holds("sector_thrust.*")
def sector_thrust(golden: Golden) -> None:
    rules = golden["sector_thrust"]
    assert rules == {"upward_while_attached": "nothing until the jump", "upward_on_non_floor": "at once"}
    lift = World(sector=SectorFlag.THRUST, sector_thrust=(0.0, 0.0, 8.0))
    for engine in Engine:
        jumped = run([Phase(1, Keys(jump=True))], 3.0, world=lift, engine=engine)
        assert jumped.attached[:50].all() and not jumped.velocity[:50].any()
        assert jumped.velocity[-1, 2] > body.WALKPLAYER.jumpspeed
        at_once = run([], 0.1, world=lift, engine=engine, surface=NON_FLOOR)
        assert at_once.velocity[1, 2] == exactly((8.0 - 4.0) * 0.02)
