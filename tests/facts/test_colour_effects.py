"""Colour effects of scripts on the level's palette."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from jktools.facts import LevelFacts
from jktools.facts.colour_effects import Shown, constant_effects, palettes, shown
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
    assert not view.is_black


def test_values_of_the_level_are_constants() -> None:
    (view,) = views("0, 0, 0, 0, 0, 0, 0, 0, 0, dim", "0.5")
    assert view.after[200].tolist() == [100, 100, 100]


def test_what_is_not_known_is_left_out() -> None:
    assert views("0, 0, 0, 0, 0, 0, 0, 0, 0, Rand()") == []


def test_black_and_white_are_told() -> None:
    (black,) = views("0, 0, 0, 0, 0, 0, 0, 0, 0, 0")
    (white,) = views("0, 0, 0, 0, 0, 0, 290, 290, 290, 1.0")
    assert (black.is_black, black.is_white) == (True, False)
    assert (white.is_black, white.is_white) == (False, True)


def test_the_palette_of_the_colormap_is_taken(tmp_path: Path) -> None:
    palette = np.zeros((256, 3), np.uint8)
    palette[:, 0] = 255  # all red: a filter that passes green and blue leaves nothing
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
    assert view.is_black
