"""Where files are looked for: folders and packs, in the game's order."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.source import InputError, Member, resolve
from jktools.source.roots import FolderRoot, home_of, open_roots
from tests.support.levels import gob_of
from tests.support.packs import write, zip_of

GOB = gob_of([("3DO\\KY.3do", b"ky"), ("mat\\a.mat", b"a"), ("jkl\\x.jkl", b"x")])


def member(path: Path | str) -> Member:
    found = resolve(str(path))
    assert isinstance(found, Member)
    return found


def data(found: Member | None) -> bytes | None:
    return None if found is None else bytes(found.read().data)


def test_the_game_as_it_is_installed(tmp_path: Path) -> None:
    write(tmp_path / "jk/Resource/Res2.gob", GOB)
    write(tmp_path / "jk/EPISODE/b.goo", gob_of([("mat\\b.mat", b"b")]))
    write(tmp_path / "jk/EPISODE/A.GOB", gob_of([("mat\\b.mat", b"first")]))
    write(tmp_path / "jk/Mat/C.MAT", b"c")
    write(tmp_path / "jk/readme.txt", b"")
    roots = open_roots(str(tmp_path / "jk"))
    assert [Path(r.path).name for r in roots] == ["jk", "Res2.gob", "A.GOB", "b.goo"]
    assert [data(r.find("mat/c.mat")) for r in roots] == [b"c", None, None, None]
    assert [data(r.find("MAT\\B.mat")) for r in roots] == [None, None, b"first", b"b"]
    assert [m.name for r in roots for m in r.beneath(["mat"])] == ["Mat/C.MAT", "mat/a.mat", "mat/b.mat", "mat/b.mat"]


def test_a_zip_stands_for_itself_and_the_packs_in_it(tmp_path: Path) -> None:
    write(tmp_path / "game.zip", zip_of([("mat/z.mat", b"z"), ("res.gob", GOB)]))
    roots = open_roots(str(tmp_path / "game.zip"))
    assert [data(r.find("3do/ky.3do")) for r in roots] == [None, b"ky"]
    assert data(roots[0].find("mat/z.mat")) == b"z"


def test_what_cannot_be_a_base(tmp_path: Path) -> None:
    write(tmp_path / "x.txt", b"hello")
    write(tmp_path / "bad/cut.gob", GOB[:20])
    with pytest.raises(InputError, match="as a base: expected a folder or a GOB, GOO or zip"):
        open_roots(str(tmp_path / "x.txt"))
    with pytest.raises(InputError, match=r"cut\.gob"):
        open_roots(str(tmp_path / "bad"))
    with pytest.raises(InputError, match="no such file"):
        open_roots(str(tmp_path / "none"))


@pytest.mark.parametrize(
    ("level", "beside"),
    [
        ("mod/jkl/x.jkl", "mod/mat/a.mat"),
        ("mod/JKL/x.jkl", "mod/Mat/A.MAT"),
        ("project/x.jkl", "project/mat/a.mat"),
        ("x.jkl", "mat/a.mat"),
    ],
)
def test_home_of_a_level_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, level: str, beside: str) -> None:
    monkeypatch.chdir(tmp_path)
    write(tmp_path / level, b"x")
    write(tmp_path / beside, b"a")
    found = home_of(member(level), ["jkl"]).find("mat/a.mat")
    assert data(found) == b"a"
    assert found is not None
    assert found.path == beside
    assert data(home_of(member(tmp_path / level), ["jkl"]).find("mat/a.mat")) == b"a"


def test_home_of_a_level_typed_within_its_own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "mod/jkl/x.jkl", b"x")
    write(tmp_path / "mod/mat/a.mat", b"a")
    monkeypatch.chdir(tmp_path / "mod/jkl")
    found = home_of(member("x.jkl"), ["jkl"]).find("mat/a.mat")
    assert found is not None
    assert found.path == "../mat/a.mat"


def test_home_of_what_lies_deeper(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "mod/3do/mat/a.mat", b"a")
    write(tmp_path / "mod/jkl/x.jkl", b"x")
    folders = ["mat", "3do/mat"]
    monkeypatch.chdir(tmp_path)
    assert home_of(member("mod/3do/mat/a.mat"), folders).path == "mod"
    monkeypatch.chdir(tmp_path / "mod/3do")
    home = home_of(member("mat/a.mat"), folders)
    assert home.path == ".."
    assert data(home.find("jkl/x.jkl")) == b"x"
    monkeypatch.chdir(tmp_path / "mod/3do/mat")
    assert data(home_of(member("a.mat"), folders).find("jkl/x.jkl")) == b"x"


def test_home_of_a_level_in_a_pack(tmp_path: Path) -> None:
    write(tmp_path / "p.gob", GOB)
    write(tmp_path / "z.zip", zip_of([("my mod/jkl/x.jkl", b"x"), ("my mod/mat/a.mat", b"a"), ("mat/a.mat", b"other")]))
    assert data(home_of(member(f"{tmp_path}/p.gob!jkl/x.jkl"), ["jkl"]).find("3do/ky.3do")) == b"ky"
    home = home_of(member(f"{tmp_path}/z.zip!my mod/jkl/x.jkl"), ["jkl"])
    assert data(home.find("mat/a.mat")) == b"a"
    assert home.path.endswith("z.zip!my mod")
    assert [m.name for m in home.beneath(["mat"])] == ["my mod/mat/a.mat"]


def test_a_folder_is_listed_no_further_than_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "mat/a.mat", b"a")
    write(tmp_path / "huge/b.mat", b"b")
    listed: list[str] = []
    real = Path.iterdir
    monkeypatch.setattr(Path, "iterdir", lambda self: (listed.append(self.name), real(self))[1])
    root = FolderRoot("x", tmp_path)
    assert root.find("mat/a.mat") is not None
    assert root.find("mat/b.mat") is None
    assert listed == [tmp_path.name, "mat"]


def test_a_name_that_leads_out_finds_nothing(tmp_path: Path) -> None:
    write(tmp_path / "secret.mat", b"s")
    (tmp_path / "mod/mat").mkdir(parents=True)
    root = FolderRoot("mod", tmp_path / "mod")
    assert root.find("mat/../../secret.mat") is None
    assert root.find("../secret.mat") is None
    assert root.find(str(tmp_path / "secret.mat")) is None
    assert root.find("") is None
