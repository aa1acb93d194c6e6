"""A compiled level keeps the templates that it can reach, with all that they inherit, and says what it left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.facts import LevelFacts
from jktools.session import load
from tests.support.levels import level_of, two_rooms

TEMPLATES = """World templates 12
base none type=actor move=physics size=.1 thingflags=0x400
+chip none type=debris
+boom none type=explosion debris=+chip flashrgb=(1/2/3)
guard base explode=+boom
+shot none type=weapon explode=+boom
gun none type=weapon weapon=+shot
turret base weapon=+shot
lost none size=1"""

SOUNDS = ("World sounds 3", "thud.wav", "lost.wav")

DOOR = """flags=0x240
symbols
message startup
template made
template gift=+shot
thing other local
sound bang=thud.wav
end
code
startup:
    creatething(made, other);
    loadtemplate("turret");
return;
end
"""


def folder(tmp_path: Path, *, static: bool = True, cog: str = DOOR, things: str = "") -> Path:
    text = two_rooms(
        *SOUNDS, *TEMPLATES.splitlines(), "World things 9", *things.splitlines(), "World cogs 2", "0: door.cog guard"
    )
    (tmp_path / "jkl").mkdir()
    (tmp_path / "cog").mkdir()
    (tmp_path / "misc").mkdir()
    (tmp_path / "jkl/rooms.jkl").write_text(text)
    (tmp_path / "cog/door.cog").write_text(cog)
    if static:
        (tmp_path / "jkl/static.jkl").write_text("SECTION: TEMPLATES\nWorld templates 1\nnothing none type=cog\nend\n")
        (tmp_path / "misc/items.dat").write_text("# none\nend\n")
    return tmp_path / "jkl/rooms.jkl"


def compiled(path: Path, *, cut_anyway: bool = False) -> CompiledLevel:
    return CompiledLevel(compile_level(load(str(path)), CompileSettings(cut_anyway=cut_anyway)))


def names(level: CompiledLevel) -> list[str]:
    assert level.templates is not None
    return [level.strings[i] for i in level.templates.name]


def test_only_what_is_reached_stays(tmp_path: Path) -> None:
    level = compiled(folder(tmp_path))
    # walkplayer and ghost are placed; guard is a value of the COG, +shot a default, turret a string in its code;
    # +boom and +chip follow from them. crate, base and gun are reached by nothing.
    assert names(level) == ["walkplayer", "ghost", "+chip", "+boom", "guard", "+shot", "turret"]
    assert level.passes["templates"] == {"ran": True, "failed": False, "note": "7 of 10 can be reached"}
    assert level.omissions[1:] == [
        {"section": "templates", "reason": "nothing reaches them", "source": [2, 3, 8],
         "name": ["crate", "base", "gun"]},
        {"section": "templates", "reason": "the engine drops them: its type is free", "source": [10], "name": ["lost"]},
    ]  # fmt: skip


def test_only_names_that_are_reached_stay(tmp_path: Path) -> None:
    path = folder(tmp_path)
    level = compiled(path)
    assert [level.strings[i] for i in level.resources.sounds] == ["wind.wav", "thud.wav"]
    assert [level.strings[i] for i in level.resources.materials] == ["wall.mat"]
    assert level.passes["resources"] == {
        "ran": True,
        "failed": False,
        "note": "names of files that nothing reaches are left out: 1",
    }
    assert level.omissions[0] == {
        "section": "resources", "reason": "nothing reaches these sounds", "source": [2], "name": ["lost.wav"],
    }  # fmt: skip


def test_all_names_stay_while_a_file_that_names_more_is_missing(tmp_path: Path) -> None:
    placed = "1: ghost ghost .5 1.5 .5 0 90 0 1 model3d=ghost.3do"
    path = folder(tmp_path, things=placed)
    level = compiled(path)
    assert [level.strings[i] for i in level.resources.sounds] == ["wind.wav", "thud.wav", "lost.wav"]
    assert level.passes["resources"]["note"] == "all names stay: what is reached is not known without ghost.3do"
    assert level.passes["templates"]["note"] == "7 of 10 can be reached"
    cut = compiled(path, cut_anyway=True)
    assert [cut.strings[i] for i in cut.resources.sounds] == ["wind.wav", "thud.wav"]


def test_while_a_cog_is_missing_everything_stays_unless_asked(tmp_path: Path) -> None:
    path = folder(tmp_path)
    (tmp_path / "cog/door.cog").unlink()
    level = compiled(path)
    assert len(names(level)) == 10
    assert level.passes["templates"]["note"] == "all 10 stay: what they reach is not known without door.cog"
    assert [each["reason"] for each in level.omissions] == ["the engine drops them: its type is free"]
    cut = compiled(path, cut_anyway=True)
    assert names(cut) == ["walkplayer", "ghost"]
    assert cut.passes["templates"]["note"] == (
        "2 of 10 can be reached as far as is known: cut anyway, without door.cog"
    )


def test_the_games_own_cogs_must_be_at_hand_too(tmp_path: Path) -> None:
    note = compiled(folder(tmp_path, static=False)).passes["templates"]["note"]
    assert note == "all 10 stay: what they reach is not known without items.dat, static.jkl"


def test_a_script_that_the_engine_refuses_reaches_nothing(tmp_path: Path) -> None:
    assert names(compiled(folder(tmp_path, cog=DOOR.replace("return;", "return return;")))) == ["walkplayer", "ghost"]


def test_the_parameters_of_a_thing_reach_too(tmp_path: Path) -> None:
    placed = "1: ghost ghost .5 1.5 .5 0 90 0 1 creatething=gun"
    assert "gun" in names(compiled(folder(tmp_path, cog=DOOR, things=placed)))


def test_the_values_are_those_of_the_engine(tmp_path: Path) -> None:
    level = compiled(folder(tmp_path))
    table = level.templates
    assert table is not None
    at = names(level).index("guard")
    values = {}
    for i in range(table.value_start[at], table.value_start[at + 1]):
        numbers = table.number[table.number_start[i] : table.number_start[i + 1]].tolist()
        text = None if table.value_text[i] < 0 else level.strings[table.value_text[i]]
        values[level.strings[table.value_key[i]]] = (text, numbers, int(table.value_source[i]))
    tenth = float(np.float32(0.1))
    assert values == {
        "type": ("actor", [], 3), "move": ("physics", [], 3), "size": (None, [tenth], 3),
        "movesize": (None, [tenth], 3), "thingflags": (None, [0x400], 3), "explode": ("+boom", [], 6),
    }  # fmt: skip
    assert (table.type[at], table.move[at], table.has_ai[at]) == (2, 1, 1)
    boom = names(level).index("+boom")
    start, end = table.value_start[boom], table.value_start[boom + 1]
    assert [level.strings[k] for k in table.value_key[start:end]] == ["type", "flashrgb", "debris"]
    assert table.number[table.number_start[start] : table.number_start[end]].tolist() == [1, 2, 3]


def test_every_way_there_is_told(tmp_path: Path) -> None:
    reach = LevelFacts(load(str(folder(tmp_path)))).reach
    assert reach.templates["guard"] == "made of cog 0 (door.cog)"
    assert reach.templates["+shot"] == "default of gift in door.cog"
    assert reach.templates["turret"] == '"turret" in the code of door.cog'
    assert reach.templates["+chip"] == "debris of template +boom"
    assert reach.templates["walkplayer"] == "thing 0 (walkplayer) is placed"


@pytest.mark.parametrize("name", ["walkplayer", "+ssparks_wall", "+twinkle", "+backpack"])
def test_what_the_engine_creates_by_name_stays(name: str) -> None:
    level = level_of(two_rooms("World templates 4", f"{name} none type=cog"))
    assert name in LevelFacts(level).reach.templates


@pytest.mark.parametrize(("number", "name"), [("8", "gun"), ("8.9", "gun"), ("3", "base")])
def test_a_number_counts_the_templates_that_the_engine_keeps(number: str, name: str, tmp_path: Path) -> None:
    code = DOOR.replace('loadtemplate("turret")', f"creatething({number}, other)")
    assert name in names(compiled(folder(tmp_path, cog=code)))


@pytest.mark.parametrize("number", ["-1", "99", "-32768", "70000", "1e30"])
def test_a_number_beyond_them_reaches_nothing(number: str, tmp_path: Path) -> None:
    plain = names(compiled(folder(tmp_path, cog=DOOR.replace('loadtemplate("turret");', ""))))
    code = DOOR.replace('loadtemplate("turret")', f"creatething({number}, other)")
    (tmp_path / "cog/door.cog").write_text(code)
    assert names(compiled(tmp_path / "jkl/rooms.jkl")) == plain


def test_numbers_from_0x8000_on_count_the_templates_of_the_game(tmp_path: Path) -> None:
    code = DOOR.replace('loadtemplate("turret")', "creatething(0x8000, other); creatething(0x8001, other)")
    reach = LevelFacts(load(str(folder(tmp_path, cog=code)))).reach
    assert reach.templates["nothing"] == "its number in creatething of door.cog"
    assert not any("its number" in why for name, why in reach.templates.items() if name != "nothing")
