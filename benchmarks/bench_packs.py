"""Packs of many small files: made, unpacked with and without waiting for the disk, read from a zip."""

from __future__ import annotations

import random
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

from jktools.session.packs import create, extract
from jktools.session.write import write_atomically
from jktools.source import Pack, resolve

FILES = 5000
SIZE = 1000


def test_many_small_files(tmp_path: Path) -> None:
    mod = tmp_path / "mod"
    mod.mkdir()
    noise = random.Random(1)
    for index in range(FILES):
        (mod / f"{index}.mat").write_bytes(noise.randbytes(SIZE))
    with zipfile.ZipFile(tmp_path / "p.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for path in mod.iterdir():
            archive.write(path, path.name)

    print(f"\n{FILES} files of {SIZE} bytes")
    _time("pack create", lambda: create(tmp_path / "p.gob", str(mod)))
    _time("pack extract", lambda: extract(str(tmp_path / "p.gob"), tmp_path / "out"))
    _time("write, durable", lambda: _write(mod, tmp_path / "durable"))
    _time("read all of a GOB", lambda: _read(tmp_path / "p.gob"))
    _time("read all of a zip", lambda: _read(tmp_path / "p.zip"))


def _time(title: str, run: Callable[[], object]) -> None:
    started = time.perf_counter()
    run()
    print(f"{title:<20}{time.perf_counter() - started:>8.2f} s")


def _write(mod: Path, out: Path) -> None:
    for path in mod.iterdir():
        write_atomically(out / path.name, path.read_bytes())


def _read(path: Path) -> None:
    pack = resolve(str(path))
    assert isinstance(pack, Pack)
    assert sum(len(m.read().data) for m in pack.members) == FILES * SIZE
