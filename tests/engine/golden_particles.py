"""What golden.toml says of particles and sight, one check a key."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from jktools.engine import particle_template, particles, sight
from jktools.engine.particle_spawn import spawn
from jktools.engine.particle_template import ParticleFlag, ParticleTemplate

Check = Callable[[dict[str, Any]], None]

SEEDS = 40
TURNED = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""The orientation of a thing that has turned left by 90 degrees."""


def cloud(flags: int = 0, **values: Any) -> ParticleTemplate:
    """A cloud like the document's, with one thing changed."""
    usual: dict[str, Any] = {
        "count": 128,
        "timer": 1.0,
        "range": 0.11,
        "minsize": 0.09,
        "elementsize": 0.007,
        "cels": 5,
    }
    return ParticleTemplate(**{**usual, "typeflags": flags, **values})


def many(template: ParticleTemplate) -> Any:
    """Spawn positions of many clouds: (seeds * count, 3)."""
    return np.concatenate([spawn(template, seed)[0] for seed in range(SEEDS)])


def angles(positions: Any) -> tuple[Any, Any]:
    """Pitch and yaw, degrees, by which positions lie off the thing's forward axis."""
    unit = positions / np.linalg.norm(positions, axis=1)[:, None]
    return np.degrees(np.arcsin(unit[:, 2])), np.degrees(np.arctan2(-unit[:, 0], unit[:, 1]))


def living(track: particles.ParticleTrack, second: float) -> int:
    return int(track.alive[np.searchsorted(track.times, second - 1e-9)].sum())


def local(golden: dict[str, Any]) -> None:
    """Where the thing stands and how it is turned moves the whole cloud, and nothing else does."""
    assert golden["particles"]["positions_are_local_to_thing"] is True
    positions = particles.simulate(cloud(), seconds=0.1).positions
    moved = particles.to_world(positions, [5.0, 6.0, 7.0], TURNED)
    turned = np.stack([-positions[..., 1], positions[..., 0], positions[..., 2]], axis=-1)
    expected = turned + np.array([5.0, 6.0, 7.0])
    assert np.array_equal(moved, expected)


def at_once(golden: dict[str, Any]) -> None:
    assert golden["particles"]["all_created_at_once"] is True
    track = particles.simulate(cloud(ParticleFlag.EXPAND, maxthrust=2.0))
    assert track.alive.sum(axis=1).tolist() == [128] * 50 + [0] * 451
    assert track.times[0] == 0.0


def timer(golden: dict[str, Any]) -> None:
    assert golden["particles"]["timer_expiry_without_0x8"] == "all particles vanish at once"
    for seconds in (0.2, 1.0, 2.5):
        track = particles.simulate(cloud(timer=seconds))
        assert (living(track, seconds - 0.02), living(track, seconds)) == (128, 0)
        assert track.died_at == seconds


def destroyed(golden: dict[str, Any]) -> None:
    """0.1 s and 1.5 s after the creation, before and after the timer, as the document tried."""
    assert golden["particles"]["destroying_the_thing"].startswith("removes its whole effect at once")
    for second in (0.1, 1.5):
        track = particles.simulate(cloud(ParticleFlag.FADE, rate=16.0), destroyed_at=second)
        assert living(track, second - 0.02) > 0
        assert track.died_at == second


def dies_last(golden: dict[str, Any]) -> None:
    assert golden["particles"]["thing_dies"].startswith("when its last particle is gone")
    track = particles.simulate(cloud(ParticleFlag.FADE, rate=16.0), seconds=20.0)
    lived = track.alive.any(axis=1)
    assert track.died_at is not None
    assert track.died_at == track.times[lived.sum()] > 1.0
    assert lived[: lived.sum()].all()


def spawning(golden: dict[str, Any]) -> None:
    """Radius and angles fill their ranges to both ends, evenly, and never leave them."""
    assert golden["particles"]["spawn"].startswith("radius uniform in [minsize, range]")
    positions = many(cloud(pitchrange=35.0, yawrange=35.0))
    radius = np.linalg.norm(positions, axis=1)
    for values, low, high in ((radius, 0.09, 0.11), *((a, -35.0, 35.0) for a in angles(positions))):
        share = (values - low) / (high - low)
        assert -1e-12 < share.min() < 0.002
        assert 0.998 < share.max() < 1 + 1e-12
        # Kolmogorov's distance of 5,120 even draws exceeds 0.03 once in 10,000 runs; the draws are fixed.
        assert np.abs(np.sort(share) - np.linspace(0, 1, len(share))).max() < 0.03


