"""The simulation against the closed forms, the stated limits, and the document's experiments."""

from __future__ import annotations

import math

import numpy as np
import pytest

from jktools.engine import drag, jump, reattach
from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER
from jktools.engine.flags import SectorFlag
from jktools.engine.ground import SURFACES, Contact, Floor, Steps, Tread, Vector
from jktools.engine.integration import Scheme, closed_form
from jktools.engine.profile import Engine
from jktools.engine.simulation import History, Phase, Simulation, World, simulate
from jktools.engine.thrust import Keys
from tests.engine.motion_checks import RUN, WALK, changed, exactly, run

OPEN = Engine.OPENJKDF2
WATER = World(sector=SectorFlag.UNDERWATER)


@pytest.mark.parametrize("engine", Engine)
def test_walk_follows_the_closed_form(engine: Engine) -> None:
    walk = run([Phase(0, WALK)], 2.0, dt=1e-3, engine=engine)
    true = closed_form(0.0, 0.0, 2.0, 3.0, walk.time)
    assert walk.velocity[:, 1] == pytest.approx(true.velocity, abs=1.2e-3)
    assert walk.position[:, 1] == pytest.approx(true.position, abs=1.2e-3)
    assert not walk.position[:, 0].any() and (walk.position[:, 2] == walk.position[0, 2]).all()


@pytest.mark.parametrize("engine", Engine)
def test_ticks_are_the_rules(engine: Engine) -> None:
    """A stop on the floor is `apply_drag` again and again, whatever else the simulation does."""
    stop = run([], 1.0, velocity=(0, 1, 0), engine=engine)
    v = np.array([0.0, 1.0, 0.0])
    for i in range(51):
        assert stop.velocity[i] == pytest.approx(v, rel=1e-13)
        v = drag.apply_drag(v, 3.0, 0.3, 0.02, engine)


@pytest.mark.parametrize("engine", Engine)
def test_jump_rises_and_returns(engine: Engine) -> None:
    leap = run([Phase(0, Keys(jump=True)), Phase(0.5, Keys())], 2.0, dt=1e-3, engine=engine)
    top = jump.apex(1.5, 0.5)
    height = leap.position[:, 2] - leap.position[0, 2]
    assert height.max() == pytest.approx(float(top.height), abs=2e-3)
    assert leap.time[height.argmax()] == pytest.approx(float(top.seconds), abs=2e-3)
    assert [i.event for i in leap.incidents] == [Event.DETACHES, Event.ATTACHES]
    assert leap.position[-1, 2] == exactly(leap.position[0, 2])


def test_crouched_jump_is_lower() -> None:
    crouched = Keys(jump=True, crouch=True)
    leap = run([Phase(1, Keys(crouch=True)), Phase(2, crouched), Phase(2.2, Keys())], 4.0, dt=1e-3)
    start = leap.position[2000, 2]
    assert start == exactly(0.065)
    assert leap.position[:, 2].max() - start == pytest.approx(float(jump.apex(1.05, 0.5).height), abs=1e-3)


@pytest.mark.parametrize("engine", Engine)
def test_fall_damage_on_landing(engine: Engine) -> None:
    fall = run([], 3.0, dt=1e-3, start=(0, 0, 3.0), engine=engine)
    (landing,) = (i for i in fall.incidents if i.event is Event.ATTACHES)
    drop = 3.0 - WALKPLAYER.movesize
    speed = float(jump.landing_speed(drop, 0.0, 0.5))
    assert landing.damage == pytest.approx(float(jump.fall_damage(speed)), rel=0.01)
    assert landing.damage > 1


def test_speeds_by_surface() -> None:
    """Steady speeds worked by hand: thrust x friction over drag x friction is the same on ice, only slower to reach."""
    steady = {"floor": 2 / 3, "icy": 2 / 3, "very-icy": 2 / 3, "non-floor": 1.2, "deep-water": 1 / 3}
    for name, speed in steady.items():
        walked = run([Phase(0, WALK)], 30.0, surface=SURFACES[name], engine=OPEN)
        assert walked.velocity[-1, 1] == pytest.approx(speed, rel=1e-5), name
    slow = run([Phase(0, WALK)], 1.0, surface=SURFACES["icy"], engine=OPEN).velocity[-1, 1]
    assert slow == pytest.approx(2 / 3 * (1 - (1 - 0.9 * 0.02) ** 50), rel=1e-9)


def test_crouch_walk_feels_less_friction_in_the_engine() -> None:
    crouch = Keys(forward=1, crouch=True)
    assert run([Phase(0, crouch)], 9.0, engine=OPEN).velocity[-1, 1] == pytest.approx(1.0 * 0.8 / 3)
    assert run([Phase(0, crouch)], 9.0).velocity[-1, 1] == pytest.approx(1.0 / 3)


