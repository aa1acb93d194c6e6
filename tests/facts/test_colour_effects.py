"""Colour effects of scripts on the level's palette."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from jktools.engine.arrays import UInt8
from jktools.engine.colour_effect import ColourEffect
from jktools.facts import LevelFacts
from jktools.facts.colour_effects import Shown, constant_effects, hidden, palettes, shown
from jktools.session import load
from tests.support.levels import level_with_files, two_rooms

COG = """symbols
message activated
flex dim
int effect local
end
code
activated:
 effect = NewColorEffect({});
end
"""


def views(arguments: str, value: str = "0.5") -> list[Shown]:
    cog = COG.format(arguments).split("\n")
    with level_with_files("World cogs 1", f"0: fx.cog {value}", "== cog/fx.cog", *cog) as level:
        return [
            view for each in constant_effects(LevelFacts(level).runners) for view in shown(each.effect, palettes(level))
        ]


def test_an_effect_is_shown_on_the_ramp_where_no_colormap_is_at_hand() -> None:
    (view,) = views("0, 1, 1, 0, 0, 0, 0, 0, 0, 1.0")
    assert view.colormap == -1
    # force_seeing.cog: the world without red.
    assert view.after[200].tolist() == [0, 200, 200]
    assert view.hides is None


def test_values_of_the_level_are_constants() -> None:
    (view,) = views("0, 0, 0, 0, 0, 0, 0, 0, 0, dim", "0.5")
    assert view.after[200].tolist() == [100, 100, 100]


def test_what_is_not_known_is_left_out() -> None:
    assert views("0, 0, 0, 0, 0, 0, 0, 0, 0, Rand()") == []


@pytest.mark.parametrize(("arguments", "hides"), [
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0", "black"),
    # 255 x 0.033 is 8.4, which is 8 of 255: one step of 31. 255 x 0.034 is 8.7, which is 9.
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0.033", "black"),
    ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0.036", None),
    # 255 x 274 / 283 is 246.9, which is 247, 8 below white; 255 x 273 / 283 is 246.0.
    ("0, 0, 0, 0, 0, 0, 274, 274, 274, 1.0", "white"),
    ("0, 0, 0, 0, 0, 0, 273, 273, 273, 1.0", None),
    ("0, 0, 0, 0, 0, 0, 290, 290, 290, 1.0", "white"),
    ("0, 0, 0, 0, 0, 0, -1, -1, -1, 1.0", "white"),
    ("0, 0, 0, 0, 0, 0, 283, 0, 0, 1.0", "one colour"),
    ("1, 0, 0, 0, 0, 0, 0, 0, 0, 1.0", None),
])  # fmt: skip
def test_what_is_black_or_white_to_the_eye(arguments: str, hides: str | None) -> None:
    (view,) = views(arguments)
    assert view.hides == hides


@pytest.mark.parametrize(("arguments", "outcomes"), [
    ("0, 0, 0, 0, 0, 0, 246, 246, 246, 1.0", [None, None, None]),
    ("0, 0, 0, 0, 0, 0, 247, 247, 247, 1.0", [None, "white", "white"]),  # plus add, not an overlay
    ("0, 0, 0, 0, 0, 0, 274, 274, 274, 1.0", ["white", "white", "white"]),
    ("0, 0, 0, 0, 0, 0, -1, -1, -1, 1.0", ["white", None, None]),  # software takes 1 away
    ("0, 0, 0, 0, 0, 0, -255, -255, -255, 1.0", ["white", None, "black"]),
    ("1, 0, 0, 0, 2, 2, 0, 0, 0, 1.0", ["black", "black", None]),  # software leaves a quarter of green and blue
])  # fmt: skip
def test_who_says_so(arguments: str, outcomes: list[str | None]) -> None:
    effect = ColourEffect.from_call([float(each) for each in arguments.split(",")])
    assert list(hidden(effect, []).values()) == outcomes


def palette_of(*channels: int) -> UInt8:
    """All shades from black to a colour."""
    return np.array([[level * channel // 255 for channel in channels] for level in range(256)], np.uint8)


DIM = ColourEffect(brightness=0.1)


def test_what_a_dark_colormap_shows_is_gone_earlier() -> None:
    # A tenth of 84 is 8.4; of 255 it is 25.
    assert list(hidden(DIM, [(0, palette_of(84, 84, 84))]).values()) == ["black"] * 3
    assert list(hidden(DIM, [(0, palette_of(255, 255, 255))]).values()) == [None] * 3


def test_an_effect_must_hide_every_colormap() -> None:
    dark, light = (0, palette_of(84, 84, 84)), (1, palette_of(255, 255, 255))
    assert not any(hidden(DIM, [dark, light]).values())
    # What shows nothing anyway is not the effect's doing.
    assert not any(hidden(DIM, [(0, palette_of(8, 8, 8))]).values())


def test_the_palette_of_the_colormap_is_taken(tmp_path: Path) -> None:
    palette = np.zeros((256, 3), np.uint8)
    palette[:, 0] = np.arange(256)  # shades of red: a filter that passes green and blue leaves nothing
    header = b"CMP " + (30).to_bytes(4, "little") + bytes(56)
    for name in ("jkl", "cog", "misc/cmp"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "misc/cmp/rooms.cmp").write_bytes(header + palette.tobytes() + bytes(64 * 256))
    (tmp_path / "cog/fx.cog").write_text(COG.format("0, 1, 1, 0, 0, 0, 0, 0, 0, 1.0"))
    (tmp_path / "jkl/rooms.jkl").write_text(two_rooms("World cogs 1", "0: fx.cog 1"))
    level = load(str(tmp_path / "jkl/rooms.jkl"))
    (each,) = constant_effects(LevelFacts(level).runners)
    (view,) = shown(each.effect, palettes(level))
    assert view.colormap == 0
    assert view.hides == "black"