def full_circle(golden: dict[str, Any]) -> None:
    """0 reaches every direction; 0.1 is a thin band."""
    assert golden["particles"]["zero_range_means_full_circle"] is True
    pitch, yaw = angles(many(cloud(pitchrange=0.1)))
    assert np.abs(pitch).max() <= 0.1 + 1e-9
    assert np.diff(np.sort(yaw), prepend=-180.0, append=180.0).max() < 1.0
    upright = many(cloud(yawrange=0.1))
    yaw = angles(upright)[1]
    assert np.minimum(np.abs(yaw), 180.0 - np.abs(yaw)).max() <= 0.1 + 1e-9
    around = np.degrees(np.arctan2(upright[:, 2], upright[:, 1]))
    assert np.diff(np.sort(around), prepend=-180.0, append=180.0).max() < 1.0


def slowest_rate(golden: dict[str, Any]) -> None:
    assert golden["particles"]["rate_has_a_lower_limit"] is True
    left = {
        rate: particles.simulate(cloud(ParticleFlag.FADE, rate=rate)).alive.sum(axis=1) for rate in (0.0, 16.0, 128.0)
    }
    assert np.array_equal(left[0.0], left[16.0])
    fading = (left[0.0] < 128) & (left[0.0] > 0)
    assert fading.any()
    assert (left[128.0][fading] < left[0.0][fading]).all()


def rate_needs_fade(golden: dict[str, Any]) -> None:
    assert golden["particles"]["rate_without_0x8"] == "no effect"
    tracks = [particles.simulate(cloud(rate=rate)).alive for rate in (0.0, 16.0, 128.0)]
    assert np.array_equal(tracks[0], tracks[1])
    assert np.array_equal(tracks[0], tracks[2])
    assert set(tracks[0].sum(axis=1).tolist()) == {0, 128}


def cel_cycle(golden: dict[str, Any]) -> None:
    """Every particle changes to the last cel exactly as the timer ends, and keeps it through the fade."""
    assert golden["particles"]["cel_cycle"].startswith("reaches the last cel when the timer expires")
    for random in (0, ParticleFlag.RANDOM_CEL):
        flags = ParticleFlag.CYCLE_CELS | ParticleFlag.FADE | random
        track = particles.simulate(cloud(flags, timer=2.0), seconds=4.0)
        before = track.times < 2.0
        assert (np.diff(track.cels, axis=0) >= 0).all()
        assert (track.cels[before][:, track.cels[0] < 4] < 4).all()
        assert (track.cels[~before] == 4).all()


def expansion(golden: dict[str, Any]) -> None:
    """Straight away from the centre, at a speed that maxthrust sets."""
    assert golden["particles"]["expansion"].startswith("from the spawn point away from the centre")
    for thrust in (0.5, 5.0):
        track = particles.simulate(cloud(ParticleFlag.EXPAND, maxthrust=thrust, timer=5.0), seconds=1.0)
        expected = track.positions[0] * (1.0 + thrust * track.times)[:, None, None]
        assert np.allclose(track.positions, expected, rtol=1e-12, atol=0)


def no_light(golden: dict[str, Any]) -> None:
    assert golden["particles"]["cast_light"] is False
    assert particle_template.CASTS_LIGHT is False


def motion(golden: dict[str, Any]) -> None:
    """Without typeflag 0x1 no particle moves in its thing's frame, however hard maxthrust is."""
    assert golden["particles"]["motion"].startswith("of the thing")
    positions = particles.simulate(cloud(maxthrust=30.0)).positions
    assert (positions == positions[0]).all()


def attached(golden: dict[str, Any]) -> None:
    """A cloud on a moving thing goes with it, frame by frame."""
    assert golden["particles"]["attached"].startswith("follows the thing")
    track = particles.simulate(cloud(), seconds=1.0)
    path = np.stack([track.times, 0 * track.times, -track.times], axis=1)
    world = particles.to_world(track.positions, path[:, None], np.eye(3))
    assert np.allclose(world - world[0], path[:, None], rtol=0, atol=1e-15)


def flag_expand(golden: dict[str, Any]) -> None:
    assert golden["particles"]["flags"]["0x01"] == "fly outward at maxthrust"
    still, flying = (particles.simulate(cloud(flags, maxthrust=2.0), seconds=0.5) for flags in (0, 0x01))
    assert np.allclose(flying.positions[-1], 2.0 * still.positions[-1])


def no_effect(key: str, flag: int) -> Check:
    """The flag changes nothing that is seen, alone or with the others."""

    def check(golden: dict[str, Any]) -> None:
        assert golden["particles"]["flags"][key].startswith("no effect seen")
        for others in (0x00, 0x2D):
            with_it, without = (particles.simulate(cloud(others | bit, maxthrust=1.0)) for bit in (flag, 0))
            for name in ("positions", "cels", "sizes", "alive"):
                assert np.array_equal(getattr(with_it, name), getattr(without, name))

    return check


