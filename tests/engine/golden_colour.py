"""What golden.toml says of colour and IR mode, one check a key: true here, false under every mutation."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from jktools.engine import colour, game_effects, infrared
from jktools.engine.colour_effect import ColourEffect, filter_on
from jktools.engine.framebuffer import Depth
from jktools.engine.profile import Engine

Check = Callable[[dict[str, Any]], None]

SAMPLES = 14
WHITE = [255, 255, 255]
EIGHTHS = [[level] * 3 for level in range(0, 256, 32)]
CORNERS = [[r, g, b] for r in (0, 255) for g in (0, 255) for b in (0, 255)]


def drawn(effect: ColourEffect, colours: Any, depth: Depth = Depth.RGB888) -> list[Any]:
    return list(colour.apply(colours, effect, depth=depth).tolist())


def uniform(**values: float) -> ColourEffect:
    """An effect that is the same on all channels."""
    same = {name: (value,) * 3 for name, value in values.items() if name != "brightness"}
    return ColourEffect(**same, brightness=values.get("brightness", 1.0))


def sample(index: int) -> Check:
    def check(golden: dict[str, Any]) -> None:
        case = golden["color"]["sample"][index]
        effect = ColourEffect.from_call(case["effect"])
        assert drawn(effect, case["input"], Depth(golden["color"]["framebuffer"])) == case["output"]

    return check


def gamma(golden: dict[str, Any]) -> None:
    assert golden["color"]["gamma_by_default"] is False
    ramp = [[level] * 3 for level in range(256)]
    assert drawn(ColourEffect(), ramp) == ramp


def framebuffer(golden: dict[str, Any]) -> None:
    """The levels of a 565 screen, by their number and by the document's triple."""
    ramp = np.repeat(np.arange(256)[:, None], 3, axis=1)
    shown = colour.apply(ramp, ColourEffect(), depth=Depth(golden["color"]["framebuffer"]))
    assert [len(np.unique(shown[:, channel])) for channel in range(3)] == [32, 64, 32]
    assert shown[198].tolist() == [198, 199, 198]


def max_add(golden: dict[str, Any]) -> None:
    """The maximum is white; a twelfth below it is not, in either depth."""
    most = golden["color"]["max_add"]
    for depth in Depth:
        assert drawn(uniform(add=most), [0, 0, 0], depth) == WHITE
        assert drawn(uniform(add=most * 11 / 12), [0, 0, 0], depth) != WHITE


def max_tint(golden: dict[str, Any]) -> None:
    """Three times as bright at the maximum, and no brighter beyond."""
    most = golden["color"]["max_tint"]
    for tint in (most, most + 1.0, 1e30):
        assert drawn(ColourEffect(tint=(tint, 0.0, 0.0)), [50, 50, 50]) == [150, 0, 0]
    assert drawn(ColourEffect(tint=(-1.0, 0.0, 0.0)), [50, 50, 50]) == [50, 50, 50]


def filters(golden: dict[str, Any]) -> None:
    assert golden["color"]["filter_on"] == "value < 0 or value >= 1"
    for value in (-100.0, -1.0, -0.5, -0.01, 0.0, 0.01, 0.5, 0.99, 1.0, 1.5, 100.0):
        on = value < 0 or value >= 1
        assert drawn(ColourEffect(filters=(value, 0.0, 0.0)), WHITE) == ([255, 0, 0] if on else WHITE)
    assert not filter_on(-0.5, Engine.OPENJKDF2)


def white_add(golden: dict[str, Any]) -> None:
    assert golden["color"]["negative_or_too_large_add"] == "white"
    for add in (-1.0, -290.0, 291.0, 1000.0, 1e30, -1e30):
        assert drawn(uniform(add=add), EIGHTHS) == [WHITE] * len(EIGHTHS)


def brightness(golden: dict[str, Any]) -> None:
    """Linear between the ends of its range, clamped outside, and never brightening."""
    low, high = golden["color"]["brightness_range"]
    for asked in (low, 0.125, 0.25, 0.5, 0.75, high, low - 0.5, high + 0.5, 1e30, -1e30):
        share = min(max(asked, low), high)
        assert drawn(uniform(brightness=asked), [[200, 200, 200]]) == [[200 * share] * 3]


def order(golden: dict[str, Any]) -> None:
    """Step by step in the document's order, each step clamped: the same as the table."""
    steps = golden["color"]["order"]
    assert sorted(steps) == ["add", "brightness", "filter", "tint"]
    for case in [*golden["color"]["sample"], {"effect": [1, 1, 0, 0.5, 1, 0, 20, 0, 40, 0.6]}]:
        for level in (0, 64, 255):
            expected = np.full(3, float(level))
            for step in steps:
                expected = np.clip(one_step(step, expected, case["effect"]), 0.0, 255.0)
            got = drawn(ColourEffect.from_call(case["effect"]), [level] * 3)
            assert np.abs(got - expected).max() <= 1.0  # the screen and the light are whole numbers


