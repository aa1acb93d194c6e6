"""The document's experiments on colour, on what the compiled level says its colours become under each effect.

The document measured regions of its test texture on the screen; here a region is its colour's place in the palette. The
file holds colours of 8 bits a channel; the screen of the document had 5, 6 and 5.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
import pytest

from fixtures.smithdev.chambers.colour_room import REGIONS, SECTIONS, SIDE
from fixtures.smithdev.pack import GOB
from jktools.engine import infrared
from jktools.engine.framebuffer import quantise
from jktools.engine.profile import Engine
from jktools.source import resolve
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, Experiment

ROOM = "colour_room"
BLACK, RED, GREEN, BLUE, YELLOW = (0, 0, 0), (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0)
WHITE = (255, 255, 255)
MEASURED = (BLACK, RED, GREEN, BLUE, YELLOW, WHITE)
"""The regions that the document measured; magenta and cyan have no exact match in its palette, nor in ours."""
STEP_565 = 255 / 31
"""The coarsest step of a screen of 5, 6 and 5 bits."""
Color = tuple[int, int, int]


@cache
def packed(member: str) -> bytes:
    """A file of the pack."""
    found = resolve(f"{GOB}!{member}")
    return bytes(found.read().data)  # type: ignore[union-attr]


def palette() -> np.ndarray[Any, Any]:
    """The 256 colours of smithdev.cmp: behind its header of 64 bytes."""
    return np.frombuffer(packed("misc/cmp/smithdev.cmp")[64 : 64 + 768], np.uint8).reshape(256, 3)


def after(smithdev: Experiment, effect: Sequence[float], cog: str = "effects") -> np.ndarray[Any, Any]:
    """(256, 3): the palette under a call that the room's script makes, on the document's screen."""
    held = smithdev.level.colour_effects
    assert held is not None
    same = (np.abs(held.argument - np.array(effect)) < 1e-6).all(axis=1)
    rows = np.flatnonzero(same & (held.cog == smithdev.cog(f"{ROOM}/{cog}")) & (held.colormap == 0))
    assert len(rows) >= 1, effect
    assert GOLDEN["color"]["framebuffer"] == "rgb565"
    return quantise(np.asarray(held.palette[rows[0]], np.float64).reshape(256, 3))


def shown(smithdev: Experiment, effect: Sequence[float], color: Color, cog: str = "effects") -> Color:
    """What becomes of a colour that the palette holds exactly."""
    (places,) = np.nonzero((palette() == np.array(color)).all(axis=1))
    red, green, blue = after(smithdev, effect, cog)[places[0]].tolist()
    return red, green, blue


def picture(smithdev: Experiment, effect: Sequence[float]) -> list[Color]:
    """The regions that the document measured, under an effect."""
    return [shown(smithdev, effect, color) for color in MEASURED]


def call(filters: Any = 0, tint: Any = 0, add: Any = 0, brightness: float = 1) -> list[float]:
    """Ten arguments; one number stands for three."""
    spread = [[each] * 3 if isinstance(each, (int, float)) else list(each) for each in (filters, tint, add)]
    return [*spread[0], *spread[1], *spread[2], brightness]


def samples(smithdev: Experiment, *effects: Sequence[float]) -> None:
    """What the document read off its screen under these effects, to the last bit."""
    measured = [each for each in GOLDEN["color"]["sample"] if each["effect"] in [list(e) for e in effects]]
    assert len({tuple(each["effect"]) for each in measured}) == len(effects)
    for each in measured:
        assert shown(smithdev, each["effect"], tuple(each["input"])) == tuple(each["output"]), each


def test_every_sample_of_the_document_is_a_call_of_the_room(smithdev: Experiment) -> None:
    in_room = {tuple(map(float, each)) for calls in SECTIONS.values() for each in calls}
    for each in in_room:
        after(smithdev, each)
    assert {tuple(map(float, sample["effect"])) for sample in GOLDEN["color"]["sample"]} <= in_room


def test_the_switches_make_the_calls_that_the_compiled_level_has(smithdev: Experiment) -> None:
    """In play: `sd_effects.cog` one call a press and none behind the last, the others on and off by turns."""
    held = smithdev.level.colour_effects
    assert held is not None
    play = Play(smithdev, f"{ROOM}/door")
    number = len([call for calls in SECTIONS.values() for call in calls])
    scripts = {"effects": number, "blinding 0": 1, "blinding 8": 1, "seeing 0": 1, "seeing 8": 1}
    for switch, (script, calls) in enumerate(scripts.items()):
        before = len(play.effects)
        for _ in range(calls):
            play.press(f"switch {switch}")
            assert play.effect == len(play.effects) - 1
        play.press(f"switch {switch}")
        assert play.effect is None, "the last press ends it"
        made = {tuple(round(value, 4) for value in call) for call in play.effects[before:]}
        assert len(play.effects) - before == calls
        rows = np.flatnonzero(held.cog == smithdev.cog(f"{ROOM}/{script}"))
        assert {tuple(round(float(value), 4) for value in held.argument[row]) for row in rows} == made


def test_color_effects(smithdev: Experiment) -> None:
    """The test texture: all regions but magenta and cyan are in the palette exactly, and at their place."""
    pixels = packed("mat/sd_rgb.mat")[-SIDE * SIDE :]
    for y, row in enumerate(REGIONS):
        for x, color in enumerate(row):
            at = (y * SIDE // 4 + SIDE // 8) * SIDE + x * SIDE // 3 + SIDE // 6
            drawn = tuple(palette()[pixels[at]].tolist())
            assert (drawn == color) is (color in MEASURED), color
    assert picture(smithdev, call()) == list(MEASURED)


def test_color_correction(smithdev: Experiment) -> None:
    """A grey gradient comes out as it went in, but for the steps of the screen: no gamma."""
    assert GOLDEN["color"]["gamma_by_default"] is False
    greys = packed("mat/sd_grey.mat")[-SIDE * SIDE :][:SIDE]
    before, drawn = palette()[list(greys)].astype(int), after(smithdev, call())[list(greys)].astype(int)
    assert before[0].tolist() == [0, 0, 0] and before[-1].tolist() == [255, 255, 255]
    assert (np.diff(before[:, 0]) >= 0).all() and (np.diff(drawn, axis=0) >= 0).all()
    assert np.abs(drawn - before).max() <= STEP_565 / 2 + 0.5


def test_initial_discussion(smithdev: Experiment) -> None:
    """All zeros and a brightness of 1 change nothing."""
    samples(smithdev, call())
    assert picture(smithdev, call()) == list(MEASURED)


def test_add(smithdev: Experiment) -> None:
    samples(smithdev, call(add=220), call(add=(145, 145, 0)))
    # A negative add is white, and so is one past the greatest.
    assert GOLDEN["color"]["negative_or_too_large_add"] == "white"
    for x in (-1, GOLDEN["color"]["max_add"], 320):
        assert picture(smithdev, call(add=x)) == [WHITE] * len(MEASURED)
    # "The response curve appears essentially linear", measured on black.
    steps = (64, 128, 192, 220, 256)
    drawn = np.array([shown(smithdev, call(add=x), BLACK) for x in steps], float)
    slope = drawn / np.array(steps)[:, None]
    assert np.abs(drawn - np.array(steps)[:, None] * slope.mean()).max() < STEP_565
    # "Some slight deviation across color channels": six bits of green, five of the others.
    assert {tuple(row == row[0]) for row in drawn} == {(True, True, True), (True, False, True)}


def test_tint(smithdev: Experiment) -> None:
    """From 0 to 2: what lies outside does as the ends do, and a tint of all channels does nothing."""
    assert GOLDEN["color"]["max_tint"] == 2.0
    assert picture(smithdev, call(tint=(-0.5, 0, 0))) == list(MEASURED)
    assert picture(smithdev, call(tint=(2.5, 0, 0))) == picture(smithdev, call(tint=(2, 0, 0)))
    assert shown(smithdev, call(tint=(2, 0, 0)), WHITE) == (255, 0, 0)
    rests = [shown(smithdev, call(tint=(x, 0, 0)), WHITE)[1] for x in (0.5, 1, 1.5, 2)]
    assert np.abs(np.diff([255, *rests]) + 255 / 4).max() <= 255 / 63
    assert "tint" in GOLDEN["color"]["equal"]["equal_on_all_channels_has_no_effect"]
    for x in (1, 2):
        assert picture(smithdev, call(tint=x)) == list(MEASURED)


def test_filter(smithdev: Experiment) -> None:
    """A switch: below 0 and from 1 on; a channel that is off becomes black."""
    assert GOLDEN["color"]["filter_on"] == "value < 0 or value >= 1"
    on = [shown(smithdev, call((x, 0, 0)), WHITE) == (255, 0, 0) for x in (-1, -0.5, 0.5, 1, 2)]
    assert on == [True, True, False, True, True]
    samples(smithdev, call((1, 0, 1)))
    for filters in ((1, 1, 0), (1, 0, 1), (0, 1, 1)):
        expected = [tuple(c * f for c, f in zip(color, filters, strict=True)) for color in MEASURED]
        assert picture(smithdev, call(filters)) == expected
    assert "filter" in GOLDEN["color"]["equal"]["equal_on_all_channels_has_no_effect"]
    assert picture(smithdev, call(1)) == list(MEASURED)


def test_brightness(smithdev: Experiment) -> None:
    samples(smithdev, call(brightness=0))
    low, high = GOLDEN["color"]["brightness_range"]
    assert (low, high) == (0.0, 1.0)
    assert picture(smithdev, call(brightness=-0.5)) == [BLACK] * len(MEASURED)
    assert picture(smithdev, call(brightness=1.5)) == list(MEASURED)
    for part in (0.25, 0.5, 0.75):
        assert np.abs(np.array(shown(smithdev, call(brightness=part), WHITE)) - 255 * part).max() <= STEP_565 / 2 + 0.5


def test_filter_vs_tint(smithdev: Experiment) -> None:
    for left, right in GOLDEN["color"]["equal"]["filter_equals_full_tint"]:
        assert picture(smithdev, left) == picture(smithdev, right) != list(MEASURED)


def test_filter_and_tint_combinations(smithdev: Experiment) -> None:
    samples(smithdev, call((1, 0, 0), (0, 2, 2)), call((1, 0, 0), (0, 1, 1)))
    for tint in ((0, 2, 2), (0, 1, 1)):
        assert picture(smithdev, call((1, 0, 0), tint)) == [BLACK] * len(MEASURED)
    for left, right in GOLDEN["color"]["equal"]["tint_under_filter"]:
        assert picture(smithdev, left) == picture(smithdev, right) != list(MEASURED)


def test_filter_tint_and_add_combinations(smithdev: Experiment) -> None:
    green = (0, GOLDEN["color"]["max_add"], 0)
    samples(smithdev, call((1, 0, 0), add=green), call(tint=(2, 0, 0), add=green))
    for effect in (call((1, 0, 0), add=green), call(tint=(2, 0, 0), add=green)):
        assert picture(smithdev, effect) == [GREEN] * len(MEASURED)


def test_add_and_brightness(smithdev: Experiment) -> None:
    """The document expected 191, 191, 63 at a quarter of the brightness, and measured less."""
    samples(smithdev, call(add=(0, 290, 0), brightness=0), call(add=(145, 145, 0), brightness=0.25))
    assert shown(smithdev, call(add=(145, 145, 0), brightness=0.25), WHITE) < (191, 191, 63)


def test_tint_and_brightness(smithdev: Experiment) -> None:
    samples(smithdev, call(tint=(2, 0, 0), brightness=0.5))


def test_filter_and_brightness(smithdev: Experiment) -> None:
    samples(smithdev, call((1, 0, 0), brightness=0.5))


def test_filter_and_brightness_and_tint(smithdev: Experiment) -> None:
    assert GOLDEN["color"]["order"] == ["filter", "brightness", "tint", "add"]
    samples(smithdev, call((1, 0, 0), (2, 0, 0), brightness=0.5))


def arguments(call: str, rank: int) -> list[float]:
    """The numbers of a call as the document quotes it, at a jedi rank."""
    inside, _, rest = call.partition("(")[2].partition(")")
    assert rest in ("", ", rank 0..8")
    return [float(eval(word, {"__builtins__": {}}, {"rank": rank})) for word in inside.split(",")]


def test_coloreffect_according_to_datamaster(smithdev: Experiment) -> None:
    """Its ranges hold for the game's own calls, of which the greatest is just the greatest add.

    `sd_blinding.cog` and `sd_seeing.cog` in play make those calls, to the number.
    """
    real, play = GOLDEN["color"]["real_calls"], Play(smithdev, f"{ROOM}/door")
    for i, rank in enumerate((0, 8), start=1):
        play.press(f"switch {i}")
        play.press(f"switch {i + 2}")
        blinding, seeing = (arguments(real[script], rank) for script in ("kyle.cog", "force_seeing.cog"))
        assert play.effects[-2:] == [tuple(blinding), tuple(seeing)]
        drawn = shown(smithdev, blinding, BLACK, f"blinding {rank}")
        assert drawn[1] > drawn[0] == drawn[2] or drawn[1] == 255
        assert (drawn[1] == 255) is (max(blinding[6:9]) >= GOLDEN["color"]["max_add"])
        seen = after(smithdev, seeing, f"seeing {rank}")
        assert not seen[:, 0].any() and seen[:, 1:].any(axis=0).all()


def test_ir_mode(smithdev: Experiment) -> None:
    """Fully lit in the document; by the decompiled engine at the first argument, which runs from 0.3 to 0.7 by rank.

    `sd_seeing.cog` in play, placed for rank 0 and for rank 8; its second press ends it.
    """
    play, levels = Play(smithdev, f"{ROOM}/door"), []
    for switch, rank in (("switch 3", 0), ("switch 4", 8)):
        play.press(switch)
        assert play.infrared is not None
        assert play.infrared == pytest.approx(arguments(GOLDEN["ir_mode"]["force_seeing.cog"], rank)[0], rel=1e-6)
        levels.append(play.infrared)
        play.press(switch)
        assert play.infrared is None
    assert levels == pytest.approx(GOLDEN["ir_mode"]["first_parameter_range"], rel=1e-6)
    assert levels[0] == pytest.approx(GOLDEN["ir_mode"]["item_irgoggles.cog"][0], rel=1e-6)
    extra = smithdev.level.surface_extra_light
    assert (infrared.surface_light(levels[0], extra, Engine.RESEARCH) == 1).all()
    for level in levels:
        assert infrared.surface_light(level, extra, Engine.OPENJKDF2) == pytest.approx(np.maximum(extra, level))
