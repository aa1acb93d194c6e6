"""Mapping a file: as here, and as on Windows, over a stand-in for its calls."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from tests.runtime.compiler import PLAIN, built
from tests.support.levels import ROOT

SYSTEMS = {"posix": PLAIN, "windows": (*PLAIN, "-D_WIN32", "-I", str(ROOT / "tests/runtime/windows"))}


@pytest.mark.parametrize("system", SYSTEMS)
def test_a_file_is_mapped_or_refused_in_words(system: str, programs: Path, tmp_path: Path) -> None:
    program = built("tests/runtime/mapping.cpp", programs / f"mapping_{system}", SYSTEMS[system])
    (tmp_path / "café 試").write_bytes(b"text")
    (tmp_path / "empty").touch()
    (tmp_path / "folder").mkdir()
    (tmp_path / "without end").symlink_to("/dev/zero")
    names = ["café 試", "empty", "folder", "nowhere", "café 試/beneath", "without end"]
    done = subprocess.run([program, *names], capture_output=True, text=True, check=False, cwd=tmp_path)
    *told, last = done.stdout.splitlines()
    beneath = "no such file or directory" if system == "windows" else "not a directory"
    assert told == ["4 text", "the file is empty", "is a directory", "no such file or directory", beneath]
    assert last == "it is no file"
    assert done.returncode == 0


def test_a_pipe_is_not_waited_for(programs: Path, tmp_path: Path) -> None:
    program = built("tests/runtime/mapping.cpp", programs / "mapping_posix", PLAIN)
    os.mkfifo(tmp_path / "pipe")
    done = subprocess.run([program, tmp_path / "pipe"], capture_output=True, text=True, check=False, timeout=20)
    assert (done.returncode, done.stdout) == (0, "it is no file\n")
