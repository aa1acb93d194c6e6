"""Rules on files that are named: with the files beside them, with a base and without one."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.session import Settings, check
from jktools.source import InputError
from tests.support.assets import BLOCK
from tests.support.levels import gob_of, two_rooms
from tests.support.packs import write
from tests.syntax.assets.test_binary import mat

COLOUR, TEXTURE = mat([(0, 5)], [], kind=0), mat([(8, 0, 0)], [(8, 8, 0, 1)])
NAMES = (
    "Section: SOUNDS",
    "hum.wav",
    "World materials 2",
    "0: floor.mat 1 1",
    "1: gone.mat 1 1",
    "World colormaps 1",
    "0: a.cmp",
)


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def pack(name: str, *files: tuple[str, bytes], level: str = "") -> str:
    levels = [("jkl\\x.jkl", level.encode())] if level else []
    write(Path(name), gob_of([*levels, *files]))
    return name


def told(path: str, *codes: str, base: tuple[str, ...] = ()) -> list[tuple[str, str]]:
    batch = check([path], Settings(select=codes, base=base))
    assert batch.problems == []
    return [(d.code.id, d.message) for d in batch]


def rooms(*fragment: str) -> str:
    return two_rooms(*fragment)


def test_a_missing_file_is_told_only_where_the_game_is_known() -> None:
    level = rooms("World materials 2", "1: gone.mat 1 1", "World cogs 1", "0: door.cog 3 -1 wind.wav")
    mod = pack("mod.gob", ("mat\\floor.mat", TEXTURE), level=level)
    assert told(mod, "JK110", "JK111") == []
    pack("game.gob", ("mat\\dflt.mat", TEXTURE), ("cog\\door.cog", b""), ("misc\\cmp\\01narsh.cmp", b""))
    found = told(mod, "JK110", base=("game.gob",))
    assert (
        "JK110", 'material "gone.mat" is named, but neither the level\'s own files nor a base has it',
    ) in found  # fmt: skip
    assert ("JK110", 'sound "wind.wav" is named, but neither the level\'s own files nor a base has it') in found
    assert not any("floor.mat" in m or "door.cog" in m for _, m in found)


def test_files_without_which_the_level_does_not_load() -> None:
    mod = pack("mod.gob", level=rooms("World colormaps 1", "0: own.cmp"))
    pack("game.gob", ("mat\\other.mat", TEXTURE))
    found = [m for _, m in told(mod, "JK111", base=("game.gob",))]
    assert 'colormap "own.cmp" is listed, but neither the level\'s own files nor a base has it' in found
    assert any(m.endswith("a base has it, nor dflt.mat to stand in for it") for m in found)
    pack("game.gob", ("mat\\dflt.mat", TEXTURE), ("misc\\cmp\\OWN.cmp", b""))
    assert told(mod, "JK111", base=("game.gob",)) == []


def test_names_in_another_case() -> None:
    mod = pack("mod.gob", ("mat\\FLOOR.mat", TEXTURE), level=rooms("World materials 2", "1: floor.mat 1 1"))
    assert ("JK112", 'material "floor.mat" is named, but its file is spelt "FLOOR.mat"') in told(mod, "JK112")
    exact = pack("exact.gob", ("mat\\floor.mat", TEXTURE), level=rooms("World materials 2", "1: floor.mat 1 1"))
    assert told(exact, "JK112") == []


def test_colours_that_are_textured() -> None:
    level = rooms("World materials 2", "0: red.mat 1 1")
    found = told(pack("mod.gob", ("mat\\red.mat", COLOUR), level=level), "JK113")
    assert len(found) == 1
    assert 'has geometry mode 4, but its material "red.mat" is a colour, and ' in found[0][1]
    assert told(pack("tex.gob", ("mat\\red.mat", TEXTURE), level=level), "JK113") == []
    assert told(pack("none.gob", level=level), "JK113") == []
    flat = level.replace(" 4 3 1 ", " 3 3 1 ").replace(" 4 3 0 ", " 3 3 0 ")
    assert told(pack("flat.gob", ("mat\\red.mat", COLOUR), level=flat), "JK113") == []


def test_files_that_assets_name() -> None:
    mod = pack("mod.gob", ("3do\\block.3do", BLOCK.encode()), ("mat\\stone.mat", TEXTURE))
    assert told(mod, "JK140") == []
    pack("game.gob", ("mat\\other.mat", TEXTURE))
    assert told(mod, "JK140", base=("game.gob",)) == [
        ("JK140", 'material "glass.mat" is named, but neither the mod nor a base has it')
    ]
    pack("game.gob", ("3do\\mat\\GLASS.mat", TEXTURE))
    assert told(mod, "JK140", base=("game.gob",)) == []


def files(batch_path: str, *codes: str, base: tuple[str, ...] = ()) -> list[tuple[str, str]]:
    return [(d.code.id, d.path.rpartition("!")[2]) for d in check([batch_path], Settings(select=codes, base=base))]


def test_unused_and_misplaced_files() -> None:
    mod = pack(
        "mod.gob", ("mat\\floor.mat", TEXTURE), ("mat\\spare.mat", TEXTURE), ("mat\\dflt.mat", TEXTURE),
        ("sound\\said.wav", b""), ("cog\\talk.cog", b'sound a=said.wav local\n'), ("wrong\\far.mat", TEXTURE),
        ("readme.txt", b""), ("3do\\block.3do", BLOCK.encode()),
        level=rooms("World materials 2", "0: floor.mat 1 1", "World cogs 1", "0: talk.cog"),
    )  # fmt: skip
    assert files(mod, "JK150", "JK151") == [
        ("JK150", "3do/block.3do"), ("JK150", "mat/spare.mat"), ("JK151", "wrong/far.mat"),
    ]  # fmt: skip
    pack("game.gob", ("3do\\mat\\SPARE.mat", TEXTURE))
    assert files(mod, "JK150", base=("game.gob",)) == [("JK150", "3do/block.3do")]
    assert files(f"{mod}!jkl/x.jkl", "JK150") == []  # what the model names was not read


def test_stats_count_each_name_once() -> None:
    level = rooms("World materials 2", "0: floor.mat 1 1", "1: gone.mat 1 1")
    mod = pack("mod.gob", ("mat\\floor.mat", TEXTURE), ("mat\\spare.mat", TEXTURE), level=level)
    pack("game.gob", ("mat\\gone.mat", TEXTURE))
    without, with_base = (
        {s.kind: s for s in check([mod], s, stats=True).stats} for s in (Settings(), Settings(base=("game.gob",)))
    )
    assert (without["material"].own, without["material"].base, without["material"].unused) == (1, 0, 1)
    assert with_base["material"].base == 1
    assert with_base["material"].missing == without["material"].missing - 1
    assert check([mod]).stats == []


def test_a_folder_of_a_site_is_not_taken_for_a_mod(here: Path) -> None:
    """Files of the same extensions lie everywhere; only those in the game's folders are read."""
    write(here / "site/mat/bad.mat", b"no material")
    write(here / "site/music/song.wav", b"no sound")
    write(here / "site/keys/id.key", b"-----BEGIN")
    write(here / "site/x.jkl", rooms().encode())
    assert told("site", "JK03") == [
        ("JK034", "the material should go on for 76 bytes with its header, but 11 are left")
    ]
    assert told("site/music/song.wav", "JK03") != []


