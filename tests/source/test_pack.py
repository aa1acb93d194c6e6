"""Packs inside packs, and how many of them are held at once."""

from __future__ import annotations

import random
import subprocess
import sys
import tracemalloc
import zipfile
from pathlib import Path

import pytest

from jktools.source import Folder, Gob, InputError, Pack, PackBytes, Zip, enter, open_pack, resolve
from tests.support.levels import gob_of
from tests.support.packs import contents, pack_of, write, zip_of

MIB = 2**20


def nest(levels: int, name: str = "z.zip") -> bytes:
    data = zip_of([("a.jkl", b"A")])
    for _ in range(levels - 1):
        data = zip_of([(name, data)])
    return data


def test_the_first_bytes_decide_and_then_the_extension() -> None:
    assert isinstance(pack_of(gob_of([]), "p.zip"), Gob)
    assert isinstance(pack_of(zip_of([]), "p.gob"), Zip)
    with pytest.raises(InputError, match="not a GOB pack"):
        pack_of(b"neither", "p.gob")


@pytest.mark.parametrize("outer", [zip_of, gob_of])
@pytest.mark.parametrize("inner", [zip_of, gob_of])
def test_a_pack_in_a_pack_is_read(outer: object, inner: object) -> None:
    files = [("jkl/a.jkl", b"level")]
    data = outer([("mods/p.gob", inner(files))])  # type: ignore[operator]
    pack = pack_of(data)
    within = enter(pack, pack.members[0])
    assert within.path == "p.zip!mods/p.gob"
    assert contents(within) == files
    assert within.members[0].path == "p.zip!mods/p.gob!jkl/a.jkl"


def test_packs_nest_four_deep_and_no_deeper(tmp_path: Path) -> None:
    for levels, opens in ((4, True), (5, False)):
        shown = write(tmp_path / f"{levels}.zip", nest(levels)).as_posix() + "!z.zip" * (levels - 1)
        if opens:
            pack = resolve(shown)
            assert isinstance(pack, Zip)
            assert contents(pack) == [("a.jkl", b"A")]
        else:
            with pytest.raises(InputError, match="packs are nested 5 deep, but at most 4 are read"):
                resolve(shown)


def test_what_is_inflated_in_one_archive_counts_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("jktools.source.pack.MOST_INFLATED", 1000)
    inner = zip_of([("small.jkl", bytes(300)), ("big.jkl", bytes(900))])
    data = zip_of([("z.zip", inner)])
    pack = pack_of(data)
    within = enter(pack, pack.members[0])
    room = 1000 - len(inner)
    assert 300 < room < 900
    small, big = within.members
    assert len(small.read().data) == 300
    with pytest.raises(InputError, match=f"it claims 900 bytes, but at most {room} more are inflated"):
        big.read()


def test_inner_packs_are_let_go_and_inflated_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("jktools.source.pack.MOST_KEPT", 4 * MIB)
    noise = random.Random(1)
    packs = [(f"{i:02}.gob", gob_of([("a.jkl", noise.randbytes(MIB))])) for i in range(24)]
    site = pack_of(zip_of(packs, zipfile.ZIP_STORED))
    tracemalloc.start()
    levels = [level for member in site.members for level in enter(site, member).members]
    held, _ = tracemalloc.get_traced_memory()
    assert held < 6 * MIB
    for level, (_, data) in zip(levels, packs, strict=True):
        assert bytes(level.read().data) == data[-MIB:]
    assert tracemalloc.get_traced_memory()[0] < 6 * MIB
    tracemalloc.stop()


def test_a_folder_of_packs_does_not_use_up_the_open_files(tmp_path: Path) -> None:
    for index in range(150):
        write(tmp_path / f"{index:03}.gob", gob_of([("a.jkl", b"%d" % index)]))
    code = (
        "import resource; resource.setrlimit(resource.RLIMIT_NOFILE, (128, 128));"
        "from jktools.source import *; folder = resolve('.');"
        "packs = [enter(folder, m) for m in folder.members]; members = [m for p in packs for m in p.members];"
        "read = [m.read() for m in members];"  # kept, as the findings of a batch keep them
        "print(sum(int(bytes(source.data)) for source in read))"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == (f"{sum(range(150))}\n", "")


def test_a_pack_that_is_dropped_is_closed(tmp_path: Path) -> None:
    data = PackBytes.mapped("p.gob", write(tmp_path / "p.gob", gob_of([("a", b"1")])))
    mapped = data().obj
    pack = Gob(data)
    assert not mapped.closed  # type: ignore[attr-defined]
    before = sys.getrefcount(mapped)
    del data, pack
    assert sys.getrefcount(mapped) < before


def test_a_pack_that_changes_while_it_is_read_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "p.gob", gob_of([("a.jkl", b"12345")]))
    pack = open_pack(PackBytes.mapped("p.gob", path))
    (member,) = pack.members
    pack.data.let_go()
    assert bytes(member.read().data) == b"12345"
    pack.data.let_go()
    path.write_bytes(gob_of([("a.jkl", b"123456")]))
    with pytest.raises(InputError, match="it was changed while it was being read"):
        member.read()


def test_packs_of_a_folder_are_mapped(tmp_path: Path) -> None:
    write(tmp_path / "p.gob", gob_of([("a.jkl", b"1")]))
    folder = Folder("x", tmp_path)
    pack: Pack = enter(folder, folder.members[0])
    assert type(pack.data().obj).__name__ == "mmap"
