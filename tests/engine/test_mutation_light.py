"""Each golden check fails when its formula is perturbed by 2 %, or by twice the golden tolerance if that is more.

Where a value does not move with 2 % by its nature (a screen that is saturated anyway, a yes or a no), the
mutation is the smallest other formula that the value rules out, and says so.
"""

# ruff: noqa: E501 (the table reads best with one mutation a line)

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pytest

from jktools.engine import colour, infrared, light, particle_spawn, particles, sight
from jktools.engine.colour_effect import ColourEffect
from jktools.engine.framebuffer import quantise
from jktools.engine.particle_template import MATERIAL_CELS, ParticleFlag, ParticleTemplate
from jktools.engine.profile import Engine
from tests.engine import golden_colour, golden_dynamic_light, golden_particles

CHECKS: dict[str, Any] = {
    **golden_colour.CHECKS,
    **golden_dynamic_light.CHECKS,
    **golden_dynamic_light.OPEN,
    **golden_particles.CHECKS,
}
STEP_565 = 255 / 31
"""The coarsest step of the screen, the tolerance of a colour sample."""


class Mutation(NamedTuple):
    """A name, the attribute that is replaced, by what, and the golden keys that must then fail."""

    name: str
    target: str
    changed: Any
    keys: tuple[str, ...]


def shifted(function: Callable[..., Any], by: float, least: float = -np.inf, most: float = np.inf) -> Any:
    return lambda *args, **named: np.clip(np.asarray(function(*args, **named), float) + by, least, most)


def scaled(function: Callable[..., Any], by: float) -> Any:
    return lambda *args, **named: np.asarray(function(*args, **named)) * by


def shifted_screen(by: float) -> Any:
    return lambda colours, depth: quantise(np.clip(colours, 0, 255) + by, depth)


def tint_before_brightness(levels: Any, effect: ColourEffect) -> Any:
    """The order filter, tint (clamped), brightness, add."""
    tinted = measured(levels, replace(effect, brightness=1.0, add=(0.0, 0.0, 0.0)))
    return measured(np.asarray(tinted), replace(effect, filters=(0.0,) * 3, tint=(0.0,) * 3))


def other_half(share: float) -> Any:
    """A tint that takes another share than a half of the two other channels."""

    def factors(tint: tuple[float, float, float]) -> Any:
        own = np.array(tint)
        return 1.0 + own - (own.sum() - own) * share

    return factors


def gamma(levels: Any, effect: ColourEffect) -> Any:
    return 255.0 * (np.asarray(measured(levels, effect)) / 255.0) ** 1.02


def wrong_template(**change: Callable[[ParticleTemplate], Any]) -> Any:
    """A simulation of another template."""

    def run(template: ParticleTemplate, *args: Any, **named: Any) -> Any:
        return simulate(replace(template, **{key: get(template) for key, get in change.items()}), *args, **named)

    return run


def no_destroyer(*args: Any, destroyed_at: float | None = None, **named: Any) -> Any:
    return simulate(*args, **named)


def in_ones_and_twos(*args: Any) -> Any:
    """Particles that appear over the first frames."""
    count, left = survivors(*args)
    return np.minimum(count, 1 + np.arange(len(count)) * 100), left


def thing_dies_with_timer(template: ParticleTemplate, frames: int, step_ms: int, random: Any) -> Any:
    count, left = survivors(
        replace(template, typeflags=template.typeflags & ~ParticleFlag.FADE), frames, step_ms, random
    )
    return count, left


def always_fade(template: ParticleTemplate, frames: int, step_ms: int, random: Any) -> Any:
    return survivors(replace(template, typeflags=template.typeflags | ParticleFlag.FADE), frames, step_ms, random)


def late_cels(template: ParticleTemplate, *args: Any) -> Any:
    return cels(replace(template, timer=template.timer * 1.02), *args)


def with_flag_seen(flag: int) -> Any:
    """A simulation in which an unused flag makes the particles 2 % larger."""

    def run(template: ParticleTemplate, *args: Any, **named: Any) -> Any:
        size = template.elementsize * (1.02 if template.typeflags & flag else 1.0)
        return simulate(replace(template, elementsize=size), *args, **named)

    return run


def add_only_above_0(add: tuple[float, float, float]) -> Any:
    return np.clip(np.array(add) / colour.FULL_ADD, 0, 1)


def redder_blinding(rank: int) -> ColourEffect:
    return ColourEffect(add=(204.0 + 8 * rank, 210.0 + 10 * rank, 200.0 + 8 * rank))


def stronger_ranks(rank: int) -> tuple[float, float]:
    return 0.3 + 0.051 * rank, 1.0


def spawn_scaled(by: float, cels: int = 1) -> Any:
    def run(*args: Any) -> Any:
        places, first = spawned(*args)
        return places * by, first * cels

    return run


def turned(by: float) -> Any:
    return lambda angle: sine_cosine(angle * by)


def of_openjkdf2(rule: Callable[..., Any]) -> Any:
    return lambda *args: rule(*args, Engine.OPENJKDF2)