def test_templates_of_the_game_are_known_with_a_base() -> None:
    """JK103, JK105 and JK106 ask static.jkl; JK104 and JK107 too, since what it defines stands before the level."""
    level = rooms(
        "World templates 4", "low none type=cog", "own mother type=cog creatething=spark", "mother none type=cog",
        "far none type=cog creatething=mother", "World things 4", "3: hers x .5 1.5 .5 0 0 0 1",
    )  # fmt: skip
    codes = ("JK102", "JK103", "JK104", "JK105", "JK106", "JK107")
    mod = pack("mod.gob", level=level)
    without = {message for _, message in told(mod, *codes)}
    assert 'thing 3 (hers) names template "hers", but the level defines none of that name' in without
    assert any("spark" in m for m in without)
    static = rooms("World templates 4", "hers none type=cog", "spark none type=cog", "mother none type=cog")
    pack("game.gob", ("jkl\\static.jkl", static.encode()))
    assert not any(n in m for _, m in told(mod, *codes, base=("game.gob",)) for n in ("hers", "spark", "mother"))
    pack("game.gob", ("jkl\\static.jkl", rooms().encode()))
    found = {message for _, message in told(mod, *codes, base=("game.gob",))}
    where = "neither the level nor game.gob!jkl/static.jkl defines one of that name"
    assert f'thing 3 (hers) names template "hers", but {where}' in found
    assert any(m.endswith(f"creatething=spark, but {where}") for m in found)


def test_values_of_another_kind_than_their_symbol() -> None:
    script = b"symbols\nmessage startup\nsound noise\nmaterial paint\nmodel shape\nend\ncode\nstartup:\nreturn;\nend\n"
    level = rooms("World cogs 1", "0: door.cog wind.mat none SHAPE.3DO")
    mod = pack("mod.gob", ("cog\\door.cog", script), level=level)
    assert told(mod, "JK114") == [
        ("JK114", 'cog 0 (door.cog) gives "wind.mat" to the symbol "noise", but that takes a .wav file')
    ]
    right = pack("right.gob", ("cog\\door.cog", script), level=level.replace("wind.mat", "wind.wav"))
    assert told(right, "JK114") == []


