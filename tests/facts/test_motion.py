"""Motion of templates: figures of the research document, and the simulation as the second opinion."""

from __future__ import annotations

import math
import tomllib

import numpy as np
import pytest

from jktools.engine.body import WALKPLAYER
from jktools.engine.profile import Engine
from jktools.engine.simulation import Simulation
from jktools.engine.thrust import Keys
from jktools.facts.motion import FPS_RANGE, Motion, bodies, gravity_of, motions
from tests.support.levels import ROOT, level_of, two_rooms

PLAYER = (
    "walkplayer none type=player move=physics size=.065 physflags=0x4a4f mass=150 maxthrust=2 surfdrag=3 airdrag=.5 "
    "staticdrag=.3 jumpspeed=1.5 maxvel=1"
)


def motion(line: str = PLAYER, *, accuracy: str = "balanced", engine: Engine = Engine.RESEARCH) -> Motion:
    level = level_of(two_rooms("World templates 4", line))
    name = line.split()[0]
    (held,) = [each for each in bodies(level) if each.owner.name == name]
    return motions([held], gravity_of(level), accuracy=accuracy, engine=engine)[0]


def test_speeds_are_those_of_the_document() -> None:
    found = motion()
    # Thrust over drag: 2 / 3, half of it back and crouched, 0.7 sideways, twice running; "roughly 0.65" in Drawing 1.
    assert found.walk == pytest.approx(2 / 3)
    assert (found.back, found.crouch) == pytest.approx((1 / 3, 1 / 3))
    assert (found.strafe, found.run) == pytest.approx((0.7 * 2 / 3, 4 / 3))
    # 0.3 of the thrust against air drag 0.5: "roughly 1.2" in Drawing 3.
    assert found.air == pytest.approx(1.2)
    # 0.6 of the thrust against four times the air drag.
    assert found.swim == pytest.approx(0.6)


GOLDEN = tomllib.loads((ROOT / "tests/engine/golden.toml").read_text())


def test_the_documents_figures_are_met() -> None:
    """Speeds are thrust over drag; the factors of each gait, and the plots within what they can be read to."""
    body, thrust, steady = (GOLDEN[key] for key in ("walkplayer", "thrust", "steady_speed"))
    words = (f"{key}={body[key]}" for key in ("staticdrag", "surfdrag", "airdrag", "maxthrust"))
    found = motion(f"hero none type=player move=physics physflags=0x4a4f mass=150 maxvel=1 {' '.join(words)}")
    on_floor, in_air = body["maxthrust"] / body["surfdrag"], body["maxthrust"] / body["airdrag"]
    expected = {
        "walk": thrust["forward"]["factor"] * on_floor,
        "back": -thrust["backward"]["factor"] * on_floor,
        "strafe": thrust["strafe_right"]["factor"] * on_floor,
        "run": thrust["run_factor"] * on_floor,
        "crouch": thrust["crouch_factor"] * on_floor,
        "air": thrust["unattached_factor"] * in_air,
    }
    assert {name: getattr(found, name) for name in expected} == pytest.approx(expected)
    for name, plot in (("walk", steady["walk_floor"]), ("air", steady["walk_non_floor"])):
        assert getattr(found, name) == pytest.approx(plot["speed"], abs=plot["tolerance"])
    for bodies_thrust in (
        GOLDEN["actor_thrust"]["powerdroid_maxthrust"],
        GOLDEN["actor_thrust"]["robotsentry_maxthrust"],
    ):
        actor = motion(f"droid none type=actor move=physics physflags=0x4f mass=1 surfdrag=3 maxthrust={bodies_thrust}")
        assert actor.walk == pytest.approx(bodies_thrust / 3)


def test_a_jump_rises_as_the_closed_form_says() -> None:
    found = motion(accuracy="fast")
    # Apex with drag k: v/k - g/k^2 ln(1 + kv/g), v 1.5, g 4, k 0.5.
    assert found.jump_height == pytest.approx([3 - 16 * math.log(1.1875)] * 2, rel=1e-6)
    assert found.crouched_jump_height == pytest.approx([2.1 - 16 * math.log(1.13125)] * 2, rel=1e-6)
    # Document of the engine rules: 0.53 JKU from a walk, 0.93 from a run.
    assert found.jump_reach == pytest.approx([0.532] * 2, abs=1e-3)
    assert found.run_jump_reach == pytest.approx([0.929] * 2, abs=1e-3)


def by_hand(speed: float, start: float, dt: float) -> tuple[float, float]:
    """A jump of walkplayer frame by frame: velocity first, then place; straight on to the ground in the last frame."""
    y = z = top = 0.0
    v, w = start, speed
    while True:
        v, w = v + (0.6 - 0.5 * v) * dt, w + (-4 - 0.5 * w) * dt
        before = (y, z)
        y, z = y + v * dt, z + w * dt
        if z <= 0:
            return top, before[0] + (y - before[0]) * before[1] / (before[1] - z)
        top = max(top, z)


@pytest.mark.parametrize("engine", list(Engine))
def test_a_jump_is_stepped_as_the_engine_does(engine: Engine) -> None:
    found = motion(engine=engine)
    height, reach = by_hand(1.5, 2 / 3, 1 / 50)
    assert (found.jump_height.least, found.jump_reach.least) == pytest.approx((height, reach), rel=1e-6)
    assert found.run_jump_reach.least == pytest.approx(by_hand(1.5, 4 / 3, 1 / 50)[1], rel=1e-6)
    assert found.crouched_jump_height.least == pytest.approx(by_hand(1.05, 1 / 3, 1 / 50)[0], rel=1e-6)
    # Half a frame of the jump's speed is lost at once: 0.25 JKU are 0.235.
    assert height == pytest.approx(0.235, abs=1e-3)


