from __future__ import annotations

from pathlib import Path

import pytest

from jktools.source import Folder, Gob, InputError, Member, resolve
from tests.support.levels import gob_of


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mod/jkl").mkdir(parents=True)
    (tmp_path / "mod/jkl/a.jkl").write_bytes(b"A")
    (tmp_path / "mod/p.gob").write_bytes(gob_of([("jkl\\b.jkl", b"B")]))
    return tmp_path


def member(path: str) -> Member:
    found = resolve(path)
    assert isinstance(found, Member)
    return found


def test_files_folders_packs_and_members(folder: Path) -> None:
    assert isinstance(resolve("mod"), Folder)
    assert isinstance(resolve("mod/p.gob"), Gob)
    assert member("mod/jkl/a.jkl").path == "mod/jkl/a.jkl"
    assert member("mod/p.gob!JKL\\B.jkl").path == "mod/p.gob!jkl/b.jkl"
    assert member("mod!JKL/A.JKL").path == "mod/jkl/a.jkl"


def test_a_folder_lists_its_files_in_order_under_the_path_as_typed(folder: Path) -> None:
    found = resolve("mod/")
    assert isinstance(found, Folder)
    assert [m.path for m in found.members] == ["mod/jkl/a.jkl", "mod/p.gob"]
    here = resolve(".")
    assert isinstance(here, Folder)
    assert [m.path for m in here.members] == ["mod/jkl/a.jkl", "mod/p.gob"]


def test_the_longest_prefix_that_exists_wins(folder: Path) -> None:
    (folder / "mod/p.gob!jkl").mkdir()
    (folder / "mod/p.gob!jkl/b.jkl").write_bytes(b"file")
    assert bytes(member("mod/p.gob!jkl/b.jkl").read().data) == b"file"


def test_a_pack_without_its_extension_is_known_by_its_first_bytes(folder: Path) -> None:
    (folder / "renamed.dat").write_bytes(gob_of([("c.jkl", b"C")]))
    assert isinstance(resolve("renamed.dat"), Gob)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("no.jkl", "cannot read no.jkl: no such file or folder"),
        ("mod/p.gob!jkl/bb.jkl", "no such file in the pack; did you mean jkl/b.jkl?"),
        ("mod/jkl/a.jkl!x", "mod/jkl/a.jkl is not a pack"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(folder: Path, path: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        resolve(path)
    assert message in str(error.value)
