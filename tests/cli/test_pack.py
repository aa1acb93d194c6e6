"""`jktools pack` as a user sees it."""

from __future__ import annotations

import json
import os
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import pytest

from jktools.cli import main
from tests.support.levels import TWO_ROOMS, gob_of, two_rooms
from tests.support.packs import GOBS, write, zip_of

FILES = [("jkl\\rooms.jkl", TWO_ROOMS.encode()), ("cog\\Wait.cog", b"end\r\n")]


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "p.gob", gob_of(FILES))
    write(tmp_path / "site.zip", zip_of([("mods/p.gob", gob_of(FILES))]))
    return tmp_path


def test_the_whole_list(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["pack", "list", "site.zip!mods/p.gob"]) == 0
    size = len(TWO_ROOMS)
    assert capsys.readouterr().out == (
        f"{size:>10}  jkl/rooms.jkl\n         5  cog/Wait.cog\n2 files, {size + 5} bytes\n"
    )


def test_the_list_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["pack", "list", "site.zip", "--json"]) == 0
    size = len(gob_of(FILES))
    assert json.loads(capsys.readouterr().out) == {
        "version": 1,
        "path": "site.zip",
        "files": [{"name": "mods/p.gob", "size": size, "declared": size}],
    }


def test_a_list_shows_what_is_cut_off_and_no_control_codes(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(here / "cut.gob", gob_of([("a\x1b[31m\nb", b"0123456789")])[:-4])
    assert main(["pack", "list", "cut.gob"]) == 0
    assert capsys.readouterr().out == ("         6  a\\x1b[31m\\nb  (cut off, should be 10 bytes)\n1 file, 6 bytes\n")
    assert main(["pack", "extract", "cut.gob", "-o", "out"]) == 2
    assert capsys.readouterr().err == (
        "jktools: error: cannot extract cut.gob!a\\x1b[31m\\nb: 'a\\x1b[31m\\nb' in its name has a character that file "
        "names must not have\n"
    )


def test_extract_change_create_and_lint(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["pack", "extract", "site.zip!mods/p.gob", "-o", "mod"]) == 0
    total = len(TWO_ROOMS) + 5
    assert capsys.readouterr().out == f"site.zip!mods/p.gob -> mod (2 files, {total} bytes)\n"
    (here / "mod/jkl/rooms.jkl").write_text(two_rooms("World adjoins 2", "1: 0x7 1 1"))
    assert main(["pack", "create", "new.gob", "mod"]) == 0
    size = (here / "new.gob").stat().st_size
    assert capsys.readouterr().out == f"mod -> new.gob (2 files, {size} bytes)\n"
    assert main(["lint", "new.gob"]) == 1
    assert "new.gob!jkl/rooms.jkl" in capsys.readouterr().out


@pytest.mark.parametrize("path", GOBS, ids=lambda p: p.name)
def test_create_copies_every_pack_of_the_corpus_to_the_byte(path: Path, here: Path) -> None:
    shutil.copy(path, here / path.name)
    assert main(["pack", "create", "-q", "again.gob", path.name]) == 0
    assert (here / "again.gob").read_bytes() == path.read_bytes()


def bomb(mebibytes: int) -> bytes:
    """A zip of one GOB that inflates a thousandfold; its checksum is left 0, so that making it costs nothing."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    block = deflate.compress(bytes(2**20)) + deflate.flush(zlib.Z_FULL_FLUSH)
    data = block * mebibytes + deflate.flush()
    sizes = struct.pack("<III", 0, len(data), mebibytes * 2**20)
    start = struct.pack("<HHHHH", 20, 0, 8, 0, 0) + sizes + struct.pack("<HH", 5, 0)
    entry = b"PK\1\2\x14\0" + start + bytes(14) + b"a.gob"
    local = b"PK\3\4" + start + b"a.gob" + data
    return local + entry + struct.pack("<4s4H2IH", b"PK\5\6", 0, 0, 1, 1, len(entry), len(local), 0)


@pytest.mark.parametrize(
    ("mebibytes", "message"),
    [
        (20, "it is damaged (bad crc-32"),
        (900, "not enough memory for its 943718400 bytes"),
        (1025, "it claims 1074790400"),
    ],
)
def test_a_bomb_is_one_sentence_in_bounded_memory(mebibytes: int, message: str, here: Path) -> None:
    write(here / "site/bomb.zip", bomb(mebibytes))
    code = (
        "import resource, sys; resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30));"
        "from jktools.cli import main; sys.exit(main(sys.argv[1:]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "lint", "site", "p.gob"], capture_output=True, text=True, check=False,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.startswith(f"jktools: error: cannot read site/bomb.zip!a.gob: {message}")
    assert done.stderr.count("\n") == 1
    assert "in 2 files" in done.stdout


@pytest.mark.parametrize(
    ("words", "status", "message"),
    [
        ("pack list no.gob", 2, "jktools: error: cannot read no.gob: no such file or folder\n"),
        ("pack list p.gob!cog/wait.cog", 2, "p.gob!cog/Wait.cog: expected a GOB, GOO, zip or folder, but it is none\n"),
        ("pack list .", 0, ""),
        ("pack extract p.gob", 2, "Missing option '-o' / '--output'"),
        ("pack extract p.gob -o out -q *.mat", 2, "cannot extract from p.gob: no file in it matches *.mat\n"),
        ("pack extract p.gob -o out -q", 0, ""),
        ("pack extract p.gob -o p.gob/out", 2, "cannot write below p.gob: it is a file, not a folder\n"),
        ("pack create p.gob", 2, "Missing argument 'FOLDER|PACK'"),
        ("pack create out.gob p.gob -q", 0, ""),
        ("pack create site.zip/out.gob p.gob", 2, "cannot write below site.zip: it is a file, not a folder\n"),
        ("pack create new.zip p.gob", 2, "cannot write new.zip: it would be a GOB, but is named as a zip\n"),
        ("pack lost", 2, "No such command 'lost'"),
        ("pack --help", 0, ""),
    ],
)
def test_exit_statuses(words: str, status: int, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words.split()) == status
    err = capsys.readouterr().err
    assert message in err
    assert bool(err) == bool(message)