def test_a_jump_depends_on_the_frame_rate() -> None:
    found = motion(accuracy="exact")
    heights, ways = zip(*(by_hand(1.5, 2 / 3, 1 / fps) for fps in FPS_RANGE), strict=True)
    assert found.jump_height == pytest.approx((min(heights), max(heights)), rel=1e-6)
    assert found.jump_reach == pytest.approx((min(ways), max(ways)), rel=1e-6)
    assert min(heights) == heights[FPS_RANGE.index(10.0)] < max(heights) == heights[FPS_RANGE.index(120.0)]


def test_a_crouching_body_has_less_grip_in_the_decompiled_engine() -> None:
    assert motion().crouch == pytest.approx(1 / 3)
    assert motion(engine=Engine.OPENJKDF2).crouch == pytest.approx(0.8 / 3)


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize("gait", ["walk", "run"])
def test_stopping_is_what_the_simulation_does(engine: Engine, gait: str) -> None:
    found = motion(engine=engine)
    speed = getattr(found, gait)
    simulation = Simulation(WALKPLAYER, engine=engine)
    simulation.rest_on_ground()
    simulation.position[2] = simulation.hover_height()
    simulation.velocity = np.array([0.0, speed, 0.0])
    for _ in range(500):
        simulation.tick(Keys(), 1 / 50)
    assert not simulation.velocity.any()
    stop = getattr(found, f"stop_{gait}")
    assert stop.least == stop.most == pytest.approx(float(simulation.position[1]), rel=1e-12)


def test_fast_is_near_and_exact_holds_every_frame_rate() -> None:
    fast, balanced, exact = (motion(accuracy=each) for each in ("fast", "balanced", "exact"))
    # From 2/3 to 0.3 at 3 a second: a ninth of a JKU and more.
    assert fast.stop_walk.least == pytest.approx((2 / 3 - 0.3) / 3)
    assert balanced.stop_walk.least == pytest.approx(fast.stop_walk.least, rel=0.1)
    assert exact.stop_walk.least <= balanced.stop_walk.least <= exact.stop_walk.most
    assert exact.stop_walk.least < exact.stop_walk.most
    assert 50.0 in FPS_RANGE


def test_an_actor_has_no_keys() -> None:
    found = motion("guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=.8 surfdrag=2 airdrag=.5")
    assert found.walk == found.back == pytest.approx(0.4)
    assert all(math.isnan(x) for x in (found.run, found.crouch, found.air, found.run_jump_reach.least))
    assert found.swim == pytest.approx(0.4)
    assert found.jump_height == (0, 0)


def ai_speed(thrust: float, k: float, dt: float) -> float:
    """What an AI comes to that adds its push before the frame's drag is taken."""
    speed = 0.0
    for _ in range(10_000):
        speed = (speed + thrust * dt) * (1 - k * dt)
    return speed


def test_what_takes_no_floor_flies_and_does_nothing_else() -> None:
    """The game's robot sentry: 0.8 against an air drag of 2; without the flag that it flies by, not even that."""
    sentry = "type=actor move=physics maxthrust=.8 surfdrag=3 airdrag=2 mass=30 jumpspeed=1.5"
    found = motion(f"sentry none {sentry} physflags=0x6a06")
    assert found.air == pytest.approx(0.4)
    on_floors = ("walk", "back", "strafe", "run", "crouch")
    assert all(math.isnan(getattr(found, name)) for name in on_floors)
    ways = (found.stop_walk, found.jump_height, found.jump_reach)
    assert all(math.isnan(end) for way in ways for end in way)
    assert math.isnan(motion(f"sentry none {sentry} physflags=0x4a06").air)
    # A floor's flag makes a walker of it, and it flies still.
    both = motion(f"sentry none {sentry} physflags=0x6a46")
    assert (both.walk, both.air) == pytest.approx((0.8 / 3, 0.4))


def test_an_ai_pushes_before_the_drag_in_the_decompiled_engine() -> None:
    line = "guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=.8 surfdrag=2 airdrag=.5"
    found = motion(line, engine=Engine.OPENJKDF2)
    assert found.walk == pytest.approx(ai_speed(0.8, 2, 1 / 50)) == pytest.approx(0.384)
    assert found.swim == pytest.approx(ai_speed(0.8, 2, 1 / 50))


def test_what_nothing_bounds_is_infinite() -> None:
    found = motion("slider none type=player move=physics physflags=0x42 maxthrust=2 jumpspeed=1")
    assert math.isinf(found.walk)
    assert math.isinf(found.stop_walk.least)
    assert math.isinf(found.jump_height.least)  # no mass and no gravity flag
    assert math.isinf(found.jump_reach.least)


def test_a_body_without_thrust_stays() -> None:
    found = motion("block none type=player move=physics physflags=0x41 mass=1 maxthrust=2 surfdrag=3")
    assert (found.walk, found.stop_walk.least) == (0, 0)


def test_speed_is_capped_only_by_the_decompiled_engine() -> None:
    line = PLAYER.replace("maxvel=1", "maxvel=.02")
    # At most .02 JKU/s in a tick of 1/50 s is a thrust of 1.
    assert motion(line, engine=Engine.OPENJKDF2).walk == pytest.approx(1 / 3)
    assert motion(line).walk == pytest.approx(2 / 3)
