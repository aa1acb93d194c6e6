"""Colour beyond the golden samples: the decompiled engine's orders, combination, palettes, flashes, IR."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine import colour, infrared, palette, screen_tint
from jktools.engine.colour import Renderer, apply
from jktools.engine.colour_effect import MAX_EFFECTS, ColourEffect, combine, filter_on
from jktools.engine.framebuffer import Depth, pack_565, quantise, unpack_565
from jktools.engine.profile import Engine

HARDWARE = {"engine": Engine.OPENJKDF2, "renderer": Renderer.HARDWARE, "depth": Depth.RGB888}
SOFTWARE = {**HARDWARE, "renderer": Renderer.SOFTWARE}
RED_FILTER = ColourEffect(filters=(1, 0, 0))

# What the formulas of the decompiled engine give by hand: effect, input, hardware, software. Its casts cut
# towards 0, so the software tint leaves 1 of 100 where the factor is 0.
BY_HAND = [
    (RED_FILTER, [255, 255, 255], [255, 0, 0], [255, 63, 63]),
    (RED_FILTER, [100, 100, 101], [100, 0, 0], [100, 25, 25]),
    (ColourEffect(tint=(2, 0, 0), brightness=0.5), [255, 0, 0], [255, 0, 0], [128, 0, 0]),
    (ColourEffect(tint=(2, 0, 0)), [100, 100, 100], [100, 0, 0], [255, 1, 1]),
    (ColourEffect(tint=(0.5, 0, 0)), [100, 100, 100], [100, 75, 75], [150, 76, 76]),
    (ColourEffect(brightness=0.5), [255, 255, 255], [127, 127, 127], [128, 128, 128]),
    (ColourEffect(brightness=2.0), [90, 90, 90], [90, 90, 90], [90, 90, 90]),
    (ColourEffect(brightness=-1.0), [255, 255, 255], [0, 0, 0], [0, 0, 0]),
    (ColourEffect(add=(30, -5, 300), brightness=0.5), [200, 200, 200], [130, 100, 255], [115, 98, 128]),
]  # fmt: skip


@pytest.mark.parametrize(("effect", "given", "hardware", "software"), BY_HAND)
def test_both_orders_of_the_decompiled_engine(
    effect: ColourEffect, given: list[int], hardware: list[int], software: list[int]
) -> None:
    assert apply(given, effect, **HARDWARE).tolist() == hardware
    assert apply(given, effect, **SOFTWARE).tolist() == software


# The golden samples that the renderers of the decompiled engine miss. Hardware: those with an add, which it
# does linearly, except full add on black. Software: all in which anything but darkness happens.
MISSED = {Renderer.HARDWARE: {1, 2, 3, 7, 8}, Renderer.SOFTWARE: {1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 12, 13}}


@pytest.mark.parametrize("renderer", Renderer)
def test_which_golden_samples_the_decompiled_engine_meets(renderer: Renderer, golden: dict) -> None:
    missed = {
        i
        for i, case in enumerate(golden["color"]["sample"])
        if apply(case["input"], ColourEffect.from_call(case["effect"]), Engine.OPENJKDF2, renderer).tolist()
        != case["output"]
    }
    assert missed == MISSED[renderer]


def test_the_hardware_tints_the_light_not_the_texel() -> None:
    """Half lit, a red tint of 1 doubles the red light and halves the rest."""
    lit = colour.vertex_colour([0.5, 1.0, 2.0, -1.0, np.nan], ColourEffect(tint=(1, 0, 0)))
    assert lit.tolist() == [[254, 64, 64], [255, 128, 128], [255, 128, 128], [0, 0, 0], [0, 0, 0]]
    assert colour.vertex_colour(1.0, ColourEffect(), (0.5, 1.0, 0.25)).tolist() == [127, 255, 63]
    # 127.5 is cut to 127 before the colormap's 0.99 is taken of it.
    assert colour.vertex_colour(0.5, ColourEffect(), (0.99, 1.0, 1.0)).tolist() == [125, 127, 127]


def test_filters_differ_between_the_profiles_from_minus_one_to_zero() -> None:
    for value in (-2.0, -1.0, 0.0, 0.5, 1.0, 3.0):
        assert filter_on(value, Engine.RESEARCH) == filter_on(value, Engine.OPENJKDF2)
    assert filter_on(-0.5, Engine.RESEARCH)
    assert not filter_on(-0.5, Engine.OPENJKDF2)


def test_effects_combine() -> None:
    both = combine(
        [
            ColourEffect((1, 0, 0), (0.5, 0, 0), (10.9, 0, 0), 0.75),
            ColourEffect((0, 0, -1), (0.25, 1, 0), (-3, 7, 0), 0.5),
            ColourEffect(brightness=7.0),
        ]
    )
    assert both == ColourEffect((1, 0, 1), (0.75, 1, 0), (7, 7, 0), 0.5)
    assert combine([]) == ColourEffect()


def test_only_32_effects_count() -> None:
    one = ColourEffect(add=(1, 0, 0))
    assert combine([one] * MAX_EFFECTS).add == (32.0, 0.0, 0.0)
    assert combine([one] * (MAX_EFFECTS + 1)).add == (32.0, 0.0, 0.0)
    assert combine([*[one] * MAX_EFFECTS, ColourEffect(brightness=0.0)]).brightness == 1.0


def test_screens() -> None:
    """565 levels by the arithmetic of bits: 24 of 31 is 0b11000 11000 cut to 8, and so on."""
    assert quantise(np.array([[197.4, 198.3, 197.4]])).tolist() == [[0b11000110, 0b11000111, 0b11000110]]
    assert quantise(np.array([[-5.0, 300.0, np.nan]])).tolist() == [[0, 255, 0]]
    assert quantise(np.array([[0.4, 0.5, 254.5]]), Depth.RGB888).tolist() == [[0, 1, 255]]
    packed = np.arange(65536, dtype=np.uint16)
    assert np.array_equal(pack_565(unpack_565(packed)), packed)
    assert unpack_565(np.array([0xF800, 0x07E0, 0x001F], np.uint16)).tolist() == [
        [255, 0, 0],
        [0, 255, 0],
        [0, 0, 255],
    ]
    shown = unpack_565(packed)
    assert np.array_equal(quantise(shown.astype(float)), shown)


def test_images_and_palettes() -> None:
    """Each pixel of an image is drawn as it is alone."""
    random = np.random.default_rng(3)
    image = random.integers(0, 256, (4, 5, 3), dtype=np.uint8)
    effect = ColourEffect((0, 1, 1), (0, 0.3, 1.1), (20, 0, 60), 0.8)
    for engine in Engine:
        for renderer in Renderer:
            whole = apply(image, effect, engine, renderer)
            assert whole.shape == image.shape
            alone = [[apply(pixel.tolist(), effect, engine, renderer).tolist() for pixel in row] for row in image]
            assert whole.tolist() == alone
    colours = random.integers(0, 256, (256, 3), dtype=np.uint8)
    expected = apply(colours, effect, renderer=Renderer.SOFTWARE, depth=Depth.RGB888)
    assert np.array_equal(palette.under_effect(colours, effect), expected)


def test_light_and_transparency_tables() -> None:
    """A light table that names 64 * level + entry modulo 256 gives back where it was looked up."""
    table = (np.arange(64)[:, None] * 64 + np.arange(256)).astype(np.uint8)
    indices = np.array([[1, 2], [3, 250]], np.uint8)
    assert palette.shaded(indices, 0.0, table).tolist() == [[1, 2], [3, 250]]
    assert palette.shaded(indices, 1.0, table).tolist() == [[193, 194], [195, 186]]
    assert palette.light_level([-1.0, 0.0, 0.5, 1.0, 9.0, np.nan]).tolist() == [0, 0, 31, 63, 63, 0]
    through = (np.arange(256)[:, None] * 2 + np.arange(256)).astype(np.uint8)
    assert palette.seen_through(np.array([5], np.uint8), np.array([7], np.uint8), through).tolist() == [19]


@pytest.mark.parametrize(
    "call",
    [
        lambda: apply([1, 2], ColourEffect()),
        lambda: apply([1, 2, 256], ColourEffect()),
        lambda: apply([1.0, 2.0, 3.0], ColourEffect()),
        lambda: apply(3, ColourEffect()),
        lambda: ColourEffect.from_call([0] * 9),
        lambda: palette.under_effect(np.zeros((255, 3), np.uint8), ColourEffect()),
        lambda: palette.shaded(np.zeros(1, np.uint8), 0.0, np.zeros((63, 256), np.uint8)),
        lambda: palette.seen_through(np.zeros(1, np.uint8), np.zeros(1, np.uint8), np.zeros((256, 2), np.uint8)),
    ],
)
def test_what_is_no_colour_is_refused(call: object) -> None:
    assert callable(call)
    with pytest.raises(ValueError, match=r"colours|palette|table|newColorEffect"):
        call()


def test_flashes_decay() -> None:
    """From full, a tint takes 2.5 s and an add 1 s; both in whole frames of 50 a second."""
    flash = screen_tint.with_add(screen_tint.with_tint(screen_tint.Flash(), (0.8, 0.5, -1.0)), (300, 100.9, -20))
    assert flash == screen_tint.Flash((0.8, 0.5, 0.0), (255.0, 100.0, -20.0))
    flash = screen_tint.decayed(flash, 0.5)
    assert flash.tint == pytest.approx((0.6, 0.3, 0.0), abs=1e-15)
    assert flash.add == (127.0, 0.0, 0.0)
    assert screen_tint.decayed(flash, 0.01).add[0] == 124.0  # 2.56, to the nearest
    frames, flash = 0, screen_tint.Flash((1.0, 0.0, 0.0), (250.0, 0.0, 0.0))
    while flash.tint[0] > 1e-12:
        frames, flash = frames + 1, screen_tint.decayed(flash, 0.02)
        assert (flash.add[0] == 0.0) == (frames >= 50)  # 250 / 5: a frame costs 5.12, rounded
    assert frames == 125


def test_tints_of_sectors_and_damage() -> None:
    assert screen_tint.sector_effect((0.2, 3.0, -1.0)) == ColourEffect(tint=(0.2, 1.0, 0.0))
    hurt = screen_tint.with_damage(screen_tint.Flash(), 10.0)
    assert hurt.tint == pytest.approx((0.4, 0.0, 0.0), abs=1e-15)
    assert screen_tint.with_damage(hurt, 100.0).effect == ColourEffect(tint=(1.0, 0.0, 0.0))


def test_infrared_by_profile() -> None:
    extra = [0.0, 0.5, 7.0, -1.0]
    assert infrared.surface_light(0.3, extra).tolist() == [1.0] * 4
    assert infrared.surface_light(0.3, extra, Engine.OPENJKDF2).tolist() == [0.3, 0.5, 1.0, 0.3]
    assert infrared.surface_light(5.0, extra, Engine.OPENJKDF2).tolist() == [1.0] * 4
    assert [infrared.thing_ambient(v, Engine.OPENJKDF2) for v in (-1.0, 0.25, 9.0)] == [0.0, 0.25, 1.0]
    assert infrared.thing_ambient(0.0) == 1.0
