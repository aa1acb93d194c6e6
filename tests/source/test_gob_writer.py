from __future__ import annotations

import struct
from pathlib import Path

import pytest

from jktools.source import Container, Folder, InputError, Member
from jktools.source.gob_writer import gob_parts
from tests.support.levels import gob_of
from tests.support.packs import GOBS, contents, gob_files, pack_of, write, zip_of


def gob(container: Container) -> bytes:
    return b"".join(bytes(part) for part in gob_parts(container))


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    for name in ("jkl/b.jkl", "JKL/A.jkl", "episode.jk"):
        write(tmp_path / name, name.encode() * 3)
    return Folder("mod", tmp_path)


def test_a_folder_becomes_a_gob_sorted_by_canonical_name(folder: Folder) -> None:
    names = ["episode.jk", "JKL/A.jkl", "jkl/b.jkl"]
    assert gob(folder) == gob_of([(n.replace("/", "\\"), n.encode() * 3) for n in names])


def test_a_zip_becomes_the_same_gob_as_the_folder(folder: Folder) -> None:
    files = [(m.name, bytes(m.read().data)) for m in folder.members]
    assert gob(pack_of(zip_of(files[::-1]))) == gob(folder)


@pytest.mark.parametrize("path", GOBS, ids=lambda p: p.name)
def test_every_pack_of_the_corpus_is_written_as_it_was(path: Path) -> None:
    data = path.read_bytes()
    assert gob(pack_of(data, path.name)) == data


@pytest.mark.parametrize("path", GOBS, ids=lambda p: p.name)
def test_through_a_zip_a_pack_keeps_its_names_and_bytes(path: Path) -> None:
    files = gob_files(path.read_bytes())
    made = gob(pack_of(zip_of([(name.replace("\\", "/"), data) for name, data in files])))
    assert gob_files(made) == sorted(files, key=lambda f: f[0].replace("\\", "/").lower())
    assert contents(pack_of(made)) == [(name.replace("\\", "/"), data) for name, data in gob_files(made)]


def test_a_gob_keeps_order_spelling_and_equal_names() -> None:
    data = gob_of([("b/x.cog", b"1"), ("A\\x.cog", b"2"), ("a\\X.cog", b"3")])
    assert gob(pack_of(data)) == data


def test_another_order_of_data_and_gaps_are_made_usual() -> None:
    files = [("a", b"first"), ("b", b"second")]
    body = b"second gap first"
    directory = struct.pack("<II128sII128s", 16 + 272 + 11, 5, b"a", 16 + 272, 6, b"b")
    odd = struct.pack("<4sIII", b"GOB ", 20, 12, 2) + directory + body
    assert gob_files(odd) == files
    assert gob(pack_of(odd)) == gob_of(files)


def test_a_name_has_room_for_127_bytes(tmp_path: Path) -> None:
    long = "m" * 60 + "/" + "n" * 66
    assert contents(pack_of(gob(pack_of(zip_of([(long, b"x")]))))) == [(long, b"x")]
    with pytest.raises(InputError, match=r"nx: its name would have 128 bytes, but a GOB has room for 127"):
        gob(pack_of(zip_of([(long + "x", b"x")])))


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (["jkl/żółw.jkl"], "cannot pack p.zip!jkl/żółw.jkl: its name has 'ż', but a GOB knows Latin-1 only"),
        (["a/x.cog", "A/X.cog"], "cannot pack p.zip: A/X.cog and a/x.cog are one name to the game; rename one"),
    ],
)
def test_names_that_a_gob_cannot_hold_are_refused(names: list[str], message: str) -> None:
    with pytest.raises(InputError) as error:
        gob(pack_of(zip_of([(name, b"x") for name in names])))
    assert str(error.value) == message


def test_names_in_latin_1_stay(tmp_path: Path) -> None:
    assert gob_files(gob(pack_of(zip_of([("jkl/é.jkl", b"x")])))) == [("jkl\\é.jkl", b"x")]


def test_a_backslash_in_a_file_name_is_refused(tmp_path: Path) -> None:
    write(tmp_path / "a\\b.cog", b"x")
    with pytest.raises(InputError, match="its name has a backslash"):
        gob(Folder("mod", tmp_path))


def test_half_a_file_is_never_packed() -> None:
    with pytest.raises(InputError, match=r"cannot pack p\.gob!a\.jkl: it should have 10 bytes, but 6 could be read"):
        gob(pack_of(gob_of([("a.jkl", b"0123456789")])[:-4], "p.gob"))


def test_more_than_32_bits_are_refused() -> None:
    class Huge(Container):
        path = "huge"
        members = (Member("huge/a", "a", 2**32, 2**32, lambda: b""),)

    with pytest.raises(InputError, match="it would have 4294967448 bytes, but a GOB has at most 4294967295"):
        gob(Huge())
