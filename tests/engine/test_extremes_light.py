"""Parameters 0, negative, 1e30 and NaN: the documented result, no warning, no NaN out without NaN in."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.engine import ai_sight, colour, infrared, light, palette, screen_tint
from jktools.engine.ai_sight import Look
from jktools.engine.colour import Renderer
from jktools.engine.colour_effect import ColourEffect, combine
from jktools.engine.framebuffer import Depth
from jktools.engine.particle_template import ParticleTemplate
from jktools.engine.particles import simulate
from jktools.engine.profile import Engine

wild = st.one_of(
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 1e30, -1e30, 1e-300, -1e-300, 5e-324, math.nan, 0.5, 2.0, 255.0, 290.0]),
    st.floats(-1e30, 1e30),
)
triples = st.tuples(wild, wild, wild)
points = st.lists(triples, min_size=1, max_size=4)
effects = st.builds(ColourEffect, triples, triples, triples, wild)
engines, renderers, depths = (st.sampled_from(kind) for kind in (Engine, Renderer, Depth))


def has_nan(*values: Any) -> bool:
    return any(bool(np.isnan(np.asarray(value, float)).any()) for value in values)


@given(st.lists(effects, max_size=3), engines, renderers, depths)
@settings(max_examples=200, deadline=None)
def test_colour(asked: list[ColourEffect], engine: Engine, renderer: Renderer, depth: Depth) -> None:
    """Every effect draws every colour; a channel never falls as its input rises."""
    with np.errstate(all="raise"):
        effect = combine(asked, engine)
        table = colour.lookup_table(effect, engine, renderer, depth)
    assert not has_nan(effect.filters, effect.tint, effect.add, effect.brightness)
    assert effect.brightness <= 1.0
    # The software tint cuts twice, so there a brighter level can come out one darker.
    if engine is Engine.RESEARCH or renderer is Renderer.HARDWARE or effect.tint == (0.0, 0.0, 0.0):
        assert (np.diff(table.astype(int), axis=0) >= 0).all()


@given(effects, engines, renderers, depths)
@settings(max_examples=200, deadline=None)
def test_one_effect_drawn_uncombined(effect: ColourEffect, engine: Engine, renderer: Renderer, depth: Depth) -> None:
    with np.errstate(all="raise"):
        table = colour.lookup_table(effect, engine, renderer, depth)
        colour.vertex_colour([0.0, 0.5, 1.0], effect, (1.0, 0.5, 0.0))
    added = [whole(value) for value in effect.add]
    if engine is Engine.RESEARCH and max(added) < 0:
        assert (table == 255).all()
    inverts = engine is Engine.OPENJKDF2 and renderer is Renderer.HARDWARE and effect.brightness < 0.0
    if effect.brightness <= 0.0 and not any(added) and not inverts:
        assert not table.any()


def whole(value: float) -> int:
    return 0 if math.isnan(value) else math.trunc(value)


@given(triples, triples, wild, wild)
def test_flashes_stay_in_their_range(tint: Any, add: Any, damage: float, seconds: float) -> None:
    with np.errstate(all="raise"):
        flash = screen_tint.with_damage(screen_tint.with_add(screen_tint.Flash(tint), add), damage)
        later = screen_tint.decayed(flash, abs(seconds))
        sector = screen_tint.sector_effect(tint)
    assert all(0.0 <= value <= 1.0 for value in (*flash.tint, *later.tint, *sector.tint))
    assert all(0.0 <= value <= 255.0 for value in later.add)


@given(wild, st.lists(wild, min_size=1), engines)
def test_infrared_and_light_levels(world: float, extra: list[float], engine: Engine) -> None:
    with np.errstate(all="raise"):
        lit = infrared.surface_light(world, extra, engine)
        rows = palette.light_level(extra)
        ambient = infrared.thing_ambient(world, engine)
    assert ((lit >= 0) & (lit <= 1)).all()
    assert 0.0 <= ambient <= 1.0
    assert ((rows >= 0) & (rows < 64)).all()


@given(points, points, st.data())
@settings(max_examples=200, deadline=None)
def test_light(vertices: Any, lamps: Any, data: st.DataObject) -> None:
    """Light is never negative nor NaN; one of value 0, below or NaN gives nothing."""
    values = data.draw(st.lists(wild, min_size=len(lamps), max_size=len(lamps)))
    normals = np.tile([0.0, 0.0, 1.0], (len(vertices), 1))
    with np.errstate(all="raise"):
        level = light.light_on_vertices(vertices, lamps, values)
        model = light.light_on_model(vertices, normals, lamps, values)
        drawn = light.surface_brightness(0.0, 0.0, level, 0.0)
        shown = light.pixel(drawn)
        light.reach(values)
    assert (level >= 0).all()
    assert ((model >= 0) & (model <= 1)).all()
    assert shown.dtype == np.uint8
    if not any(value > 0 for value in values):
        assert not level.any()
        assert not model.any()


templates = st.builds(
    ParticleTemplate,
    count=st.sampled_from([-1, 0, 1, 5, 10**9]), timer=wild, typeflags=st.integers(0, 0x7F), range=wild,
    minsize=wild, rate=wild, maxthrust=wild, elementsize=wild, pitchrange=wild, yawrange=wild,
    cels=st.sampled_from([-1, 0, 1, 5, 16]),
)  # fmt: skip


@given(templates, st.integers(0, 2**64), engines)
@settings(max_examples=200, deadline=None)
def test_particles(template: ParticleTemplate, seed: int, engine: Engine) -> None:
    with np.errstate(all="raise"):
        track = simulate(template, seed, seconds=0.3, step_ms=30, engine=engine)
    numbers = (template.range, template.minsize, template.pitchrange, template.yawrange, template.maxthrust)
    if not has_nan(*numbers):
        assert not has_nan(track.positions)
    if not has_nan(template.elementsize):
        assert not has_nan(track.sizes)
    assert (track.cels >= 0).all()
    assert (track.cels <= max(template.cels - 1, 0)).all()
    assert (np.diff(track.alive.sum(axis=1)) <= 0).all()
    if not template.timer > 0.0:
        assert track.alive.all()


@given(triples, triples, wild, wild, wild)
@settings(max_examples=200, deadline=None)
def test_ai_sight(eye: Any, target: Any, size: float, fov: float, reach: float) -> None:
    """Every pair gets one of the four verdicts."""
    view = Look([eye], [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]], [target], [size])
    with np.errstate(all="raise"):
        verdict = ai_sight.verdicts(view, fov, reach)
        distance = ai_sight.distance_to_target(view)
    assert verdict[0] in list(ai_sight.Verdict)
    assert has_nan(eye, target, size) or distance[0] >= 0.0
