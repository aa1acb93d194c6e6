"""Standard output and error that are closed, full, or of an encoding that lacks a character."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.levels import TWO_ROOMS

NO_FULL = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rooms.jkl").write_text(TWO_ROOMS)
    return tmp_path


def shell(line: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """What bash makes of a line in which JK stands for jktools."""
    line = line.replace("JK ", f"{sys.executable} -m jktools ")
    plain = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    return subprocess.run(
        ["bash", "-c", line], capture_output=True, text=True, check=False, timeout=60, env={**plain, **environment}
    )


@pytest.mark.parametrize(
    ("line", "status"),
    [
        ("JK lint rooms.jkl <&-", 0),
        ("JK lint rooms.jkl >&-", 0),
        ("JK lint rooms.jkl 2>&-", 0),
        ("JK lint rooms.jkl <&- >&- 2>&-", 0),
        ("JK build rooms.jkl -o out >&-", 0),
        ("JK tradeoff rooms.jkl --passes location --tiers fast --queries 8 >&-", 0),
        ("JK lint none.jkl 2>&-", 2),
        ("JK lint --nonsense 2>&-", 2),
        ("JK --version >&-", 0),
    ],
)
def test_a_closed_stream_swallows_what_is_said(line: str, status: int) -> None:
    done = shell(line)
    assert done.returncode == status
    assert "rror" not in done.stderr or status == 2


@NO_FULL
@pytest.mark.parametrize("words", ["--version", "--help", "rules"])
def test_a_full_disk_is_told(words: str) -> None:
    done = shell(f"JK {words} >/dev/full")
    assert done.returncode == 2
    assert done.stderr == "jktools: error: cannot write the output: no space left on device\n"


@NO_FULL
@pytest.mark.parametrize("words", ["lint none.jkl", "lint --nonsense", "lunt"])
def test_the_status_tells_where_standard_error_cannot(words: str) -> None:
    assert shell(f"JK {words} 2>/dev/full").returncode == 2


@pytest.mark.parametrize("words", ["--version", "rules", "explain JK701", "lint rooms.jkl"])
def test_a_reader_that_is_gone_ends_the_run_as_it_does_others(words: str) -> None:
    done = shell(f"(sleep 1; JK {words}; echo $? >&2) | true")
    assert done.stderr == "141\n"


def test_a_character_that_the_output_lacks_is_escaped(here: Path) -> None:
    (here / "rooms.jkl").rename(here / "räume.jkl")
    done = shell("JK build räume.jkl -o out", PYTHONIOENCODING="cp1251")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("r\\xe4ume.jkl -> out/r\\xe4ume.jklb (")


@pytest.mark.parametrize("home", [{"HOME": "/nonexistent"}, {"HOME": ""}, {"XDG_CACHE_HOME": "/proc/none"}])
def test_no_place_for_a_cache_is_needed(home: dict[str, str]) -> None:
    assert shell("JK lint rooms.jkl", **home).stdout == "no findings in 1 file\n"
