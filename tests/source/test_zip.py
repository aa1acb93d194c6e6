from __future__ import annotations

import struct
import tracemalloc
import zipfile

import pytest

from jktools.source import InputError, Zip
from tests.support.packs import contents, member_of, pack_of, zip_of

MIB = 2**20


def directory_field(data: bytes, offset: int, form: str, value: int) -> bytes:
    """The archive with one field of its (only) directory entry replaced; offsets as in the format's specification."""
    changed = bytearray(data)
    struct.pack_into(form, changed, data.rindex(b"PK\1\2") + offset, value)
    return bytes(changed)


@pytest.mark.parametrize("method", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_files_are_listed_in_order_and_read_whole(method: int) -> None:
    pack = pack_of(zip_of([("JKL/b.jkl", b"level" * 1000), ("mods/", b""), ("a.txt", b"")], method))
    assert isinstance(pack, Zip)
    assert contents(pack) == [("JKL/b.jkl", b"level" * 1000), ("a.txt", b"")]
    assert next((m.path, m.size, m.declared) for m in pack.members) == ("p.zip!JKL/b.jkl", 5000, 5000)


def test_names_are_found_whatever_their_case_and_slashes() -> None:
    pack = pack_of(zip_of([("Jkl\\B.jkl", b"1"), ("../up.jkl", b"2"), ("/top.jkl", b"3")]))
    assert bytes(member_of(pack, "jkl/b.JKL").read().data) == b"1"
    assert [m.name for m in pack.members] == ["Jkl/B.jkl", "../up.jkl", "/top.jkl"]


def test_opening_inflates_nothing() -> None:
    data = zip_of([("a.jkl", bytes(50 * MIB))])
    tracemalloc.start()
    pack = pack_of(data)
    assert len(pack.members) == 1
    assert tracemalloc.get_traced_memory()[1] < MIB
    assert len(pack.members[0].read().data) == 50 * MIB
    assert tracemalloc.get_traced_memory()[1] > 50 * MIB
    tracemalloc.stop()


@pytest.mark.parametrize(
    ("offset", "form", "value", "message"),
    [
        (8, "<H", 0x1, "it is encrypted; unpack it with its password first"),
        (10, "<H", 6, "it is compressed with implode, but only stored and deflated files are read"),
        (10, "<H", 12, "it is compressed with bzip2, but"),
        (10, "<H", 77, "it is compressed with method 77, but"),
        (16, "<I", 1234, r"it is damaged \(bad crc-32 for file 'a.jkl'\); copy the zip again"),
        (24, "<I", 2**30 + 1, "it claims 1073741825 bytes, but at most 1073741824 more are inflated from one archive"),
        (42, "<I", 5, "it is damaged"),
    ],
)
def test_a_file_that_cannot_be_read_is_one_sentence(offset: int, form: str, value: int, message: str) -> None:
    pack = pack_of(directory_field(zip_of([("a.jkl", b"level" * 100)]), offset, form, value))
    with pytest.raises(InputError, match=rf"^cannot read p\.zip!a\.jkl: {message}") as error:
        pack.members[0].read()
    assert "\n" not in str(error.value)


def test_a_file_shorter_than_claimed_is_refused() -> None:
    pack = pack_of(directory_field(zip_of([("a.jkl", b"level" * 100)]), 24, "<I", 501))
    with pytest.raises(InputError, match="it should have 501 bytes, but the zip holds 500"):
        pack.members[0].read()


def test_a_bomb_that_claims_little_is_not_inflated_further() -> None:
    pack = pack_of(directory_field(zip_of([("a.jkl", bytes(100 * MIB))]), 24, "<I", 1000))
    tracemalloc.start()
    with pytest.raises(InputError, match="it is damaged"):
        pack.members[0].read()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 5 * MIB


def test_files_that_share_their_bytes_are_refused() -> None:
    data = zip_of([("a.jkl", b"level" * 100)], zipfile.ZIP_STORED)
    start, end = data.rindex(b"PK\1\2"), data.rindex(b"PK\5\6")
    entry, tail = data[start:end], bytearray(data[end:])
    struct.pack_into("<HHI", tail, 8, 3, 3, 3 * len(entry))
    assert len(data[:start] + entry * 3 + tail) < 3 * 500
    with pytest.raises(InputError, match="its files claim 1500 bytes of it, but it has"):
        pack_of(data[:start] + entry * 3 + bytes(tail))


@pytest.mark.parametrize("data", [b"PK\3\4", b"PK\5\6" + bytes(10), zip_of([("a.jkl", b"1")])[:-30], b"hello", b"\0"])
def test_what_is_no_zip_is_refused_in_one_sentence(data: bytes) -> None:
    with pytest.raises(
        InputError, match=r"^cannot read p\.zip: not a zip archive, or it is cut off or damaged \("
    ) as e:
        pack_of(data)
    assert "\n" not in str(e.value)


def test_an_empty_zip_and_one_that_unpacks_itself_are_zips() -> None:
    assert pack_of(zip_of([])).members == ()
    assert contents(pack_of(b"MZ a program" * 9 + zip_of([("a", b"1")]))) == [("a", b"1")]
