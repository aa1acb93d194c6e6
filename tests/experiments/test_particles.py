"""The document's experiments on particles: each +partest as the compiled level holds it, under the engine's rules.

The random numbers are our own, so what is asserted holds for every seed that is tried.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from fixtures.smithdev.chambers.particle_room import CELS, TRIP, VARIANTS
from jktools.engine import particles
from jktools.engine.particle_spawn import spawn
from jktools.engine.particle_template import ParticleTemplate
from jktools.engine.particles import ParticleTrack
from tests.experiments.living import Thing
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, Experiment

ROOM = "particle_room"
RULES: dict[str, Any] = GOLDEN["particles"]
SEEDS = range(20)
COUNT = 128
"""Of the document's first +partest, and of all that follow it."""


def row_of(smithdev: Experiment, name: str) -> int:
    """The row of a template in the section of particles."""
    held, templates = smithdev.level.particles, smithdev.level.templates
    assert held is not None and templates is not None
    names = {int(s): smithdev.level.strings[n] for s, n in zip(templates.source, templates.name, strict=True)}
    return next(row for row, source in enumerate(held.template) if names[int(source)] == name)


def cloud(smithdev: Experiment, variant: str) -> ParticleTemplate:
    """A +partest, from the compiled level alone."""
    return of_row(smithdev, row_of(smithdev, smithdev.about(ROOM)["variants"][variant]))


def of_row(smithdev: Experiment, row: int) -> ParticleTemplate:
    held = smithdev.level.particles
    assert held is not None
    shape = {key: float(getattr(held, key)[row]) for key in
             ("range", "minsize", "maxthrust", "elementsize", "pitchrange", "yawrange")}  # fmt: skip
    return ParticleTemplate(
        count=int(held.spawned[row]), timer=int(held.timer_ms[row]) / 1000, typeflags=int(held.flags[row]),
        rate=10.0 * int(held.lost_a_step[row]), cels=int(held.cels[row]), **shape,
    )  # fmt: skip


def run(smithdev: Experiment, variant: str, seconds: float = 4.0, seed: int = 0) -> ParticleTrack:
    return particles.simulate(cloud(smithdev, variant), seed, seconds=seconds)


def counts(track: ParticleTrack) -> list[int]:
    return [int(n) for n in track.alive.sum(axis=1)]


def count_at(track: ParticleTrack, second: float) -> int:
    return int(track.alive[np.searchsorted(track.times, second - 1e-9)].sum())


@cache
def _many(template: ParticleTemplate) -> Any:
    return np.concatenate([spawn(template, seed)[0] for seed in SEEDS])


def spawned(smithdev: Experiment, variant: str) -> tuple[Any, Any, Any]:
    """Radius, pitch and yaw of the particles of many clouds as they are created; JKU and degrees."""
    places = _many(cloud(smithdev, variant))
    radius = np.linalg.norm(places, axis=1)
    unit = places / radius[:, None]
    return radius, np.degrees(np.arcsin(unit[:, 2])), np.degrees(np.arctan2(-unit[:, 0], unit[:, 1]))


def fills(values: Any, low: float, high: float) -> bool:
    """Whether values stay in a range and come near both of its ends."""
    share = (values - low) / (high - low)
    return bool(-1e-6 < share.min() < 0.01 and 0.99 < share.max() < 1 + 1e-6)


def even(values: Any, low: float, high: float) -> bool:
    """Whether each quarter of a range holds a quarter of the values, within five standard deviations."""
    held, _ = np.histogram(values, np.linspace(low, high, 5))
    return bool(np.abs(held - len(values) / 4).max() < 5 * np.sqrt(len(values) * 3 / 16))