def test_swimming() -> None:
    swum = run([Phase(0, WALK)], 20.0, start=(0, 0, 5), world=WATER, engine=OPEN)
    assert swum.velocity[-1] == pytest.approx([0, 2 * 0.6 / 2.0, 0])


def test_a_force_spares_one_tick_of_drag() -> None:
    body = Simulation(WALKPLAYER, engine=OPEN)
    body.rest_on_ground()
    body.push((0.0, 150.0, 0.0))
    history = simulate(body, [], 0.1, 0.02)
    assert history.velocity[:3, 1] == exactly([1.0, 1.0, 0.94])
    body.push((0.0, 0.0, 151.0))
    assert body.floor is None


def crosses(depth: float, insert: float, engine: Engine) -> History:
    # 0.05 JKU/s: "gingerly". Height errors from the way there would add to the depth.
    slow = changed(insert_offset_z=insert, maxthrust=0.15)
    return run([Phase(0, WALK)], 4.0, of=slow, start=(0, -0.05, 0), ground=Steps.pit(depth), engine=engine)


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("insert", [0.01, 0.06, 0.120114, 0.2, 0.4])
def test_changeover_comes_out_of_the_search(insert: float, engine: Engine) -> None:
    """The ray, the sphere and the settling give the limit that `reattach_distance` states, to 1e-6 JKU."""
    limit = float(reattach.reattach_distance(insert, 0.065, engine=engine))
    assert crosses(limit - 1e-6, insert, engine).attached.all()
    assert not crosses(limit + 1e-6, insert, engine).attached.all()


def test_deep_steps_are_taken_late_in_the_engine() -> None:
    """Up to H at the edge, beyond it movesize past the edge, where the sphere lets go."""
    for depth, expected in ((0.12, 0.0), (0.13, 0.065)):
        crossed = crosses(depth, 0.120114, OPEN)
        sinking = int(np.flatnonzero(np.diff(crossed.position[:, 2]))[0])
        assert crossed.position[sinking, 1] == pytest.approx(expected, abs=0.003)


def test_narrow_gaps_go_unnoticed() -> None:
    for width, falls in ((0.12, False), (0.14, True)):
        gap = Steps((Tread(-1, 0.0), Tread(0.0, -5.0), Tread(width, 0.0)))
        slow = changed(maxthrust=0.15)
        crossed = run([Phase(0, WALK)], 8.0, of=slow, start=(0, -0.05, 0), ground=gap, engine=OPEN)
        assert bool(crossed.attached.all()) is not falls


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize(("keys", "thrust"), [(WALK, 2.0), (RUN, 4.0)])
def test_stairs_agree_with_the_lag_formula(engine: Engine, keys: Keys, thrust: float) -> None:
    drop, tread, steps = 0.08, 0.1, 8
    flight = Steps((Tread(-9.0, 0.0), *(Tread(i * tread, -(i + 1) * drop) for i in range(steps))))
    limit = float(reattach.reattach_distance(0.120114, 0.065, engine=engine))
    late = {"edge_limit": 0.120114, "overhang": 0.065} if engine is OPEN else {}
    foreseen = reattach.walk_down([drop] * steps, tread, thrust / 3, limit, **late)
    walked = run([Phase(0, keys)], 4.0, dt=1e-3, start=(0, -1.5, 0), ground=flight, engine=engine)
    fell = walked.position[~walked.attached, 1]
    foreseen_fall = None if foreseen.seamless.all() else int(np.argmin(foreseen.seamless))
    assert (len(fell) == 0) is (foreseen_fall is None)
    if foreseen_fall is not None:
        edge = foreseen_fall * tread + late.get("overhang", 0.0)
        # A lag above the hover height lets the sphere go while its edge is still within movesize.
        assert edge - (5e-3 if late else 1e-6) <= fell[0] <= edge + 3e-3


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("keys", [WALK, RUN])
@pytest.mark.parametrize(
    ("rise", "climbs"),
    [(0.05, True), (0.055, True), (0.06, True), (0.08, False), (0.1, False), (0.125, False), (0.3, False)],
)
def test_steps_up(rise: float, climbs: bool, keys: Keys, engine: Engine) -> None:
    kerb = Steps((Tread(-1.0, 0.0), Tread(0.5, rise)))
    walked = run([Phase(0, keys)], 3.0, ground=kerb, engine=engine)
    assert bool(walked.position[-1, 1] > 1.0) is climbs
    assert walked.attached.all()
    if climbs:
        assert walked.position[-1, 2] == exactly(0.120114 + rise)
    # Against a lip it hangs a little above its hover height, held by the edge; never by as much as the rise.
    assert walked.position[-1, 2] < 0.120114 + rise + 1e-9


