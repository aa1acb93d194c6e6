"""The insert offset of a body: its own 3DO first, then the table, and never a guess."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import jktools
from jktools.model.insert_offset import insert_offset
from tests.support.assets import BLOCK
from tests.support.levels import TWO_ROOMS, gob_of
from tests.support.packs import write


def test_file_then_table_then_unknown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    level = ("jkl\\x.jkl", TWO_ROOMS.encode())
    write(tmp_path / "mod.gob", gob_of([level, ("3do\\block.3do", BLOCK.encode()), ("3do\\bad.3do", b"")]))
    files = jktools.load("mod.gob").resources
    block, kyle = insert_offset(files, "BLOCK.3do"), insert_offset(files, "Ky.3do")
    assert block is not None
    assert (block.z, block.known, block.origin) == (float(np.float32(0.12)), False, "mod.gob!3do/block.3do")
    assert kyle is not None
    single = tuple(np.array((-5e-05, 0, 0.120114), np.float32).tolist())
    assert ((kyle.x, kyle.y, kyle.z), kyle.known) == (single, True), "as the file would say it"
    assert insert_offset(files, "tx.3do") is None
    assert insert_offset(files, "bad.3do") is None


def test_a_mods_own_ky_wins_and_a_broken_one_is_unknown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    level = ("jkl\\x.jkl", TWO_ROOMS.encode())
    for name, data, wanted in (("a", BLOCK.encode(), float(np.float32(0.12))), ("b", b"SECTION: HEADER", None)):
        write(tmp_path / f"{name}.gob", gob_of([level, ("3do\\ky.3do", data)]))
        found = insert_offset(jktools.load(f"{name}.gob").resources, "ky.3do")
        assert (found and found.z) == wanted
