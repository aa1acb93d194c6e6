from __future__ import annotations

from pathlib import Path

import pytest

from jktools.source import Folder, Gob, InputError, Member, Zip, resolve
from tests.support.levels import gob_of
from tests.support.packs import zip_of


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mod/jkl").mkdir(parents=True)
    (tmp_path / "mod/jkl/a.jkl").write_bytes(b"A")
    pack = gob_of([("jkl\\b.jkl", b"B")])
    (tmp_path / "mod/p.gob").write_bytes(pack)
    inner = zip_of([("Mods\\P.gob", pack), ("odd.dat", pack), ("a!b.gob", pack), ("read me.txt", b"T")])
    (tmp_path / "site.zip").write_bytes(zip_of([("In/inner.ZIP", inner), ("jkl/z.jkl", b"Z")]))
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
    assert [m.path for m in here.members] == ["mod/jkl/a.jkl", "mod/p.gob", "site.zip"]


def test_the_longest_prefix_that_exists_wins(folder: Path) -> None:
    (folder / "mod/p.gob!jkl").mkdir()
    (folder / "mod/p.gob!jkl/b.jkl").write_bytes(b"file")
    assert bytes(member("mod/p.gob!jkl/b.jkl").read().data) == b"file"


def test_a_pack_without_its_extension_is_known_by_its_first_bytes(folder: Path) -> None:
    (folder / "renamed.dat").write_bytes(gob_of([("c.jkl", b"C")]))
    assert isinstance(resolve("renamed.dat"), Gob)


@pytest.mark.parametrize(
    ("typed", "path", "data"),
    [
        ("site.zip!JKL/z.jkl", "site.zip!jkl/z.jkl", b"Z"),
        ("site.zip!in/INNER.zip!mods/p.GOB!JKL\\B.jkl", "site.zip!In/inner.ZIP!Mods/P.gob!jkl/b.jkl", b"B"),
        ("site.zip!in/inner.zip!odd.dat!jkl/b.jkl", "site.zip!In/inner.ZIP!odd.dat!jkl/b.jkl", b"B"),
        ("site.zip!in/inner.zip!a!b.gob!jkl/b.jkl", "site.zip!In/inner.ZIP!a!b.gob!jkl/b.jkl", b"B"),
        ("site.zip!in/inner.zip!odd.dat", "site.zip!In/inner.ZIP!odd.dat", gob_of([("jkl\\b.jkl", b"B")])),
        ("mod!p.gob!jkl/b.jkl", "mod/p.gob!jkl/b.jkl", b"B"),
    ],
)
def test_each_separator_enters_a_pack_whatever_the_case(folder: Path, typed: str, path: str, data: bytes) -> None:
    found = member(typed)
    assert (found.path, bytes(found.read().data)) == (path, data)


def test_a_pack_in_a_pack_is_a_pack(folder: Path) -> None:
    assert isinstance(resolve("site.zip!in/inner.zip"), Zip)
    found = resolve("site.zip!in/inner.zip!mods/p.gob!")
    assert isinstance(found, Gob)
    assert found.path == "site.zip!In/inner.ZIP!Mods/P.gob"


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("site.zip!in/inner.zip!mods/q.gob!jkl/b.jkl", "no such file in the pack; did you mean Mods/P.gob?"),
        ("site.zip!in/inner.zip!read me.txt!x", "cannot read site.zip!In/inner.ZIP!read me.txt: not a GOB pack"),
        ("mod!jkl/b.jkl", "cannot read mod!jkl/b.jkl: no such file in the folder; did you mean jkl/a.jkl?"),
        ("site.zip!" + "long" * 100, "no such file in the pack"),
        ("long" * 100, "no such file or folder"),
        ("no.jkl", "cannot read no.jkl: no such file or folder"),
        ("mod/p.gob!jkl/bb.jkl", "no such file in the pack; did you mean jkl/b.jkl?"),
        ("mod/jkl/a.jkl!x", "mod/jkl/a.jkl is not a pack"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(folder: Path, path: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        resolve(path)
    assert message in str(error.value)
