from __future__ import annotations

import struct
import tracemalloc
from pathlib import Path

import pytest

from jktools.source import Gob, InputError, PackBytes
from tests.support.levels import CORPUS, gob_of


def pack(tmp_path: Path, data: bytes) -> Gob:
    path = tmp_path / "p.gob"
    path.write_bytes(data)
    return Gob(PackBytes.mapped("p.gob", path))


def test_names_are_found_whatever_their_case_and_slashes(tmp_path: Path) -> None:
    gob = pack(tmp_path, gob_of([("jkl\\Lagoon.JKL", b"level"), ("3do\\mat\\x.mat", b"")]))
    found = gob.find("JKL/lagoon.jkl")
    assert found is not None
    assert found.path == "p.gob!jkl/Lagoon.JKL"
    assert bytes(found.read().data) == b"level"
    assert gob.find("jkl/other.jkl") is None
    assert [m.name for m in gob.members] == ["jkl/Lagoon.JKL", "3do/mat/x.mat"]


def test_a_pack_is_mapped_and_not_loaded(tmp_path: Path) -> None:
    path = tmp_path / "p.gob"
    path.write_bytes(gob_of([("a.jkl", b"x" * 1000), ("b.wav", bytes(50_000_000))]))
    tracemalloc.start()
    gob = Gob(PackBytes.mapped("p.gob", path))
    assert bytes(gob.members[0].read().data) == b"x" * 1000
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 100_000


def test_the_first_of_two_equal_names_is_meant(tmp_path: Path) -> None:
    found = pack(tmp_path, gob_of([("a.cog", b"1"), ("A.COG", b"2")])).find("a.cog")
    assert found is not None
    assert bytes(found.read().data) == b"1"


@pytest.mark.parametrize("cut", [0, 3, 11, 13, 100])
def test_a_pack_cut_within_its_directory_is_refused_in_one_sentence(tmp_path: Path, cut: int) -> None:
    with pytest.raises(InputError, match=r"^cannot read p\.gob: ") as error:
        pack(tmp_path, gob_of([("a.jkl", b"x")])[:cut])
    assert "\n" not in str(error.value)


def test_a_directory_of_four_billion_files_is_refused(tmp_path: Path) -> None:
    data = bytearray(gob_of([("a.jkl", b"x")]))
    struct.pack_into("<I", data, 12, 2**32 - 1)
    with pytest.raises(InputError, match="claims 4294967295 files, but the pack has room for at most 1"):
        pack(tmp_path, bytes(data))


def test_a_member_beyond_the_end_yields_what_is_there(tmp_path: Path) -> None:
    member = pack(tmp_path, gob_of([("a.jkl", b"0123456789")])[:-4]).members[0]
    assert (member.size, member.declared) == (6, 10)
    assert bytes(member.read().data) == b"012345"


def test_other_versions_and_other_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="GOB version 21, but only 20"):
        pack(tmp_path, gob_of([]).replace(struct.pack("<I", 20), struct.pack("<I", 21), 1))
    with pytest.raises(InputError, match="not a GOB pack"):
        pack(tmp_path, b"PK\3\4 and so on")


@pytest.mark.parametrize("path", sorted((CORPUS / "gob").glob("*")) if CORPUS.exists() else [], ids=lambda p: p.name)
def test_no_byte_of_a_real_pack_is_unexplained(path: Path) -> None:
    """Header, directory and files lie without gap or overlap."""
    data = path.read_bytes()
    gob = Gob(PackBytes.of(path.name, data))
    ranges = [(0, 12), (12, 16 + 136 * len(gob.members))]
    for index, member in enumerate(gob.members):
        offset, size = struct.unpack_from("<II", data, 16 + 136 * index)
        assert (member.size, member.declared) == (size, size)
        assert bytes(member.read().data) == data[offset : offset + size]
        ranges.append((offset, offset + size))
    ranges.sort()
    assert [end for _, end in ranges] == [*(start for start, _ in ranges[1:]), len(data)]