measured, simulate, survivors, cels = (
    colour._as_measured,
    particles.simulate,
    particles._survivors,
    particles._cels,
)
spawned, sine_cosine = particle_spawn.spawn, particle_spawn.sine_cosine
materials = [f"particles.materials_cels.{name}" for name in MATERIAL_CELS]
samples = [f"color.sample[{i}]" for i in range(14)]
BRIGHT, DARK = (0, 2, 7, 8, 9, 10, 12), (1, 4, 5, 6, 11, 13)
centre = [f"dynamic_light.distance[0].pixel[{i}]" for i in range(7)]
close = [f"dynamic_light.at_surface_centre.pixel[{i}]" for i in (0, 1, 2, 3, 5)]
vertex = [f"dynamic_light.at_vertex.pixel[{i}]" for i in range(6)]
predicted = [f"dynamic_light.at_vertex.predicted[{i}]" for i in range(6)]
MODULE = "jktools.engine."


def mutation(name: str, target: str, changed: Any, *keys: str) -> Mutation:
    return Mutation(name, MODULE + target, changed, keys)


MUTATIONS = [
    # Colour. The samples are met to the bit; their tolerance is one step of the screen.
    mutation("screen two steps darker", "colour.quantise", shifted_screen(-2 * STEP_565), *(samples[i] for i in BRIGHT)),
    mutation("screen two steps brighter", "colour.quantise", shifted_screen(2 * STEP_565), *(samples[i] for i in DARK)),
    mutation("screen two steps darker", "colour.quantise", shifted_screen(-2 * STEP_565), samples[1], samples[3], samples[11]),
    mutation("screen two steps brighter", "colour.quantise", shifted_screen(2 * STEP_565), samples[2], samples[3]),
    mutation("add 2 % weaker", "colour.FULL_ADD", 283.0 * 1.02, samples[1], samples[3]),
    mutation("add 2 % stronger", "colour.FULL_ADD", 283.0 * 0.98, samples[1]),
    mutation("gamma 1.02", "colour._as_measured", gamma, "color.gamma_by_default"),
    mutation("5 bits of green", "framebuffer.BITS_565", (5, 5, 5), "color.framebuffer"),
    # The maximum was read from a plot whose step is that of the screen, 1 in 31.
    mutation("white at 294", "colour.FULL_ADD", 294.0, "color.max_add"),
    mutation("white at 265", "colour.FULL_ADD", 265.0, "color.max_add"),
    mutation("tint to 2.04", "colour.MAX_TINT", 2.04, "color.max_tint"),
    mutation("tint to 1.96", "colour.MAX_TINT", 1.96, "color.max_tint"),
    mutation("filter on from 0.98", "colour.filter_on", lambda v, engine=None: v < 0 or v >= 0.98, "color.filter_on"),
    mutation("filter off to -0.02", "colour.filter_on", lambda v, engine=None: v < -0.02 or v >= 1, "color.filter_on"),
    mutation("a negative add is nothing", "colour.add_shares", add_only_above_0, "color.negative_or_too_large_add"),
    mutation("2 % darker", "colour._as_measured", scaled(measured, 0.98), "color.brightness_range"),
    mutation("2 % brighter", "colour._as_measured", scaled(measured, 1.02), "color.brightness_range"),
    mutation("tint before brightness", "colour._as_measured", tint_before_brightness, "color.order"),
    mutation("half is 0.51", "colour.tint_factors", other_half(0.51), "color.equal.equal_on_all_channels_has_no_effect"),
    mutation("half is 0.49", "colour.tint_factors", other_half(0.49), "color.equal.equal_on_all_channels_has_no_effect"),
    # On colours of 0 and 255 any tint from 1 up saturates: only a weak one differs from a filter.
    mutation("half the tint", "colour.MAX_TINT", 0.98, "color.equal.filter_equals_full_tint"),
    mutation("half is 1.02", "colour.tint_factors", other_half(1.02), "color.equal.tint_under_filter"),
    mutation("blinding 2 % more", "game_effects.force_blinding", redder_blinding, "color.real_calls.kyle.cog"),
    mutation("seeing red", "game_effects.FORCE_SEEING", ColourEffect(filters=(1.0, 1.0, 1.0)), "color.real_calls.force_seeing.cog"),
    mutation("goggles 2 % brighter", "game_effects.IR_GOGGLES", (0.306, 1.0), "ir_mode.item_irgoggles.cog"),
    mutation("IR light 2 % brighter", "infrared.surface_light", scaled(infrared.surface_light, 1.02), "ir_mode.item_irgoggles.cog"),
    mutation("ranks 2 % stronger", "game_effects.force_seeing_ir", stronger_ranks, "ir_mode.force_seeing.cog", "ir_mode.first_parameter_range"),
    # Light. Twice the tolerance of 4 and of 7.5 levels is more than 2 % of every pixel.
    mutation("8 levels brighter", "light.pixel", shifted(light.pixel, 8.0, 0, 255), *centre, *close[:4], *golden_dynamic_light.OPEN),
    mutation("8 levels darker", "light.pixel", shifted(light.pixel, -8.0, 0, 255), *centre[:6], *close[1:], "dynamic_light.strong.near"),
    mutation("15 levels brighter", "light.pixel", shifted(light.pixel, 15.0, 0, 255), *vertex[:4]),
    mutation("15 levels darker", "light.pixel", shifted(light.pixel, -15.0, 0, 255), *vertex),
    mutation("2 % steeper", "light.WORLD_FALLOFF", 0.816, "dynamic_light.attenuation", centre[5]),
    mutation("2 % flatter", "light.WORLD_FALLOFF", 0.784, "dynamic_light.attenuation", centre[3]),
    mutation("2 % darker", "light.surface_brightness", scaled(light.surface_brightness, 0.98), *predicted),
    # Particles.
    mutation("places 2 % off", "particles.to_world", scaled(particles.to_world, 1.02), "particles.positions_are_local_to_thing", "particles.attached"),
    mutation("one after the other", "particles._survivors", in_ones_and_twos, "particles.all_created_at_once"),
    mutation("timer 2 % longer", "particles.simulate", wrong_template(timer=lambda t: t.timer * 1.02), "particles.timer_expiry_without_0x8", "particles.partest.template"),
    mutation("destroying does nothing", "particles.simulate", no_destroyer, "particles.destroying_the_thing"),
    mutation("the thing dies with its timer", "particles._survivors", thing_dies_with_timer, "particles.thing_dies"),
    *(
        mutation(f"places times {by}", "particle_spawn.spawn", spawn_scaled(by), "particles.spawn")
        for by in (0.98, 1.02)
    ),
    *(
        mutation(f"angles times {by}", "particle_spawn.sine_cosine", turned(by), "particles.spawn")
        for by in (0.98, 1.02)
    ),
    # A circle that is 2 % too wide is full as well: only a gap shows.
    mutation("a gap in the circle", "particle_spawn.FULL_CIRCLE", dict.fromkeys(Engine, 180 * 0.98), "particles.zero_range_means_full_circle"),
    # 0 and 16 lose one a step whatever 2 % of the rate does: the limit itself is what shows.
    mutation("rate 16 is faster", "particle_template.ParticleTemplate.lost_a_step", property(lambda t: max(1, int(t.rate * 0.125))), "particles.rate_has_a_lower_limit"),
    mutation("the rate does nothing", "particle_template.ParticleTemplate.lost_a_step", property(lambda t: 1), "particles.rate_has_a_lower_limit"),
    mutation("always fade", "particles._survivors", always_fade, "particles.rate_without_0x8"),
    mutation("cels 2 % late", "particles._cels", late_cels, "particles.cel_cycle"),
    mutation("thrust 2 % more", "particles.simulate", wrong_template(maxthrust=lambda t: t.maxthrust * 1.02), "particles.expansion", "particles.flags.0x01"),
    mutation("particles shine", "particle_template.CASTS_LIGHT", True, "particles.cast_light"),
    mutation("all clouds grow", "particles.simulate", wrong_template(typeflags=lambda t: t.typeflags | 1), "particles.motion"),
    mutation("0x02 does something", "particles.simulate", with_flag_seen(0x02), "particles.flags.0x02"),
    mutation("0x10 does something", "particles.simulate", with_flag_seen(0x10), "particles.flags.0x10"),
    mutation("no random cel", "particle_spawn.spawn", spawn_scaled(1.0, cels=0), "particles.flags.0x04"),
    # The pace of the fade is the engine's; over eight runs 2 % is less than the spread, 10 % is not.
    mutation("steps 10 % longer", "particles.LONGEST_FADE_STEP_MS", 110, "particles.flags.0x08"),
    mutation("cels 2 % late", "particles._cels", late_cels, "particles.flags.0x20"),
    mutation("size 2 % more", "particles.simulate", wrong_template(elementsize=lambda t: t.elementsize * 1.02), "particles.partest.template"),
    mutation("range 2 % more", "particles.simulate", wrong_template(range=lambda t: t.range * 1.02), "particles.partest.template"),
    mutation("one cel more", "particle_template.MATERIAL_CELS", {name: cels + 1 for name, cels in MATERIAL_CELS.items()}, *materials),
    mutation("only cogs block", "sight.thing_blocks", of_openjkdf2(sight.thing_blocks), "sight.has_los"),
    mutation("only solid walls block", "sight.surface_blocks", of_openjkdf2(sight.surface_blocks), "sight.has_los"),
]  # fmt: skip

CASES = [pytest.param(m, key, id=f"{key}: {m.name}") for m in MUTATIONS for key in m.keys]


@pytest.mark.parametrize(("mutant", "key"), CASES)
def test_mutant_is_caught(mutant: Mutation, key: str, golden: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mutant.target, mutant.changed)
    if mutant.target.endswith("particle_spawn.spawn"):
        monkeypatch.setattr(golden_particles, "spawn", mutant.changed)
    with pytest.raises(AssertionError):
        CHECKS[key](golden)