def test_initial_experiments(smithdev: Experiment) -> None:
    """128 particles at once within a small radius, still and unchanged; after the timer all are gone at once."""
    said = dict(word.split("=") for word in RULES["partest"]["template"].split()[2:])
    own = VARIANTS["first"].parameters
    assert {key: value for key, value in said.items() if key in own and key != "material"} == {
        key: value for key, value in own.items() if key != "material"
    }
    assert RULES["all_created_at_once"] and RULES["timer_expiry_without_0x8"] == "all particles vanish at once"
    for variant, size in (("first", 0.02), ("wide", 0.1)):
        track = run(smithdev, variant, 1.0)
        assert counts(track) == [COUNT] * 10 + [0] * 41
        assert track.died_at == 0.2
        assert (track.positions == track.positions[0]).all() and (track.cels == 0).all()
        assert fills(spawned(smithdev, variant)[0], 0, size)
    # "Each time +partest is created, the particle positions appear to be randomized."
    assert not np.array_equal(run(smithdev, "first", 0.1, 1).positions, run(smithdev, "first", 0.1, 2).positions)


def test_decay(smithdev: Experiment) -> None:
    """The rate does nothing without typeflag 0x08; with it particles go one after the other, once the timer ends."""
    assert RULES["rate_without_0x8"] == "no effect"
    slow, fast = (counts(run(smithdev, name)) for name in ("lasting", "lasting_rate_128"))
    assert slow == fast == [COUNT] * 50 + [0] * 151

    assert RULES["flags"]["0x08"] == "fade out at rate after the timer"
    fading = run(smithdev, "fading", 20.0)
    assert count_at(fading, 0.98) == COUNT
    losses = np.diff(counts(fading))
    assert (losses <= 0).all() and losses.min() >= -1
    assert RULES["thing_dies"] == "when its last particle is gone, not when the timer expires"
    assert fading.died_at is not None and fading.died_at > 1.0 + COUNT * 0.02

    # "Setting it to 0 resulted in the same decay rate as 16. However ... 128 definitely resulted in a faster decay."
    assert RULES["rate_has_a_lower_limit"] is True
    for seed in SEEDS:
        by_rate = {name: run(smithdev, name, 20.0, seed).died_at for name in
                   ("fading", "fading_rate_0", "fading_rate_128")}  # fmt: skip
        assert by_rate["fading"] == by_rate["fading_rate_0"]
        assert by_rate["fading_rate_128"] is not None and by_rate["fading"] is not None
        # Twelve go at a time in place of one.
        assert 5 < (by_rate["fading"] - 1.0) / (by_rate["fading_rate_128"] - 1.0) < 20


def lived(smithdev: Experiment, variant: str, thing: Thing) -> ParticleTrack:
    """What was seen of a cloud that a script made: destroyed when its thing was, by a seed of its own."""
    died = None if thing.died is None else (thing.died - thing.born) / 1000
    return particles.simulate(cloud(smithdev, variant), seed=thing.number, seconds=20.0, destroyed_at=died)


@pytest.mark.parametrize("variant", VARIANTS)
def test_each_switch_makes_its_cloud(smithdev: Experiment, variant: str) -> None:
    """`sd_partest.cog`, placed for every variant: at its own ghost, where it stays; the doomed ones do not last."""
    play = Play(smithdev, f"{ROOM}/bay")
    template = smithdev.about(ROOM)["variants"][variant]
    assert play.living(template) == []
    play.press(f"switch {variant}")
    (made,) = play.living(template)
    ghost = play.things[smithdev.thing(f"{ROOM}/place {variant}")]
    assert (made.place == ghost.place).all() and made.sector == ghost.sector
    play.run(2)
    kill = VARIANTS[variant].kill
    assert made.died == (round(kill * 1000) if kill else None)


@pytest.mark.parametrize(("variant", "second"), [("killed_early", 0.1), ("killed_late", 1.5)])
def test_decay_of_a_destroyed_thing(smithdev: Experiment, variant: str, second: float) -> None:
    """0.1 s and 1.5 s after its creation, before and after the timer: 'the entire effect is removed instantly'."""
    assert RULES["destroying_the_thing"].startswith("removes its whole effect at once")
    play = Play(smithdev, f"{ROOM}/bay")
    template = smithdev.about(ROOM)["variants"][variant]
    play.press(f"switch {variant}")
    (made,) = play.living(template)
    play.run(2)
    assert play.living(template) == []
    track = lived(smithdev, variant, made)
    assert track.died_at == second
    # Without the script the same cloud would have gone on: the document's timer of 1 s, then one particle a step.
    whole = particles.simulate(cloud(smithdev, variant), seed=made.number, seconds=20.0)
    assert whole.died_at is not None and whole.died_at > 3
    left = counts(whole)[: int(second / 0.02)]
    assert counts(track)[: len(left)] == left and left[-1] > 0
    assert (left[-1] == COUNT) is (second < 1)


