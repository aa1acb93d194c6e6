"""Colour, light and particles, each beside a plain Python loop that gives the same answer.

The loops are checked to agree before anything is timed; the ratio is printed by the comparison table of
pytest-benchmark (`make bench`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from jktools.engine import colour, light, palette
from jktools.engine.colour import Renderer
from jktools.engine.colour_effect import ColourEffect
from jktools.engine.framebuffer import Depth
from jktools.engine.particle_template import ParticleTemplate
from jktools.engine.particles import simulate
from jktools.engine.profile import Engine

EFFECT = ColourEffect((0, 1, 1), (0.0, 0.3, 0.1), (20, 0, 60), 0.8)
RANDOM = np.random.default_rng(1)
PALETTE = RANDOM.integers(0, 256, (256, 3), dtype=np.uint8)
IMAGE = RANDOM.integers(0, 256, (480, 640, 3), dtype=np.uint8)
VERTICES = RANDOM.uniform(-2, 2, (10_000, 3))
LAMPS = RANDOM.uniform(-2, 2, (8, 3))
VALUES = RANDOM.uniform(0.2, 2, 8)
CLOUD = ParticleTemplate(
    count=256,
    timer=9.0,
    typeflags=0x2D,
    range=0.2,
    minsize=0.1,
    maxthrust=0.5,
    elementsize=0.01,
    cels=7,
    rate=16.0,
)


def drawn_by_loop(colours: Any, depth: Depth) -> list[list[int]]:
    """The research order, a channel at a time, with the factors worked out once."""
    shares = [min(math.trunc(add) / colour.FULL_ADD, 1.0) for add in EFFECT.add]
    factors = [1 + own - (sum(EFFECT.tint) - own) / 2 for own in EFFECT.tint]
    steps = (31, 63, 31) if depth is Depth.RGB565 else (255, 255, 255)
    result = []
    for pixel in colours:
        shown = []
        for level, on, factor, share, most in zip(pixel, EFFECT.filters, factors, shares, steps, strict=True):
            lit = level * EFFECT.brightness * factor if on else 0.0
            lit = math.floor(min(max(lit, 0.0), 255.0))
            value = min(max(lit * (1 - max(shares)) + 255 * share, 0.0), 255.0)
            step = math.floor(value * most / 255 + 0.5)
            bits = most.bit_length()
            shown.append(step << (8 - bits) | step >> (2 * bits - 8) if bits < 8 else step)
        result.append(shown)
    return result


def light_by_loop(vertices: Any, lamps: Any, values: Any) -> list[float]:
    result = []
    for vertex in vertices:
        total = 0.0
        for lamp, value in zip(lamps, values, strict=True):
            away = math.dist(vertex, lamp)
            if away < value / light.WORLD_FALLOFF:
                total += value - light.WORLD_FALLOFF * away
        result.append(total)
    return result


def cloud_by_loop(start: Any, first: Any, seconds: float, step_ms: int) -> tuple[list[Any], list[Any]]:
    """Places and cels in the research profile, a particle and a frame at a time."""
    places, cels, size = [], [], 1.0
    last, timer = CLOUD.cels - 1, CLOUD.timer_ms
    for frame in range(int(seconds * 1000 / step_ms) + 1):
        size = size + CLOUD.maxthrust * (step_ms / 1000.0) if frame else 1.0
        elapsed = min(frame * step_ms, timer)
        places.append([[x * size, y * size, z * size] for x, y, z in start])
        cels.append([cel + (last - cel) * elapsed // timer for cel in first])
    return places, cels


CASES: dict[str, tuple[Callable[[], Any], Callable[[], Any]]] = {
    "palette of 256 colours": (
        lambda: palette.under_effect(PALETTE, EFFECT, Engine.RESEARCH, Renderer.SOFTWARE, Depth.RGB888),
        lambda: drawn_by_loop(PALETTE.tolist(), Depth.RGB888),
    ),
    "image of 640 x 480": (
        lambda: colour.apply(IMAGE, EFFECT),
        lambda: drawn_by_loop(IMAGE.reshape(-1, 3).tolist(), Depth.RGB565),
    ),
    "8 lights on 10,000 vertices": (
        lambda: light.light_on_vertices(VERTICES, LAMPS, VALUES),
        lambda: light_by_loop(VERTICES.tolist(), LAMPS.tolist(), VALUES.tolist()),
    ),
    "256 particles over 10 s": (
        lambda: simulate(CLOUD, 1, seconds=10.0),
        lambda: cloud_by_loop(*(part.tolist() for part in _start()), 10.0, 20),
    ),
}


def _start() -> tuple[Any, Any]:
    track = simulate(CLOUD, 1, seconds=0.0)
    return track.positions[0], track.cels[0]


@pytest.fixture(scope="module", autouse=True)
def the_loops_agree() -> None:
    """What is compared must be the same work."""
    for name in ("palette of 256 colours", "image of 640 x 480"):
        fast, slow = (case() for case in CASES[name])
        assert np.array_equal(fast.reshape(-1, 3), slow)
    fast, slow = (case() for case in CASES["8 lights on 10,000 vertices"])
    assert np.allclose(fast, slow, rtol=1e-12, atol=1e-15)
    track, (places, cels) = (case() for case in CASES["256 particles over 10 s"])
    assert np.array_equal(track.positions, places)
    assert np.array_equal(track.cels, cels)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("way", ["numpy", "loop"])
def test_bench(name: str, way: str, benchmark: Any) -> None:
    benchmark.group = name
    if way == "numpy":
        benchmark(CASES[name][0])
    else:
        benchmark.pedantic(CASES[name][1], rounds=2 if "image" in name else 5)
