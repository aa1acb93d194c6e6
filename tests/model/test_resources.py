"""The files of a level: the engine's folders, pack before base, and what is kept of them."""

from __future__ import annotations

from pathlib import Path

import pytest

import jktools
from jktools.model import resources as module
from jktools.model.resources import Kind, Library, Resources
from jktools.source import Member, resolve
from tests.support.assets import BLOCK
from tests.support.levels import TWO_ROOMS, gob_of
from tests.support.packs import write

ROOMS = TWO_ROOMS.encode()
BLOCK_DATA = BLOCK.encode()


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    mod = [("jkl\\x.jkl", ROOMS), ("mat\\own.mat", b"pack"), ("3do\\MAT\\skin.mat", b"skin"), ("voice\\hi.wav", b"v")]
    write(tmp_path / "mod.gob", gob_of(mod))
    game = [
        ("mat\\skin.mat", b"game skin"), ("mat\\own.mat", b"game"), ("mat\\dflt.mat", b"dflt"), ("sound\\hi.wav", b"s"),
        ("3do\\block.3do", BLOCK_DATA), ("jkl\\static.jkl", ROOMS),
    ]  # fmt: skip
    write(tmp_path / "game/resource/res.gob", gob_of(game))


def content(resources: Resources, kind: Kind, name: str) -> bytes | None:
    found = resources.find(kind, name)
    return None if found is None else bytes(resources.read(found).data)


def test_the_engines_folders_and_order() -> None:
    files = jktools.load("mod.gob!jkl/x.jkl", base=["game"]).resources
    assert files.has_base
    assert content(files, Kind.MATERIAL, "OWN.mat") == b"pack"
    # The path `mat/skin.mat` is tried in every pack before `3do/mat/skin.mat`; so is `sound` before `voice`.
    assert content(files, Kind.MATERIAL, "skin.mat") == b"game skin"
    assert content(files, Kind.SOUND, "hi.wav") == b"s"
    assert content(files, Kind.MODEL, "none.3do") is None
    own, theirs = files.find(Kind.MATERIAL, "own.mat"), files.find(Kind.MATERIAL, "skin.mat")
    assert own is not None
    assert theirs is not None
    assert (own.own, own.folder, own.path) == (True, "mat", "mod.gob!mat/own.mat")
    assert (theirs.own, theirs.path) == (False, "game/resource/res.gob!mat/skin.mat")


def test_default_files_stand_in() -> None:
    files = jktools.load("mod.gob!jkl/x.jkl", base=["game"]).resources
    default = files.default(Kind.MATERIAL)
    assert default is not None
    assert default.path.endswith("mat/dflt.mat")
    assert files.default(Kind.MODEL) is None
    assert files.default(Kind.SOUND) is None
    assert files.static is not None


def test_without_a_base_only_the_levels_own_files_are_known() -> None:
    files = jktools.load("mod.gob!jkl/x.jkl").resources
    assert not files.has_base
    assert content(files, Kind.MATERIAL, "skin.mat") == b"skin"
    assert files.static is None
    assert [(k.title, m.name) for k, m in files.own_files()] == [
        ("material", "mat/own.mat"), ("material", "3do/MAT/skin.mat"), ("sound", "voice/hi.wav"),
        ("level", "jkl/x.jkl"),
    ]  # fmt: skip


def test_bases_are_searched_in_their_order(tmp_path: Path) -> None:
    write(tmp_path / "patch/mat/dflt.mat", b"patched")
    for base, wanted in ((["patch", "game"], b"patched"), (["game", "patch"], b"dflt")):
        assert content(jktools.load("mod.gob", base=base).resources, Kind.MATERIAL, "dflt.mat") == wanted


def test_a_project_of_an_editor_keeps_all_in_one_folder(tmp_path: Path) -> None:
    write(tmp_path / "project/x.jkl", ROOMS)
    write(tmp_path / "project/Own.MAT", b"loose")
    files = jktools.load("project/x.jkl").resources
    found = files.find(Kind.MATERIAL, "own.mat")
    assert found is not None
    assert (found.own, found.folder, found.path) == (True, "", "project/Own.MAT")
    write(tmp_path / "packed.gob", gob_of([("jkl\\x.jkl", ROOMS), ("own.mat", b"in the root of a pack")]))
    assert jktools.load("packed.gob").resources.find(Kind.MATERIAL, "own.mat") is None


def test_models_are_read_once() -> None:
    files = jktools.load("mod.gob", base=["game"]).resources
    model = files.model("Block.3do")
    assert model is not None
    assert model is files.model("block.3do")
    assert model.radius == 3.5
    assert files.model("none.3do") is None


def test_what_is_kept_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_CACHED", 12)
    library = Library(["game"])
    level = resolve("mod.gob!jkl/x.jkl")
    assert isinstance(level, Member)
    files = library.resources_of(level)
    skin, own = files.find(Kind.MATERIAL, "skin.mat"), files.find(Kind.MATERIAL, "own.mat")
    assert skin is not None
    assert own is not None
    first = files.read(skin)
    assert files.read(skin) is first
    files.read(own)
    assert files.read(skin) is not first


def test_a_level_without_files() -> None:
    assert Resources().find(Kind.MATERIAL, "own.mat") is None
    assert Resources().model("ky.3do") is None
    assert list(Resources().own_files()) == []
