"""The rules of motion one by one, where golden.toml is silent: the decompiled engine's figures, by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from jktools.engine import attachment, drag, gravity, hover, integration, jump, reattach, thrust
from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.flags import PhysicsFlag, SectorFlag, SurfaceFlag
from jktools.engine.ground import SURFACES
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.reattach import Rise
from jktools.engine.simulation import Phase
from jktools.engine.thrust import Keys, NotStatedError, Support, player_thrust
from tests.engine.motion_checks import changed, exactly, run

OPEN = Engine.OPENJKDF2


def test_extra_speed_before_or_after_the_direction() -> None:
    back, left = Keys(forward=-1), Keys(strafe=-1)
    assert player_thrust(WALKPLAYER, back, extra_speed=1.0) == exactly([0.0, -2.0, 0.0])
    assert player_thrust(WALKPLAYER, back, extra_speed=1.0, engine=OPEN) == exactly([0.0, -1.5, 0.0])
    assert player_thrust(WALKPLAYER, left, extra_speed=1.0) == exactly([-2.4, 0.0, 0.0])
    assert player_thrust(WALKPLAYER, left, extra_speed=1.0, engine=OPEN) == exactly([-2.1, 0.0, 0.0])


def test_backward_in_the_air() -> None:
    back = Keys(forward=-1)
    assert player_thrust(WALKPLAYER, back, Support.AIR)[1] == exactly(-0.3)
    assert player_thrust(WALKPLAYER, back, Support.AIR, engine=OPEN)[1] == exactly(-0.6)


def test_diagonal_and_slow() -> None:
    both = Keys(forward=1, strafe=1, run=True, slow=True)
    for engine in Engine:
        assert player_thrust(WALKPLAYER, both, engine=engine) == exactly([1.4, 2.0, 0.0])


@pytest.mark.parametrize("name", ["deep-water", "very-deep-water"])
def test_deep_water(name: str) -> None:
    walk = Keys(forward=1)
    assert player_thrust(WALKPLAYER, walk, surface=SURFACES[name], engine=OPEN)[1] == exactly(1.0)
    with pytest.raises(NotStatedError, match="illegible"):
        player_thrust(WALKPLAYER, walk, surface=SURFACES[name])


def test_under_water() -> None:
    swim = player_thrust(WALKPLAYER, Keys(forward=-1, strafe=1, jump=True), Support.WATER, engine=OPEN)
    assert swim == exactly([2 * 0.7 * 0.6, -2 * 0.6, 2 * 0.5 * 0.6])
    assert player_thrust(WALKPLAYER, Keys(crouch=True), Support.WATER)[2] == exactly(-0.6)
    assert drag.coefficients(WALKPLAYER, Support.WATER) == (2.0, 0.0)
    assert gravity.gravity_acceleration(changed(buoyancy=0.25), Support.WATER) == exactly(-1.0)
    assert gravity.gravity_acceleration(changed(buoyancy=0.25), Support.WATER, at_water_surface=True) == 0


def test_flyers_keep_their_thrust() -> None:
    flyer = changed(physflags=WALKPLAYER.physflags | PhysicsFlag.FLIES)
    assert player_thrust(flyer, Keys(forward=1), Support.AIR, engine=OPEN)[1] == exactly(2.0)
    assert player_thrust(flyer, Keys(forward=1), Support.AIR)[1] == exactly(0.6)


def test_friction_scales_acceleration_not_thrust() -> None:
    given = {"attached": True, "engine": OPEN}
    ice = drag.friction(SURFACES["icy"])
    assert thrust.thrust_acceleration([0, 2, 0], friction=ice, **given)[1] == exactly(0.6)
    assert thrust.thrust_acceleration([0, 2, 0], friction=ice, crouching=True, **given)[1] == exactly(1.6)
    assert thrust.thrust_acceleration([0, 2, 0], friction=ice)[1] == exactly(2.0)


def test_one_tick_adds_at_most_maxvel() -> None:
    # 4 JKU/s^2 for 0.5 s would add 2 JKU/s: a maxvel of 1 halves it, in its direction; shorter ticks are free.
    assert thrust.capped([0.0, 2.4, 3.2], 1.0, 0.5) == exactly([0.0, 1.2, 1.6])
    assert thrust.capped([0.0, 2.4, 3.2], 1.0, 0.25) == exactly([0.0, 2.4, 3.2])
    assert not thrust.capped([0.0, 2.0, 0.0], 0.0, 0.02).any()
    walked = {
        engine: run([Phase(0, Keys(forward=1))], 1.0, of=changed(maxvel=0.0), engine=engine).position[-1, 1]
        for engine in Engine
    }
    assert walked[Engine.RESEARCH] > 0 and walked[OPEN] == 0


def test_actors_walk_level_and_fly_free() -> None:
    assert thrust.actor_acceleration(Body(maxthrust=0.8), (0, 0, 1)) == exactly([0, 0, 0])
    climb = thrust.actor_acceleration(Body(maxthrust=0.8), (0, 3, 4), three_dimensional=True, move_speed=0.5)
    assert climb == exactly([0, 0.24, 0.32])


def test_actors_walk_at_the_players_speeds() -> None:
    """ "A very similar result to the player's movement": the same maxthrust gives the same steady speed."""
    x, v = np.zeros(3), np.zeros(3)
    push = thrust.actor_acceleration(WALKPLAYER, (0, -1, 0))
    for _ in range(500):
        x, v = integration.step(Scheme.ENGINE, x, v, push, WALKPLAYER.surfdrag, 0.02)
    assert v == pytest.approx([0, -2 / 3, 0])


@pytest.mark.parametrize(
    ("surface", "expected"),
    [("floor", (3.0, 0.3)), ("icy", (0.9, 0.0)), ("very-icy", (0.75, 0.0)), ("deep-water", (3.0, 0.3))],
)
def test_drag_on_surfaces(surface: str, expected: tuple[float, float]) -> None:
    flags = SURFACES[surface]
    assert drag.coefficients(WALKPLAYER, Support.SURFACE, flags, engine=OPEN) == exactly(expected)
    assert drag.coefficients(WALKPLAYER, Support.SURFACE, flags) == exactly((3.0, expected[1]))


def test_friction_is_raised_for_moving_but_not_for_turning() -> None:
    assert [drag.friction(SURFACES[name]) for name in ("floor", "icy", "very-icy")] == [1.0, 0.3, 0.25]
    assert [drag.friction(SURFACES[name], turning=True) for name in ("floor", "icy", "very-icy")] == [1.0, 0.3, 0.1]


def test_what_switches_static_drag_off() -> None:
    for engine in Engine:
        for reason in ({"thrusting": True}, {"sector_thrust": True}):
            assert drag.coefficients(WALKPLAYER, Support.SURFACE, 0x5, engine=engine, **reason) == (3.0, 0.0)
        assert drag.coefficients(WALKPLAYER, Support.SURFACE, 0x5, engine=engine, force_applied=True) == (
            0.0,
            0.0,
        )
    slippery = changed(surfdrag=0.0)
    assert drag.coefficients(slippery, Support.SURFACE, 0x5, engine=OPEN) == (0.0, 0.0)
    assert drag.coefficients(slippery, Support.SURFACE, 0x5) == (0.0, 0.3)


def test_static_threshold_at_or_below() -> None:
    speeds = np.array([[0.0, 0.3, 0.0], [0.0, math.nextafter(0.3, 0), 0.0], [0.0, math.nextafter(0.3, 1), 0.0]])
    assert drag.stops(speeds, 0.3).tolist() == [True, True, False]
    assert drag.stops(speeds, 0.3, OPEN).tolist() == [False, True, False]
    assert not drag.stops([0.0, 0.0, 0.0], 0.0)


def test_rest_threshold() -> None:
    crawl = [0.0, 9e-4, 2e-5]
    assert drag.rest(crawl).tolist() == [0.0, 0.0, 0.0]
    assert drag.rest(crawl, OPEN).tolist() == crawl
    assert drag.rest([1.0, 9e-6, 0.0], OPEN).tolist() == [1.0, 0.0, 0.0]
    assert drag.rest([1.0, 9e-6, 0.0]).tolist() == [1.0, 9e-6, 0.0]


def test_drag_overshoots_in_research_only() -> None:
    assert drag.apply_drag([0.0, 1.0, 0.0], 999.0, 0.0, 0.02)[1] == exactly(-18.98)
    assert drag.apply_drag([0.0, 1.0, 0.0], 999.0, 0.0, 0.02, OPEN)[1] == 0.0


def test_decay_frames() -> None:
    # 30 frames a second to 1e-5, counted in the decompiled engine's own arithmetic: 110 frames of 1/30 s.
    assert drag.decay_frames(3.0, 1 / 30, engine=OPEN) == 110
    v, frames = 1.0, 0
    while v >= 1e-5:
        v, frames = v - v * 0.1, frames + 1
    assert frames == 110
    assert drag.decay_frames([0.0, 50.0], 0.02).tolist() == [math.inf, 1.0]
    assert drag.decay_frames(51.0, 0.02, engine=OPEN) == 1.0
    assert math.isnan(drag.decay_frames(51.0, 0.02))


def test_gravity_by_flags() -> None:
    assert gravity.gravity_acceleration(WALKPLAYER) == -4.0
    assert gravity.gravity_acceleration(changed(physflags=0x40001)) == -2.0
    for weightless in (changed(mass=0.0), changed(physflags=0)):
        assert gravity.gravity_acceleration(weightless) == 0.0
    assert gravity.gravity_acceleration(WALKPLAYER, sector=SectorFlag.NO_GRAVITY) == 0.0
    assert gravity.gravity_acceleration(WALKPLAYER, Support.SURFACE) == 0.0


@pytest.mark.parametrize(("friction", "part"), [(1.0, 0.2), (0.3, 0.7), (0.1, 0.8)])
def test_slopes_pull_players(friction: float, part: float) -> None:
    assert gravity.slope_acceleration(WALKPLAYER, friction, moving=True) == exactly(-4.0 * part)
    assert gravity.slope_acceleration(changed(player=False), friction, moving=True) == 0.0
    standing = gravity.slope_acceleration(WALKPLAYER, friction, moving=False)
    assert standing == exactly(0.0 if friction >= 0.8 else -4.0 * part)


def test_forces() -> None:
    assert gravity.apply_force(Body(mass=2.0), (0, 0, 1.0)).detaches is False
    assert gravity.apply_force(Body(mass=2.0), (0, 0, 1.01)).detaches is True
    none = gravity.apply_force(Body(), (5, 5, 5))
    assert not none.velocity_change.any() and not none.skips_drag


def test_sector_thrust_on_a_slope() -> None:
    normal = (0.0, -0.6, 0.8)
    felt = gravity.sector_acceleration(WALKPLAYER, (0, 1, 2), Support.SURFACE, normal=normal)
    assert felt @ np.array(normal) == pytest.approx(0, abs=1e-15)
    assert felt == exactly([0.0, 1.6, 1.2])
    assert gravity.sector_acceleration(WALKPLAYER, (0, 1, 2), Support.AIR) == exactly([0, 1, 2])
    immune = changed(physflags=PhysicsFlag.NO_SECTOR_THRUST)
    assert not gravity.sector_acceleration(immune, (0, 1, 2), Support.AIR).any()


def test_sector_thrust_lifts_light_bodies() -> None:
    for thrust_z, mass, lifted in ((8.0, 150.0, False), (8.0, 2.0, False), (8.1, 2.0, True)):
        assert gravity.sector_thrust_detaches(changed(mass=mass), (0, 0, thrust_z), engine=OPEN) is lifted
        assert not gravity.sector_thrust_detaches(changed(mass=mass), (0, 0, thrust_z))


def test_jump_without_drag_is_a_parabola() -> None:
    top = jump.apex(1.5)
    assert (top.height, top.seconds) == exactly((1.5**2 / 8, 1.5 / 4))
    assert jump.flight_seconds(1.5) == pytest.approx(0.75, rel=1e-14)
    assert jump.flight_seconds(1.5, -0.2) == pytest.approx((1.5 + math.sqrt(2.25 - 1.6)) / 4, rel=1e-13)
    assert math.isnan(jump.flight_seconds(1.5, -0.3))
    assert jump.landing_speed(2.0, 1.5) == pytest.approx(math.sqrt(2.25 + 16), rel=1e-13)


def test_jump_with_drag() -> None:
    top = jump.apex(1.5, 0.5)
    assert top.seconds == pytest.approx(math.log(1 + 0.5 * 1.5 / 4) / 0.5, rel=1e-14)
    assert top.height == pytest.approx(1.5 / 0.5 - 4 / 0.25 * math.log(1.1875), rel=1e-12)
    assert jump.jump_speed(WALKPLAYER, crouching=True) == exactly(1.05)
    # Landing on the apex itself, and a hair above it.
    assert jump.flight_seconds(1.5, -top.height, 0.5) == pytest.approx(float(top.seconds), rel=1e-6)
    assert math.isnan(jump.flight_seconds(1.5, -top.height * (1 + 1e-9), 0.5))


def test_jump_agrees_with_a_fine_simulation() -> None:
    x = v = np.array([0.0, 0.0])
    v, n, dt = np.array([2 / 3, 1.5]), 0, 1e-5
    x = np.zeros(2)
    while x[1] > -0.3 or v[1] > 0:
        v = v + dt * (np.array([0.6, -4.0]) - 0.5 * v)
        x, n = x + dt * v, n + 1
    assert jump.flight_seconds(1.5, 0.3, 0.5) == pytest.approx(n * dt, abs=5e-5)
    assert jump.reach(WALKPLAYER, 2 / 3, 0.3, steering=0.6) == pytest.approx(x[0], abs=5e-5)
    assert jump.landing_speed(0.3, 1.5, 0.5) == pytest.approx(-v[1], abs=1e-4)


@pytest.mark.parametrize(
    ("speed", "damage"), [(2.5, 0.0), (2.6, 0.0), (2.649, 0.0), (2.65, 1.0125), (3.5, 45.0), (-9.0, 0.0)]
)
def test_fall_damage(speed: float, damage: float) -> None:
    assert jump.fall_damage(speed) == pytest.approx(damage, rel=1e-12)
    assert jump.fall_damage(speed, SurfaceFlag.NO_FALL_DAMAGE) == 0.0


def test_who_takes_which_floor() -> None:
    stick, wall = PhysicsFlag.FLOOR_STICK, PhysicsFlag.WALL_STICK
    assert attachment.takes_floor(stick, SurfaceFlag.FLOOR)
    assert not attachment.takes_floor(stick, SurfaceFlag.COLLISION)
    assert not attachment.takes_floor(stick, SurfaceFlag.FLOOR, normal_z=-0.1)
    assert attachment.takes_floor(wall, SurfaceFlag.COLLISION, normal_z=-1.0)
    assert not attachment.takes_floor(0, SurfaceFlag.FLOOR)
    assert attachment.takes_face(stick, 0x40, 0.6) and not attachment.takes_face(stick, 0x40, 0.59)
    assert not attachment.takes_face(stick, 0, 1.0)
    assert attachment.takes_face(wall, 0, -1.0)


@pytest.mark.parametrize(
    ("z", "attached", "moved", "research", "engine"),
    [
        (0.0, True, True, True, True),
        (0.0, True, False, False, False),
        (9.0, True, True, True, True),
        (-2.0, False, True, False, True),
        (0.2, False, True, False, True),
        (-2.1, False, True, False, False),
        (0.3, False, True, False, False),
        (0.0, False, False, False, False),
    ],
)
def test_who_looks_for_a_floor(z: float, attached: bool, moved: bool, research: bool, engine: bool) -> None:
    for profile, expected in ((Engine.RESEARCH, research), (OPEN, engine)):
        looks = attachment.looks_for_floor(
            PhysicsFlag.FLOOR_STICK, [0, 0, z], attached=attached, moved=moved, engine=profile
        )
        assert looks is expected


def test_events() -> None:
    table = {
        (True, False, False): Event.STAYS,
        (False, False, False): Event.NOTHING,
        (True, True, True): Event.STAYS,
        (False, True, True): Event.ATTACHES,
        (True, True, False): Event.DETACHES,
        (False, True, False): Event.NOTHING,
    }
    for (attached, searched, found), expected in table.items():
        assert attachment.event(attached=attached, searched=searched, found=found) is expected


def test_hover_heights() -> None:
    inserts = [0.0, 0.06, 0.068, 0.12, 0.4]
    assert hover.hover_height(inserts, 0.065) == exactly([0.065, 0.065, 0.068, 0.12, 0.4])
    assert hover.hover_height(inserts, 0.065, engine=OPEN) == exactly([0.07, 0.07, 0.07, 0.12, 0.4])
    assert hover.hover_height(inserts, 0.065, height=0.2, engine=OPEN) == exactly([0.2] * 5)
    assert hover.hover_height(inserts, 0.065, height=0.2, crouching=True, engine=OPEN) == exactly([0.075] * 5)


def test_settling_is_linear_and_stops() -> None:
    assert hover.settle([0.1, -0.1, 0.004, 0.0], 0.02) == exactly([0.09, -0.09, 0.0, 0.0])
    assert hover.settling_seconds([-0.1, 0.25]) == exactly([0.2, 0.5])


def test_reattach_distances() -> None:
    walk = (WALKPLAYER.insert_offset_z, WALKPLAYER.movesize)
    assert reattach.reattach_distance(*walk, crouching=True, engine=OPEN) == exactly(2 * 0.120114 - 0.01)
    assert reattach.reattach_distance(*walk, crouching=True) == exactly(0.13)
    assert reattach.reattach_distance(*walk, height=0.3, engine=OPEN) == exactly(0.365)
    assert reattach.search_distance(*walk, engine=OPEN) == exactly(2 * 0.120114)
    assert reattach.search_distance(*walk, sticks=False, engine=OPEN) == exactly(1.1 * 0.120114)
    assert reattach.search_distance(*walk, attached=False, engine=OPEN) == exactly(0.07)
    assert reattach.taken_at_edge([0.12, 0.121], *walk).tolist() == [True, False]


def test_steps_up() -> None:
    rises = [0.05, 0.056, 0.12, 0.121]
    classes = reattach.step_up(rises, WALKPLAYER.insert_offset_z, WALKPLAYER.movesize)
    assert classes.tolist() == [Rise.STEP, Rise.LIP, Rise.LIP, Rise.WALL]


def test_stairs_lag() -> None:
    # 0.1 down each 0.1 JKU at 2/3 JKU/s: 0.15 s a tread sinks 0.075, so the lag grows by 0.025 a step.
    flight = reattach.walk_down([0.1] * 6, 0.1, 2 / 3, 0.185114)
    assert flight.lag == exactly([0.0, 0.025, 0.05, 0.075, 0.1, 0.125])
    assert flight.seamless.tolist() == [True, True, True, True, False, False]
    slow = reattach.walk_down([0.1] * 6, 0.1, 0.5, 0.185114)
    assert slow.lag == exactly([0.0] * 6) and slow.seamless.all()
    # One step that is too deep ends the flight, whatever follows.
    assert reattach.walk_down([0.2, 0.0], 9.0, 1.0, 0.185).seamless.tolist() == [False, False]
    assert reattach.walk_down([0.1], 0.1, 0.0, 0.185).lag.tolist() == [0.0]