@pytest.mark.parametrize("later", [0.5, 1.48])
def test_another_does_not_affect_the_previous_ones(smithdev: Experiment, later: float) -> None:
    """'Creating another +partest does not affect the previous one(s)': each lives as long as if it were alone.

    The second is made before the first one's end: a script that waited by Sleep, with one variable for both, would
    destroy the second twice and the first never.
    """
    play = Play(smithdev, f"{ROOM}/bay")
    template = smithdev.about(ROOM)["variants"]["killed_late"]
    play.press("switch killed_late")
    play.run(later)
    play.press("switch killed_late")
    first, second = play.living(template)
    play.run(4)
    assert [thing.died for thing in (first, second)] == [1500, 1500 + round(later * 1000)]
    tracks = [lived(smithdev, "killed_late", thing) for thing in (first, second)]
    assert [track.died_at for track in tracks] == [1.5, 1.5]


def test_creation(smithdev: Experiment) -> None:
    """minsize and range bound the radius; pitchrange and yawrange the angles, to each side; 0 is the full circle."""
    assert RULES["spawn"].startswith("radius uniform in [minsize, range]")
    radius, _, _ = spawned(smithdev, "shell")
    assert fills(radius, 0.09, 0.11)
    radius, pitch, yaw = spawned(smithdev, "slice")
    assert fills(radius, 0.09, 0.11) and fills(pitch, -35, 35) and fills(yaw, -35, 35)
    # "Multiplied directly with a random value between -1 / +1".
    assert RULES["spawn"].endswith("pitch, yaw = range * uniform(-1, 1)")
    assert even(radius, 0.09, 0.11) and even(pitch, -35, 35) and even(yaw, -35, 35)
    # "An almost full circle while leaving a gap", of 20 degrees behind.
    _, pitch, yaw = spawned(smithdev, "band")
    assert fills(pitch, -5, 5) and fills(yaw, -170, 170)
    assert RULES["zero_range_means_full_circle"] is True
    assert fills(spawned(smithdev, "pitch_0")[1], -90, 90)
    _, pitch, yaw = spawned(smithdev, "pitch_thin")
    assert np.abs(pitch).max() <= 0.1 + 1e-6 and fills(yaw, -180, 180)


def test_coordinate_space(smithdev: Experiment) -> None:
    """'Attaching the created particle thing to this moving bacta tank results in the cloud following the tank.'

    `sd_tank.cog` in play: the cloud is put on the tank under way, goes to the end with it, and back.
    """
    assert RULES["positions_are_local_to_thing"] is True and RULES["attached"].startswith("follows the thing")
    assert RULES["motion"].startswith("of the thing")
    play = Play(smithdev, f"{ROOM}/bay")
    (tank,) = play.living("sd_tank")
    start = tank.place.copy()
    play.run(1)
    assert 0.3 < np.linalg.norm(tank.place - start) < TRIP / 2, "the script sent it off as the level started"
    play.press("switch tank")
    (made,) = play.living(smithdev.about(ROOM)["variants"]["fading"])
    track = lived(smithdev, "fading", made)
    worlds, tanks = [], []
    for frame in range(450):
        play.run(0.02)
        worlds.append(particles.to_world(track.positions[frame], made.place, made.look))
        tanks.append(tank.place.copy())
    world, path = np.array(worlds), np.array(tanks)
    # 9 s at 0.4 JKU/s: it has come to the far end and back past where the cloud was put on it.
    ahead = (path - start) @ (tank.path[1] - tank.path[0]) / TRIP
    assert ahead.max() == pytest.approx(TRIP, abs=1e-6)
    turned = int(ahead.argmax())
    assert 0 < turned < 449 and ahead[-1] < ahead[0]
    # Each particle keeps its place about the tank, whichever way that goes, ...
    about = world - path[:, None]
    assert np.abs(about - about[0]).max() < 1e-12
    # ... so that in the world it goes as far as the tank does, and turns when it turns.
    steps = np.diff(world, axis=0)
    assert np.abs(steps - np.diff(path, axis=0)[:, None]).max() < 1e-12
    # Its particles dissolve meanwhile as those of any other cloud.
    assert 0 < counts(track)[100] < COUNT