class Slope:
    """A plane through the origin that rises along y."""

    def __init__(self, degrees: float, surface: int) -> None:
        angle = math.radians(degrees)
        self.normal, self.surface = (0.0, -math.sin(angle), math.cos(angle)), surface

    def floor_below(self, position: Vector, reach: float, radius: float, required: int) -> Floor | None:
        x, y, z = position
        height = -y * self.normal[1] / self.normal[2]
        down = z - height - radius / self.normal[2]
        wanted = self.surface & required == required and down <= reach
        return Floor((x, y, height), self.surface, self.normal) if wanted else None

    def sweep(self, position: Vector, motion: Vector, radius: float) -> Contact | None:
        above, into = float(np.dot(position, self.normal)) - radius, -float(np.dot(motion, self.normal))
        if into <= 0 or above > into or above < -1e-9:
            return None
        distance = max(0.0, above) / into * math.hypot(*motion)
        return Contact(distance, self.normal, Floor((0.0, 0.0, 0.0), self.surface, self.normal))


def on_slope(degrees: float, surface: str, keys: Keys, engine: Engine, **parameters: float) -> History:
    body = Simulation(changed(**parameters), Slope(degrees, SURFACES[surface]), engine=engine)
    body.rest_on_ground()
    return simulate(body, [Phase(0, keys)], 20.0, 0.02)


def test_ice_slides_down_slopes_in_the_engine() -> None:
    """Gravity's part 1 - friction along the slope, against surfdrag times friction: by hand."""
    for degrees in (10.0, 30.0):
        slid = on_slope(degrees, "icy", Keys(strafe=1), OPEN)
        assert slid.attached.all()
        downhill = 4.0 * 0.7 * math.sin(math.radians(degrees)) / (3.0 * 0.3)
        assert np.hypot(*slid.velocity[-1, 1:]) == pytest.approx(downhill, rel=1e-4)
        assert slid.velocity[-1, 2] < 0
    assert not on_slope(30.0, "icy", Keys(), Engine.RESEARCH).velocity.any()


def test_standing_on_a_slope() -> None:
    for engine in Engine:
        stood = on_slope(30.0, "floor", Keys(), engine)
        assert (stood.position == stood.position[0]).all()


def test_upright_bodies_measure_height_along_z() -> None:
    for flags, along in ((0x4A4F, 0.5), (0x4A4F & ~0x800, 1.0)):
        walked = on_slope(60.0, "floor", Keys(strafe=1), Engine.RESEARCH, physflags=flags)
        from_plane = walked.position[-1] @ np.array(Slope(60.0, 0).normal)
        assert from_plane == pytest.approx(0.120114 * along, abs=1e-9)


def test_schemes_converge_to_one_walk() -> None:
    true = float(closed_form(0.0, 0.0, 2.0, 3.0, 1.0).position)
    for scheme in Scheme:
        walked = simulate(_standing(scheme), [Phase(0, WALK)], 1.0, 2e-3).position[-1, 1]
        assert walked == pytest.approx(true, abs=2e-3 * 2 / 3), scheme  # a tick's way at the steady speed


def _standing(scheme: Scheme) -> Simulation:
    body = Simulation(WALKPLAYER, scheme=scheme)
    body.rest_on_ground()
    return body


def test_same_input_same_rows() -> None:
    one, two = (run([Phase(0, RUN), Phase(1, Keys(jump=True))], 3.0, ground=Steps.pit(0.3)) for _ in range(2))
    assert one.position.tobytes() == two.position.tobytes() and one.incidents == two.incidents


def test_phases_of_one_moment_all_count() -> None:
    leap = run([Phase(0.5, Keys(jump=True)), Phase(0.5, WALK)], 1.0)
    assert leap.incidents[0].event is Event.DETACHES and leap.velocity[-1, 1] > 0


def test_refuses_endless_histories() -> None:
    with pytest.raises(ValueError, match="more than 10000000 ticks"):
        simulate(Simulation(WALKPLAYER), [], 1e30, 0.02)


def test_refuses_nonsense() -> None:
    for phases, dt in (([Phase(1), Phase(0)], 0.02), ([], 0.0), ([], math.nan)):
        with pytest.raises(ValueError, match="dt must be positive"):
            simulate(Simulation(WALKPLAYER), phases, 1.0, dt)