def flag_random_cel(golden: dict[str, Any]) -> None:
    """All five cels, about as often each, and they stay."""
    assert golden["particles"]["flags"]["0x04"] == "random start cel"
    cels = np.concatenate([spawn(cloud(0x04), seed)[1] for seed in range(SEEDS)])
    assert np.abs(np.bincount(cels, minlength=5) / len(cels) - 0.2).max() < 0.02
    assert (particles.simulate(cloud(0x04)).cels == spawn(cloud(0x04), 0)[1]).all()
    assert not spawn(cloud(), 0)[1].any()


def flag_fade(golden: dict[str, Any]) -> None:
    """One by one after the timer, at steps of 1 to 100 ms: 128 particles take about 128 * 50.5 ms."""
    assert golden["particles"]["flags"]["0x08"] == "fade out at rate after the timer"
    lengths = [particles.simulate(cloud(0x08), seed, seconds=20.0, step_ms=1).died_at for seed in range(8)]
    mean = float(np.mean([died - 1.0 for died in lengths if died is not None]))
    # Standard error of the mean of 8 * 127 steps of sd 28.9 ms over 127 steps: 0.115 s.
    assert abs(mean - 127 * 0.0505) < 0.35
    counts = particles.simulate(cloud(0x08), step_ms=1).alive.sum(axis=1)
    assert set(np.diff(counts).tolist()) == {0, -1}
    assert living(particles.simulate(cloud(0x08)), 0.98) == 128


def flag_cycle(golden: dict[str, Any]) -> None:
    assert golden["particles"]["flags"]["0x20"] == "cycle through cels (JKSpecs: flipped)"
    track = particles.simulate(cloud(0x20), seconds=1.0)
    assert track.cels[:, 0].tolist() == [min(4, frame * 4 // 50) for frame in range(51)]


def partest(golden: dict[str, Any]) -> None:
    """The document's first experiment: 128 particles at once, within 0.02 JKU, at rest, gone after 0.2 s."""
    words = dict(re.findall(r"(\w+)=(\S+)", golden["particles"]["partest"]["template"]))
    material = golden["particles"]["materials_cels"][words["material"]]
    named = {key: float(words[key]) for key in ("timer", "range", "rate", "maxthrust", "elementsize")}
    template = ParticleTemplate(
        count=int(words["count"]), typeflags=int(words["typeflags"], 16), cels=material, **named
    )
    track = particles.simulate(template, seconds=0.5)
    radius = np.linalg.norm(track.positions, axis=2)
    assert track.positions.shape[1] == 128
    assert 0.019 < radius.max() <= 0.02
    assert (track.positions == track.positions[0]).all()
    assert track.died_at == 0.2
    assert set(track.sizes[track.alive].tolist()) == {0.007}


def material(name: str) -> Check:
    def check(golden: dict[str, Any]) -> None:
        assert particle_template.MATERIAL_CELS[name] == golden["particles"]["materials_cels"][name]

    return check


def has_los(golden: dict[str, Any]) -> None:
    """Any solid thing and any wall block; facing plays no part in the rules."""
    assert golden["sight"]["has_los"].endswith("a solid thing or surface between them blocks")
    assert sight.surface_blocks([0x0, 0x4, 0x4], [0x0, 0x1, 0x2], [False, True, True]).tolist() == [
        True,
        False,
        True,
    ]
    collide = [0, 1, 3, 3]
    assert sight.thing_blocks(False, collide, 0, [False, False, False, True]).tolist() == [
        False,
        True,
        True,
        False,
    ]


CHECKS: dict[str, Check] = {
    "particles.positions_are_local_to_thing": local,
    "particles.all_created_at_once": at_once,
    "particles.timer_expiry_without_0x8": timer,
    "particles.destroying_the_thing": destroyed,
    "particles.thing_dies": dies_last,
    "particles.spawn": spawning,
    "particles.zero_range_means_full_circle": full_circle,
    "particles.rate_has_a_lower_limit": slowest_rate,
    "particles.cel_cycle": cel_cycle,
    "particles.expansion": expansion,
    "particles.cast_light": no_light,
    "particles.motion": motion,
    "particles.rate_without_0x8": rate_needs_fade,
    "particles.attached": attached,
    "particles.flags.0x01": flag_expand,
    "particles.flags.0x02": no_effect("0x02", 0x02),
    "particles.flags.0x04": flag_random_cel,
    "particles.flags.0x08": flag_fade,
    "particles.flags.0x10": no_effect("0x10", 0x10),
    "particles.flags.0x20": flag_cycle,
    "particles.partest.template": partest,
    **{f"particles.materials_cels.{name}": material(name) for name in particle_template.MATERIAL_CELS},
    "sight.has_los": has_los,
}

STATEMENTS = {"sight.costly_case"}
"""What is said of speed, not of a rule: named in docs/engine.md."""
