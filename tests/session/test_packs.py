from __future__ import annotations

from pathlib import Path

import pytest

from jktools.session.packs import create, extract
from jktools.source import InputError
from tests.support.levels import gob_of
from tests.support.packs import GOBS, gob_files, write, zip_of


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def tree(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_files_are_written_below_the_folder_and_replaced(here: Path) -> None:
    write(here / "p.gob", gob_of([("jkl\\A.jkl", b"A"), ("cog\\x.cog", b"X")]))
    write(here / "out/jkl/A.jkl", b"older and longer")
    done = extract("p.gob", Path("out"))
    assert tree(here / "out") == {"jkl/A.jkl": b"A", "cog/x.cog": b"X"}
    assert done.problems == []
    assert done.written == [
        ("p.gob!jkl/A.jkl", Path("out/jkl/A.jkl"), 1),
        ("p.gob!cog/x.cog", Path("out/cog/x.cog"), 1),
    ]


@pytest.mark.parametrize(
    ("patterns", "names"),
    [
        (["*.JKL"], {"Jkl/a.jkl", "jkl/b.jkl"}),
        (["jkl\\b.jkl"], {"jkl/b.jkl"}),
        (["COG/*", "jkl/b.*"], {"cog/x.cog", "jkl/b.jkl"}),
        ([], {"Jkl/a.jkl", "jkl/b.jkl", "cog/x.cog"}),
    ],
)
def test_patterns_choose_whatever_their_case(here: Path, patterns: list[str], names: set[str]) -> None:
    write(here / "p.gob", gob_of([(n, b"") for n in ("Jkl\\a.jkl", "jkl\\b.jkl", "cog\\x.cog")]))
    extract("p.gob", Path("out"), patterns)
    assert set(tree(here / "out")) == names


def test_a_pattern_that_matches_nothing_is_told_before_anything_is_written(here: Path) -> None:
    write(here / "p.gob", gob_of([("a.cog", b"")]))
    with pytest.raises(InputError, match=r"cannot extract from p\.gob: no file in it matches b\.cog"):
        extract("p.gob", Path("out"), ["a.cog", "b.cog"])
    assert not (here / "out").exists()


HOSTILE = ["../up.jkl", "/top.jkl", "C:\\x.jkl", "a\\..\\..\\b.jkl", "NUL", "con.jkl", "x\\", "..\\..", ""]


@pytest.mark.parametrize("kind", ["gob", "zip"])
def test_nothing_is_written_outside_the_folder(here: Path, kind: str) -> None:
    files = [(name, b"evil") for name in HOSTILE if name or kind == "gob"]
    made = (gob_of if kind == "gob" else zip_of)([*files, ("jkl/good.jkl", b"good")])
    write(here / f"deep/p.{kind}", made)
    done = extract(f"deep/p.{kind}", Path("deep/er/out"))
    assert tree(here) == {f"deep/p.{kind}": made, "deep/er/out/jkl/good.jkl": b"good"}
    assert len(done.problems) == len(files)
    assert done.problems[0] == f"cannot extract deep/p.{kind}!../up.jkl: its name leads out of the folder"


def test_nothing_is_written_through_a_link_out_of_the_folder(here: Path) -> None:
    (here / "elsewhere").mkdir()
    (here / "out").mkdir()
    (here / "out/jkl").symlink_to(here / "elsewhere")
    write(here / "target.txt", b"kept")
    (here / "out/a.txt").symlink_to(here / "target.txt")
    write(here / "p.gob", gob_of([("jkl\\x.jkl", b"x"), ("a.txt", b"new")]))
    done = extract("p.gob", Path("out"))
    assert done.problems == ["cannot extract p.gob!jkl/x.jkl: out/jkl is a link that leads out of out"]
    assert list((here / "elsewhere").iterdir()) == []
    assert (here / "target.txt").read_bytes() == b"kept"
    assert (here / "out/a.txt").read_bytes() == b"new"


@pytest.mark.parametrize(
    ("names", "problem"),
    [
        (["a/x.cog", "A/X.cog"], "cannot extract p.gob!A/X.cog: where names ignore case it takes the place of a/x.cog"),
        (["a", "A/x.cog"], "cannot extract p.gob!A/x.cog: where names ignore case it takes the place of a"),
        (["a/x.cog", "A"], "cannot extract p.gob!A: where names ignore case it takes the place of a/x.cog"),
    ],
)
def test_names_that_collide_are_told_and_the_first_is_kept(here: Path, names: list[str], problem: str) -> None:
    write(here / "p.gob", gob_of([(names[0], b"first"), (names[1], b"second")]))
    assert extract("p.gob", Path("out")).problems == [problem]
    assert tree(here / "out") == {names[0]: b"first"}


def test_half_a_file_is_not_written_and_the_others_are(here: Path) -> None:
    write(here / "p.gob", gob_of([("a.cog", b"whole"), ("b.cog", b"0123456789")])[:-4])
    done = extract("p.gob", Path("out"))
    assert done.problems == ["cannot extract p.gob!b.cog: the pack is cut off, 6 of 10 bytes are there"]
    assert tree(here / "out") == {"a.cog": b"whole"}


@pytest.mark.parametrize("path", GOBS, ids=lambda p: p.name)
def test_a_pack_unpacked_and_made_again_has_the_same_files(here: Path, path: Path) -> None:
    assert extract(path.as_posix(), here / "out").problems == []
    files = gob_files(path.read_bytes())
    assert tree(here / "out") == {name.replace("\\", "/"): data for name, data in files}
    create(here / "again.gob", "out")
    assert gob_files((here / "again.gob").read_bytes()) == sorted(files, key=lambda f: f[0].replace("\\", "/").lower())


def test_a_gob_made_in_its_own_folder_leaves_itself_out(here: Path) -> None:
    write(here / "mod/a.cog", b"A")
    first = create(Path("mod/p.gob"), "mod")
    assert create(Path("mod/p.gob"), "mod") == first == (1, 16 + 136 + 1)
    assert gob_files((here / "mod/p.gob").read_bytes()) == [("a.cog", b"A")]


def test_a_gob_may_replace_itself(here: Path) -> None:
    data = gob_of([("b.cog", b"B"), ("a.cog", b"A")])
    write(here / "p.gob", data)
    create(Path("p.gob"), "p.gob")
    assert (here / "p.gob").read_bytes() == data


def test_a_gob_that_cannot_be_made_leaves_what_was_there(here: Path) -> None:
    write(here / "p.gob", b"older")
    write(here / "cut.gob", gob_of([("a.cog", b"0123456789")])[:-4])
    with pytest.raises(InputError):
        create(Path("p.gob"), "cut.gob")
    assert sorted(tree(here)) == ["cut.gob", "p.gob"]
    assert (here / "p.gob").read_bytes() == b"older"