def test_a_missing_file_is_told_once_however_it_is_named() -> None:
    level = rooms("World AIClasses 1", "0: guard.ai", "World templates 4", "guard none type=actor aiclass=guard.ai")
    mod = pack("mod.gob", level=level)
    pack("game.gob", ("mat\\wall.mat", TEXTURE))
    guards = [code for code, m in told(mod, "JK110", "JK111", base=("game.gob",)) if "guard.ai" in m]
    assert guards == ["JK111"]


def test_a_base_without_anything_of_a_game_is_refused() -> None:
    mod = pack("mod.gob", level=rooms())
    write(Path("photos/cat.jpg"), b"")
    with pytest.raises(InputError, match="cannot use photos as a base: it holds none of the game's folders"):
        check([mod], Settings(base=("photos",)))
    write(Path("photos/Resource/res.gob"), gob_of([("mat\\wall.mat", TEXTURE)]))
    assert check([mod], Settings(base=("photos",), select=("JK201",))).problems == []


def test_faces_that_texture_a_colour() -> None:
    files = [("mat\\glass.mat", COLOUR), ("mat\\stone.mat", TEXTURE)]
    mod = pack("mod.gob", ("3do\\block.3do", BLOCK.encode()), *files)
    assert told(mod, "JK142") == [
        ("JK142", 'face 0 of mesh "arm" has geometry mode 4, but its material "glass.mat" is a colour')
    ]
    plain = BLOCK.replace("0: 1 0x2 4 3 1", "0: 1 0x2 3 3 1")
    assert told(pack("plain.gob", ("3do\\block.3do", plain.encode()), *files), "JK142") == []


def test_long_names_in_assets_and_parameters() -> None:
    long, fits = "a" * 28 + ".wav", "a" * 27 + ".wav"
    mod = pack("mod.gob", ("misc\\snd\\ky.snd", f"create {long}\nfall {fits}\n".encode()))
    assert told(mod, "JK141") == [
        ("JK141", f'the file names "{long}" of 32 characters, but the engine keeps 31')
    ]  # fmt: skip
    model = "b" * 28 + ".3do"
    level = rooms(
        "World templates 4", f"box none type=cog model3d={model} size=1 orient=(1.000000000000/2.000000000/3)"
    )
    assert told(pack("level.gob", level=level), "JK012") == [
        ("JK012", f'template 3 has the name "{model}" of 32 characters, but the engine keeps 31')
    ]


GOALS = """symbols
message startup
thing player local
end
code
startup:
player = GetLocalPlayerThing();
SetInv(player, {base});
SetGoalFlags(player, {goal});
return;
end
"""


@pytest.mark.parametrize(
    ("base", "goal", "table", "wanted"),
    [
        ("99, 1000", "1, 1", "GOAL_01001", None),
        ("99, 1000", "1, 1", "goal_01001", None),
        ("99, 1000", "2, 1", "GOAL_01001", "cog 0 (goals.cog) shows goal 2, but {} has no GOAL_01002"),
        ("99, 1000", "50, 1", "GOAL_01050", "cog 0 (goals.cog) shows goal 50, but the game lists 0 to 49"),
        ("99, 1000", "-1, 1", "GOAL_00999", "cog 0 (goals.cog) shows goal -1, but the game lists 0 to 49"),
        ("99, 1000", "2, 2", "GOAL_01001", None),  # done, and never shown
        ("99, 1000", "Rand(), 1", "GOAL_01001", None),
        ("98, 1000", "2, 1", "GOAL_01001", None),  # who sets bin 99 is not known
        ("99, 1000*Rand()", "2, 1", "GOAL_01001", None),
    ],
)
def test_goals_have_a_text(base: str, goal: str, table: str, wanted: str | None) -> None:
    level = rooms("World cogs 1", "0: goals.cog")
    cog = GOALS.format(base=base, goal=goal).encode()
    texts = f'MSGS 1\n"{table}" 0 "Find it"\nEND\n'.encode()
    mod = pack("mod.gob", ("cog\\goals.cog", cog), ("misc\\cogStrings.uni", texts), level=level)
    found = [] if wanted is None else [("JK115", wanted.format("mod.gob!misc/cogStrings.uni"))]
    assert told(mod, "JK115") == found
    assert told(pack("bare.gob", ("cog\\goals.cog", cog), level=level), "JK115") == []
