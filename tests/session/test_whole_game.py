"""A mod beside a whole game: what is there, what is not, and what a compiled level keeps of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from jktools.compiler import CompiledLevel, compile_level
from jktools.facts import LevelFacts
from jktools.model.resources import Kind
from jktools.session import Settings, check, load
from tests.support.fake_game import GAME, MOD, install


def told(folder: Path, *, without: str = "") -> list[tuple[str, str]]:
    """Code and message of every finding, where one file is missing."""
    mod, game = install(folder, without=without)
    return [(d.code.id, d.message) for d in check([str(mod)], Settings(base=(str(game),)))]


def test_nothing_is_told_where_every_file_is_there(tmp_path: Path) -> None:
    assert told(tmp_path) == []


def test_the_game_itself_is_clean(tmp_path: Path) -> None:
    _, game = install(tmp_path)
    found = check([str(game)], Settings(base=(str(game),)))
    assert [(d.code.id, d.message) for d in found] == []


NEITHER = "neither the level's own files nor a base has it"
MOD_NEITHER = "neither the mod nor a base has it"

MISSING = {
    "misc/cmp/rooms.cmp": ("JK111", f'colormap "rooms.cmp" is listed, but {NEITHER}'),
    "3do/key/lost.key": ("JK111", f'keyframe "lost.key" is listed, but {NEITHER}'),
    "mat/wall.mat": ("JK110", f'material "wall.mat" is named, but {NEITHER}'),
    "misc/ai/guard.ai": ("JK110", f'aiclass "guard.ai" is named, but {NEITHER}'),
    "misc/spr/flash.spr": ("JK110", f'sprite "flash.spr" is named, but {NEITHER}'),
    "misc/par/smoke.par": ("JK110", f'particles "smoke.par" is named, but {NEITHER}'),
    "misc/pup/ky.pup": ("JK110", f'puppet "ky.pup" is named, but {NEITHER}'),
    "misc/snd/ky.snd": ("JK110", f'soundclass "ky.snd" is named, but {NEITHER}'),
    "3do/ky.3do": ("JK110", f'model "ky.3do" is named, but {NEITHER}'),
    "sound/wind.wav": ("JK110", f'sound "wind.wav" is named, but {NEITHER}'),
    "voice/hello.wav": ("JK110", f'sound "hello.wav" is named, but {NEITHER}'),
    "cog/kyle.cog": ("JK110", f'cog "kyle.cog" is named, but {NEITHER}'),
    "cog/door.cog": ("JK110", f'cog "door.cog" is named, but {NEITHER}'),
    "3do/mat/stone.mat": ("JK140", f'material "stone.mat" is named, but {MOD_NEITHER}'),
    "jkl/rooms.jkl": ("JK140", f'level "rooms.jkl" is named, but {MOD_NEITHER}'),
}


@pytest.mark.parametrize("name", MISSING)
def test_a_missing_file_is_told_once_where_it_is_named(name: str, tmp_path: Path) -> None:
    expected = [MISSING[name]]
    if name == "mat/wall.mat":  # a model of the mod has it too, and each file is told of its own names
        expected = [("JK140", f'material "wall.mat" is named, but {MOD_NEITHER}'), *expected]
    assert told(tmp_path, without=name) == expected


@pytest.mark.parametrize(
    ("default", "kind", "name"), [("misc/ai/default.ai", "aiclass", "guard.ai"), ("mat/dflt.mat", "material", "x.mat")]
)
def test_without_the_default_file_a_missing_one_fails_the_level(
    default: str, kind: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed = str(MOD["jkl/rooms.jkl"])
    monkeypatch.setitem(MOD, "jkl/rooms.jkl", listed.replace("1: lost.mat", "1: x.mat"))
    monkeypatch.delitem(GAME, "misc/ai/guard.ai")
    found = told(tmp_path, without=default)
    shown = default.rpartition("/")[2]
    message = f'{kind} "{name}" is listed, but {NEITHER}, nor {shown} to stand in for it'
    assert ("JK111", message) in found
    assert [code for code, text in found if f'"{name}"' in text] == ["JK111"]


def test_without_a_base_no_name_is_told_missing(tmp_path: Path) -> None:
    mod, _ = install(tmp_path)
    # the parents of walkplayer and guard are in the game's static.jkl
    assert [d.code.id for d in check([str(mod)], Settings())] == ["JK104", "JK104"]


def test_usage_is_counted(tmp_path: Path) -> None:
    mod, game = install(tmp_path, without="voice/hello.wav")
    stats = check([str(mod)], Settings(base=(str(game),)), stats=True).stats
    assert {c.kind: (c.own, c.base, c.missing, c.unused) for c in stats} == {
        "material": (2, 3, 0, 0),  # stone and glass; wall, lost and smoke
        "model": (2, 1, 0, 0),  # block and lost; ky
        "sprite": (1, 1, 0, 0),
        "keyframe": (1, 1, 0, 0),
        "puppet": (0, 1, 0, 0),
        "soundclass": (0, 1, 0, 0),
        "sound": (1, 2, 1, 0),  # lost; wind and step; hello
        "aiclass": (0, 1, 0, 0),
        "particles": (0, 1, 0, 0),
        "colormap": (0, 1, 0, 0),
        "cog": (2, 1, 0, 0),  # door and lost; kyle
        "level": (1, 0, 0, 0),
    }


LEFT = {
    "sounds": ["lost.wav"],
    "models": ["lost.3do"],
    "sprites": ["lost.spr"],
    "keyframes": ["lost.key"],
    "cogscripts": ["lost.cog"],
    "templates": ["crate", "parent", "lost_bit", "lost"],
}


def test_the_compiled_level_keeps_what_play_can_reach(tmp_path: Path) -> None:
    mod, game = install(tmp_path)
    level = CompiledLevel(compile_level(load(f"{mod}!jkl/rooms.jkl", base=[str(game)])))
    assert level.templates is not None
    assert [level.strings[i] for i in level.templates.name] == [
        "walkplayer", "ghost", "bit", "smoke", "bang", "guard", "by_static", "by_item", "by_value", "by_literal",
        "child", "+twinkle",
    ]  # fmt: skip
    resources = level.resources
    kept = {
        name: [level.strings[i] for i in getattr(resources, name)]
        for name in ("sounds", "materials", "models", "sprites", "keyframes", "soundclasses")
    }
    assert kept == {
        "sounds": ["wind.wav", "step.wav", "hello.wav"],
        "materials": ["wall.mat", "lost.mat"],  # surfaces count the list
        "models": ["ky.3do", "block.3do"],
        "sprites": ["flash.spr"],
        "keyframes": ["kystand.key"],
        "soundclasses": ["ky.snd"],
    }
    left = [(each["section"], each["reason"], each["name"]) for each in level.omissions]
    assert left == [
        *(("resources", f"nothing reaches these {key}", LEFT[key]) for key in list(LEFT)[:-1]),
        ("templates", "nothing reaches them", LEFT["templates"]),
    ]
    assert level.passes["templates"]["note"] == "12 of 16 can be reached"


REACHED = {
    Kind.MATERIAL: {"wall.mat", "stone.mat", "glass.mat", "kyle.mat", "saber.mat", "flash.mat", "smoke.mat"},
    Kind.MODEL: {"ky.3do", "block.3do"},
    Kind.SPRITE: {"flash.spr"},
    Kind.KEYFRAME: {"kystand.key"},
    Kind.PUPPET: {"ky.pup"},
    Kind.SOUND_CLASS: {"ky.snd"},
    Kind.SOUND: {"wind.wav", "step.wav", "hello.wav"},
    Kind.AI_CLASS: {"guard.ai"},
    Kind.PARTICLES: {"smoke.par"},
    Kind.COLORMAP: {"rooms.cmp"},
    Kind.COG: {"door.cog", "kyle.cog", "fists.cog", "everywhere.cog"},
    Kind.ITEMS: {"items.dat"},
}


def test_files_are_reached_through_files(tmp_path: Path) -> None:
    mod, game = install(tmp_path)
    reach = LevelFacts(load(f"{mod}!jkl/rooms.jkl", base=[str(game)])).reach
    assert {kind: set(names) for kind, names in reach.files.items() if names} == REACHED
    assert reach.unread == reach.missing == ()


@pytest.mark.parametrize("name", ["kyle.cog", "fists.cog", "everywhere.cog"])
def test_a_missing_cog_of_the_game_keeps_every_template(name: str, tmp_path: Path) -> None:
    mod, game = install(tmp_path, without=f"cog/{name}")
    level = CompiledLevel(compile_level(load(f"{mod}!jkl/rooms.jkl", base=[str(game)])))
    assert level.passes["templates"]["note"] == f"all 16 stay: what they reach is not known without {name}"


def test_a_parent_of_the_game_gives_its_values(tmp_path: Path) -> None:
    mod, game = install(tmp_path)
    held = load(f"{mod}!jkl/rooms.jkl", base=[str(game)]).resolved_templates.get("guard")
    assert held is not None
    assert (held.type, held.move, held.number("size"), held.leaves_level) == (
        "actor",
        "physics",
        float(np.float32(0.065)),
        False,
    )
    alone = load(f"{mod}!jkl/rooms.jkl").resolved_templates.get("guard")
    assert alone is not None
    assert alone.leaves_level
