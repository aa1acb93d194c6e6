"""What is found below a path, whatever packs lie in between."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.compiler import compile_level
from jktools.session import Settings, build_all, check, discover, load
from jktools.source import InputError
from tests.support.levels import TWO_ROOMS, gob_of, level_of, two_rooms
from tests.support.packs import gob_files, write, zip_of

ROOMS = TWO_ROOMS.encode()
BROKEN = two_rooms("World adjoins 2", "1: 0x7 1 1").encode()
CUT = gob_of([("jkl\\cut.jkl", ROOMS)])[:100]


@pytest.fixture(autouse=True)
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    mod = zip_of([("Mod.gob", gob_of([("jkl\\b.jkl", BROKEN), ("in.zip", zip_of([("c.jkl", ROOMS)]))]))])
    goo = gob_of([("jkl\\m.jkl", ROOMS)])
    write(tmp_path / "site/a.jkl", ROOMS)
    write(
        tmp_path / "site/mods.zip", zip_of([("x/mod.zip", mod), ("m.goo", goo), ("readme.txt", b""), ("z.jkl", ROOMS)])
    )
    return tmp_path


LEVELS = [
    "site/a.jkl",
    "site/mods.zip!x/mod.zip!Mod.gob!jkl/b.jkl",
    "site/mods.zip!m.goo!jkl/m.jkl",
    "site/mods.zip!z.jkl",
]


def test_packs_in_folders_and_zips_are_entered_and_those_in_a_gob_are_not() -> None:
    assert [m.path for m in discover("site")] == LEVELS
    assert [m.path for m in discover("site/mods.zip!x/mod.zip")] == [LEVELS[1]]
    assert [m.path for m in discover(LEVELS[1].replace("jkl/b.jkl", "in.zip"))] == [
        "site/mods.zip!x/mod.zip!Mod.gob!in.zip!c.jkl"
    ]


def test_findings_in_nested_packs_name_the_whole_path() -> None:
    batch = check(["site"])
    assert (batch.files, batch.problems) == (4, [])
    assert [(d.code.id, d.label.path) for d in batch] == [("JK201", LEVELS[1])]
    assert load(LEVELS[2]).game == "mots"


def test_a_real_pack_in_a_zip_has_the_findings_of_the_pack(site: Path, corpus: Path) -> None:
    pack = corpus / "gob/canyon_camera.gob"
    write(site / "real/camera.zip", zip_of([(pack.name, pack.read_bytes())]))
    plain, zipped = check([pack.as_posix()]), check(["real"])
    read = [name for name, _ in gob_files(pack.read_bytes()) if name.endswith((".jkl", ".cog", ".jk", ".uni"))]
    assert (plain.files, len(plain) > 0, zipped.problems) == (len(read), True, [])
    inside = "real/camera.zip!canyon_camera.gob"
    assert [d.label.path.replace(pack.as_posix(), inside) for d in plain] == [d.label.path for d in zipped]
    assert [(d.code, d.message) for d in plain] == [(d.code, d.message) for d in zipped]


def test_a_broken_pack_within_does_not_lose_the_others(site: Path) -> None:
    write(site / "site/broken.gob", CUT)
    write(site / "site/empty.zip", b"")
    write(site / "site/more.zip", zip_of([("cut.gob", CUT), ("b.jkl", BROKEN)]))
    batch = check(["site", "no"])
    assert batch.files == 5
    assert len(batch) == 2
    assert [p.partition(": ")[0] for p in batch.problems] == [
        "cannot read site/broken.gob",
        "cannot read site/empty.zip",
        "cannot read site/more.zip!cut.gob",
        "cannot read no",
    ]
    built = build_all(["site"], site / "out", Settings())
    assert len(built.written) == 5
    assert built.problems == batch.problems[:3]


def test_a_broken_file_in_a_zip_is_a_problem_of_its_own(site: Path) -> None:
    data = zip_of([("bad.jkl", ROOMS), ("good.jkl", BROKEN)])
    write(site / "damaged.zip", data[:200] + b"\xff" * 8 + data[208:])
    batch = check(["damaged.zip"])
    assert (batch.files, len(batch)) == (1, 1)
    assert len(batch.problems) == 1
    assert batch.problems[0].startswith("cannot read damaged.zip!bad.jkl: it is damaged (")


def test_a_path_whose_only_pack_is_broken_says_that_alone(site: Path) -> None:
    write(site / "one/broken.gob", CUT)
    assert [p.partition(": ")[0] for p in check(["one"]).problems] == ["cannot read one/broken.gob"]
    with pytest.raises(InputError, match=r"^cannot read one/broken\.gob"):
        discover("one")
    with pytest.raises(InputError, match=r"^nothing to read in empty: expected"):
        (site / "empty").mkdir()
        discover("empty")


def test_load_does_not_choose_a_level_while_a_pack_beside_it_is_broken(site: Path) -> None:
    write(site / "two/a.jkl", ROOMS)
    write(site / "two/broken.gob", CUT)
    with pytest.raises(InputError, match=r"cannot read two/broken\.gob"):
        load("two")


@pytest.mark.parametrize("name", ["rooms.jklb", "rooms.bin"])
def test_a_compiled_level_is_no_source(tmp_path: Path, name: str) -> None:
    """By its ending or its first bytes: what needs the source says so."""
    (tmp_path / name).write_bytes(compile_level(level_of(TWO_ROOMS)))
    with pytest.raises(
        InputError, match=rf"cannot read .*{name} as a source: it is a compiled level; name what it was"
    ):
        load(str(tmp_path / name))