def one_step(step: str, colours: Any, effect: list[float]) -> Any:
    """One step of a colour effect, written down on its own from the document."""
    filters, tint, add = (np.array(effect[i : i + 3], float) for i in (0, 3, 6))
    if step == "filter":
        return colours * (filters >= 1) if (filters >= 1).any() else colours
    if step == "brightness":
        return colours * effect[9]
    if step == "tint":
        return colours * (1 + tint - (tint.sum() - tint) / 2)
    share = np.minimum(add / colour.FULL_ADD, 1)
    return colours * (1 - share.max()) + 255 * share


def equal_channels(golden: dict[str, Any]) -> None:
    assert golden["color"]["equal"]["equal_on_all_channels_has_no_effect"] == ["filter", "tint"]
    for strength in (1.0, 2.0):
        assert drawn(uniform(filters=strength), EIGHTHS) == EIGHTHS
        assert drawn(uniform(tint=strength), EIGHTHS) == EIGHTHS


def same_picture(key: str) -> Check:
    def check(golden: dict[str, Any]) -> None:
        for left, right in golden["color"]["equal"][key]:
            pair = [drawn(ColourEffect.from_call(call), CORNERS) for call in (left, right)]
            assert pair[0] == pair[1] != CORNERS

    return check


def numbers(text: str, rank: int) -> list[float]:
    """The arguments of a call quoted in golden.toml, with the jedi rank put in."""
    inside = re.search(r"\((.*?)\)", text)
    assert inside
    terms = [part.strip() for part in inside[1].split(",")]
    return [sum(_product(piece, rank) for piece in term.split("+")) for term in terms]


def _product(piece: str, rank: int) -> float:
    value = 1.0
    for factor in piece.split("*"):
        value *= rank if factor.strip() == "rank" else float(factor)
    return value


def blinding(golden: dict[str, Any]) -> None:
    text = golden["color"]["real_calls"]["kyle.cog"]
    for rank in game_effects.JEDI_RANKS:
        assert game_effects.force_blinding(rank) == ColourEffect.from_call(numbers(text, rank))
    assert list(game_effects.JEDI_RANKS) == list(range(9))
    assert text.endswith("rank 0..8")


def seeing(golden: dict[str, Any]) -> None:
    call = numbers(golden["color"]["real_calls"]["force_seeing.cog"], 0)
    assert ColourEffect.from_call(call) == game_effects.FORCE_SEEING


def goggles(golden: dict[str, Any]) -> None:
    """The arguments, and what the decompiled engine does with them."""
    assert list(game_effects.IR_GOGGLES) == golden["ir_mode"]["item_irgoggles.cog"]
    world, thing = game_effects.IR_GOGGLES
    assert infrared.surface_light(world, [0.0, 0.5], Engine.OPENJKDF2).tolist() == [0.3, 0.5]
    assert infrared.thing_ambient(thing, Engine.OPENJKDF2) == 1.0


def seeing_ir(golden: dict[str, Any]) -> None:
    for rank in game_effects.JEDI_RANKS:
        world, thing = numbers(golden["ir_mode"]["force_seeing.cog"], rank)
        assert game_effects.force_seeing_ir(rank) == (world, thing)


def ir_range(golden: dict[str, Any]) -> None:
    seen = [game_effects.force_seeing_ir(rank)[0] for rank in game_effects.JEDI_RANKS]
    assert np.allclose([min(seen), max(seen)], golden["ir_mode"]["first_parameter_range"], rtol=1e-12)


CHECKS: dict[str, Check] = {
    **{f"color.sample[{i}]": sample(i) for i in range(SAMPLES)},
    "color.gamma_by_default": gamma,
    "color.framebuffer": framebuffer,
    "color.max_add": max_add,
    "color.max_tint": max_tint,
    "color.filter_on": filters,
    "color.negative_or_too_large_add": white_add,
    "color.brightness_range": brightness,
    "color.order": order,
    "color.equal.equal_on_all_channels_has_no_effect": equal_channels,
    "color.equal.filter_equals_full_tint": same_picture("filter_equals_full_tint"),
    "color.equal.tint_under_filter": same_picture("tint_under_filter"),
    "color.real_calls.kyle.cog": blinding,
    "color.real_calls.force_seeing.cog": seeing,
    "ir_mode.item_irgoggles.cog": goggles,
    "ir_mode.force_seeing.cog": seeing_ir,
    "ir_mode.first_parameter_range": ir_range,
}
