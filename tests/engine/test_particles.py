"""Particle clouds beyond the golden statements: profiles, extremes, and the same bits everywhere."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from jktools.engine.degrees import sine_cosine
from jktools.engine.particle_spawn import RandomNumbers, Stream, spawn
from jktools.engine.particle_template import MAX_COUNT, ParticleFlag, ParticleTemplate
from jktools.engine.particles import LEAST_SCALE, scales, simulate
from jktools.engine.profile import Engine

CLOUD = ParticleTemplate(
    count=64, timer=1.0, range=0.1, minsize=0.02, elementsize=0.01, cels=5, rate=40.0, maxthrust=3.0
)
PI = Fraction(31415926535897932384626433832795028841971693993751, 10**49)


def variant(**values: float) -> ParticleTemplate:
    fields = {name: getattr(CLOUD, name) for name in ParticleTemplate.__slots__}
    return ParticleTemplate(**{**fields, **values})


def exact_sine(degrees: float) -> Fraction:
    """The Taylor series in rationals, to 1e-30."""
    x = Fraction(degrees) % 360 * PI / 180
    total, term, n = Fraction(0), x, 1
    while abs(term) > Fraction(1, 10**30):
        total, term, n = total + term, -term * x * x / ((n + 1) * (n + 2)), n + 2
    return total


def test_sine_and_cosine() -> None:
    angles = np.concatenate([np.random.default_rng(5).uniform(-720, 720, 150), [1e-9, 44.999, 45.0, 45.001, 1e6 + 0.1]])
    sine, cosine = sine_cosine(angles)
    for angle, s, c in zip(angles.tolist(), sine.tolist(), cosine.tolist(), strict=True):
        assert abs(exact_sine(angle) - Fraction(s)) < Fraction(3, 10**16)
        assert abs(exact_sine(float(np.fmod(angle, 360.0))) ** 2 + Fraction(c) ** 2 - 1) < Fraction(9, 10**16)
    quarters = sine_cosine(np.arange(-720.0, 721.0, 90.0))
    assert set(np.concatenate(quarters).tolist()) == {-1.0, 0.0, 1.0}
    assert np.isnan(sine_cosine(np.nan)).all()


def pcg64(state: int, increment: int) -> tuple[int, int]:
    """One step of PCG64 (XSL-RR on a 128 bit congruential generator), from its published description."""
    state = (state * 0x2360ED051FC65DA44385DF649FCCF645 + increment) % 2**128
    word, turn = (state >> 64 ^ state) % 2**64, state >> 122
    return state, (word >> turn | word << (64 - turn)) % 2**64


def test_random_numbers_are_the_published_generator() -> None:
    """Recomputed in whole numbers: no library's float conversion can change them."""
    for stream in Stream:
        begun = np.random.PCG64(np.random.SeedSequence(7, spawn_key=(int(stream),))).state["state"]
        state, expected = begun["state"], []
        for _ in range(20):
            state, word = pcg64(state, begun["inc"])
            expected.append(float(Fraction(word >> 11, 2**53)))
        assert RandomNumbers(7, stream).draw(5, 4).ravel().tolist() == expected


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("flags", [0x00, 0x2D])
def test_a_longer_run_begins_with_the_shorter(engine: Engine, flags: int) -> None:
    template = variant(typeflags=flags)
    short, long = (simulate(template, 3, seconds=seconds, engine=engine) for seconds in (1.5, 4.0))
    for name in ("times", "positions", "cels", "sizes", "alive"):
        assert np.array_equal(getattr(short, name), getattr(long, name)[:76])
    again = simulate(template, 3, seconds=1.5, engine=engine)
    assert again.positions.tobytes() == short.positions.tobytes()
    assert not np.array_equal(simulate(template, 4, seconds=1.5, engine=engine).positions, short.positions)


def test_profiles_differ_where_minsize_exceeds_range() -> None:
    """The document's words: between the two. The engine: all at minsize."""
    template = variant(minsize=0.2)
    radius = {engine: np.linalg.norm(spawn(template, 0, engine)[0], axis=1) for engine in Engine}
    assert np.allclose(radius[Engine.OPENJKDF2], 0.2)
    assert radius[Engine.RESEARCH].min() > 0.1
    assert radius[Engine.RESEARCH].max() < 0.2
    assert np.ptp(radius[Engine.RESEARCH]) > 0.08


def test_cels_by_chance_end_with_the_timer() -> None:
    """The engine's rule is a chance a frame: none goes back, and most have arrived as the timer ends."""
    track = simulate(variant(typeflags=0x20, count=256), seconds=1.0, engine=Engine.OPENJKDF2)
    assert (np.diff(track.cels, axis=0) >= 0).all()
    assert not track.cels[0].any()
    assert (track.cels[25] < 4).mean() > 0.9
    assert (track.cels[49] == 4).mean() > 0.8


def test_a_timer_of_zero_never_ends() -> None:
    for timer in (0.0, -1.0, float("nan")):
        track = simulate(variant(timer=timer, typeflags=ParticleFlag.CYCLE_CELS), seconds=100.0, step_ms=100)
        assert track.alive.all()
        assert track.died_at is None
        assert not track.cels.any()
    hurried = simulate(variant(timer=0.0, typeflags=0x20), seconds=1.0, engine=Engine.OPENJKDF2).cels
    assert hurried[:7, 0].tolist() == [0, 0, 1, 2, 3, 4, 4]


def test_the_smallest_timer_ends_in_the_next_frame() -> None:
    assert simulate(variant(timer=0.001)).died_at == 0.02
    assert simulate(variant(timer=0.0009)).died_at is None


def test_timers_are_whole_milliseconds_as_written() -> None:
    """1.001 s is 1,001 ms, though 1.001 * 1000 is a little less."""
    assert 1.001 * 1000 < 1001
    assert [variant(timer=timer).timer_ms for timer in (1.001, 0.2, 0.0019, 1e30)] == [
        1001,
        200,
        1,
        2**31 - 1,
    ]


def test_shrinking_stops_at_the_least_scale() -> None:
    """1, then 0.5 less a second at 100 frames: below 0.01 it is set back to 0.01, over and over."""
    size = scales(variant(maxthrust=-0.5, typeflags=1), 400, 10)
    assert size[:3].tolist() == pytest.approx([1.0, 0.995, 0.99])
    assert size.min() > LEAST_SCALE - 0.5 * 0.01 - 1e-9
    assert set(np.round(size[210:], 6).tolist()) == {0.01, 0.005}


def test_counts_and_rates_outside_their_range() -> None:
    assert [variant(count=count).spawned for count in (-5, 0, 256, 10**9)] == [0, 0, MAX_COUNT, MAX_COUNT]
    rates = (-1e30, 0.0, 19.9, 20.0, 128.0, 1e30, float("nan"))
    assert [variant(rate=rate).lost_a_step for rate in rates] == [1, 1, 1, 2, 12, MAX_COUNT, 1]
    assert simulate(variant(count=0), seconds=0.1).positions.shape == (6, 0, 3)
    assert simulate(variant(rate=1e30, typeflags=0x8)).died_at == 1.0


def test_light_modes() -> None:
    assert (variant(typeflags=0x10).light_mode, variant(typeflags=0x2F).light_mode) == (0, 2)


@pytest.mark.parametrize(
    "named",
    [{"seconds": -1.0}, {"seconds": float("inf")}, {"seconds": float("nan")}, {"step_ms": 0}, {"seed": -1}],
)
def test_times_that_make_no_sense_are_refused(named: dict) -> None:
    with pytest.raises(ValueError, match="cannot run"):
        simulate(CLOUD, **named)