def test_cel_animation(smithdev: Experiment) -> None:
    """0x04 a random cel that stays; 0x20 on to the last one, which is reached as the timer ends, and kept."""
    flags = RULES["flags"]
    assert flags["0x04"] == "random start cel" and flags["0x20"].startswith("cycle through cels")
    still = run(smithdev, "random_cel", 0.9)
    assert set(still.cels[0].tolist()) == set(range(CELS["00ramp1.mat"]))
    assert (still.cels == still.cels[0]).all()

    assert RULES["cel_cycle"] == "reaches the last cel when the timer expires, then stays"
    last = CELS["00ramp1.mat"] - 1
    for variant, timer in (("cycle", 1.0), ("cycle_fast", 0.5), ("cycle_fade", 1.0)):
        track = run(smithdev, variant)
        before = track.times < timer
        assert (np.diff(track.cels, axis=0) >= 0).all()
        assert (track.cels[before][:, track.cels[0] < last] < last).all()
        assert (track.cels[~before] == last).all()
    # With 0x08 they dissolve only then, and in the last colour.
    fading = run(smithdev, "cycle_fade", 20.0)
    assert count_at(fading, 0.98) == COUNT and fading.died_at is not None and fading.died_at > 2.0


def test_cel_counts(smithdev: Experiment) -> None:
    """Illustration 35: materials of our own with as many cels as the game's, read from their files."""
    held = smithdev.level.particles
    assert held is not None
    about = smithdev.about(ROOM)["cels"]
    found = {material: int(held.cels[row_of(smithdev, template)]) for material, template in about.items()}
    assert found == RULES["materials_cels"]


def test_expand_outwards(smithdev: Experiment) -> None:
    """0x01: straight away from the centre, at a speed that maxthrust sets and nothing varies."""
    assert RULES["flags"]["0x01"] == "fly outward at maxthrust"
    assert RULES["expansion"].startswith("from the spawn point away from the centre")
    speeds = []
    for variant in ("expand", "expand_fast"):
        track = run(smithdev, variant, 0.9)
        places = track.positions
        away = np.linalg.norm(places, axis=2)
        unit = places / away[..., None]
        assert unit == pytest.approx(np.broadcast_to(unit[0], unit.shape), abs=1e-9)
        growth = (away / away[0])[-1]
        assert growth == pytest.approx(np.full(COUNT, growth[0]))
        speeds.append(float(growth[0] - 1) / 0.9)
    assert speeds[1] / speeds[0] == pytest.approx(8 / 2, rel=0.05)


def test_unknowns(smithdev: Experiment) -> None:
    """0x10 and 0x02 change nothing that is seen; no particle casts light."""
    plain = run(smithdev, "shell")
    for key, variant in (("0x10", "flag_0x10"), ("0x02", "flag_0x02")):
        assert RULES["flags"][key].startswith("no effect seen")
        track = run(smithdev, variant)
        for name in ("positions", "cels", "sizes", "alive"):
            assert np.array_equal(getattr(track, name), getattr(plain, name))
    # "None of them cast any dynamic light": the clouds that the level places are none of its lights, all of them lamps.
    lights, placed = smithdev.level.lights, smithdev.handles["light_test_bed"]["things"]
    assert lights is not None
    shining = set(lights.thing.tolist())
    assert shining == {number for name, number in placed.items() if name.startswith("lamp")}
    assert RULES["cast_light"] is bool(shining & {smithdev.thing(f"{ROOM}/cels {material}") for material in CELS})
