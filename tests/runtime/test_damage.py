"""Damaged files: the runtime refuses or answers, never crashes, and refuses what Python does in the same words."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from jktools.compiler import CompiledFileError, CompiledLevel, compile_level
from tests.runtime.compiler import PLAIN, SANITIZED, built
from tests.support.halls import halls
from tests.support.levels import ROOT, level_of, two_rooms

FUZZ = bool(os.environ.get("JKTOOLS_FUZZ"))
STRIDE = 1 if FUZZ else 5
NAMES = (
    "World sounds 60", *(f"squeak_{i:02}.wav" for i in range(60)), "World templates 9", "guard walkplayer health=60",
)  # fmt: skip
COMPILED = compile_level(level_of(two_rooms(*NAMES)))
"""With texts by symbols, and a template that rests on another."""
OLD = ("two_rooms_1_0.jklb", "two_rooms_1_1.jklb", "two_rooms_1_2.jklb")


@pytest.fixture(scope="session")
def damage(programs: Path) -> Path:
    """The program that damages files; with the sanitizers in `make fuzz`, since they take a while to compile."""
    return built("tests/runtime/damage.cpp", programs / "damage", SANITIZED if FUZZ else PLAIN)


def files() -> Iterator[tuple[str, bytes]]:
    yield "two_rooms", COMPILED
    for name in OLD:
        yield name, (ROOT / "tests/data" / name).read_bytes()
    if FUZZ:
        yield "halls", compile_level(halls())


@pytest.mark.parametrize(("name", "data"), list(files()), ids=lambda x: x if isinstance(x, str) else "")
def test_damage_is_refused_or_answered(name: str, data: bytes, damage: Path, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(data)
    done = subprocess.run([damage, path, str(STRIDE)], capture_output=True, text=True, check=False, timeout=1800)
    assert done.returncode == 0, done.stderr
    counts = {kind: (int(a), int(r)) for kind, a, r in re.findall(r"(\w+): (\d+) answered, (\d+) refused", done.stdout)}
    assert counts["whole"] == (1, 0)
    for kind in ("flipped", "numbers"):
        assert min(counts[kind]) > 100, counts
    assert counts["cut"][1] >= len(data) // STRIDE - 8, "only what pads the end can be cut"


def damaged(rng: np.random.Generator) -> bytes:
    """A byte, or a number of four, changed."""
    data = bytearray(COMPILED)
    if rng.random() < 0.5:
        data[rng.integers(8, len(data))] ^= int(rng.choice([1, 2, 16, 128, 255]))
    else:
        at = 4 * int(rng.integers(2, len(data) // 4))
        number = int.from_bytes(data[at : at + 4], "little")
        changed = int(rng.choice([0, 0xFFFFFFFF, 0x7FFFFFFF, number + 1, number * 2, number // 2]))
        data[at : at + 4] = (changed & 0xFFFFFFFF).to_bytes(4, "little")
    return bytes(data)


def python_says(data: bytes, path: str) -> str:
    """What is wrong with a file, as jklb_query words it; empty where it opens."""
    try:
        with np.errstate(all="ignore"):
            compiled = CompiledLevel(data, path)
            try:
                _ = compiled.visible_sectors
            except CompiledFileError:
                return "row"
    except CompiledFileError as error:
        return str(error).replace("this jktools reads", "this reader reads")
    return ""


def test_the_runtime_refuses_what_python_refuses_in_the_same_words(jklb_query: Path, tmp_path: Path) -> None:
    rng = np.random.default_rng(9)
    path = tmp_path / "level.jklb"
    seen = []
    for _ in range(3000 if FUZZ else 400):
        path.write_bytes(data := damaged(rng))
        done = subprocess.run([jklb_query, path], capture_output=True, check=False)
        said = done.stderr.decode("utf-8", "replace").removeprefix("jklb_query: error: ").strip()
        wanted = python_says(data, str(path))
        if wanted == "row":
            assert re.search(r"\(visibility\.row \d+ does not expand to 1 bytes\)$", said)
        else:
            assert said == wanted
        assert done.returncode == (2 if said else 0)
        seen.append(re.sub(r"\d+", "0", said))
    kinds = set(seen)
    assert "" in kinds
    assert len([kind for kind in kinds if "(" in kind]) > 10, "many a column was hit"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "cannot read {}: the file is empty"),
        (b"GOB " * 4, "cannot read {}: not a compiled level (no JKLB mark)"),
        (COMPILED[:8], "cannot read {}: the file is cut off or damaged; build it again"),
        (COMPILED[: len(COMPILED) // 2], "cannot read {}: the file is cut off or damaged; build it again"),
        (None, "cannot read {}: no such file or directory"),
    ],
)
def test_what_is_no_level_is_one_sentence(data: bytes | None, message: str, jklb_query: Path, tmp_path: Path) -> None:
    path = tmp_path / "x.jklb"
    if data is not None:
        path.write_bytes(data)
    done = subprocess.run([jklb_query, path], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"jklb_query: error: {message.format(path)}\n")


def test_a_folder_is_no_level(jklb_query: Path, tmp_path: Path) -> None:
    done = subprocess.run([jklb_query, tmp_path], capture_output=True, text=True, check=False)
    assert done.stderr == f"jklb_query: error: cannot read {tmp_path}: is a directory\n"


@pytest.mark.parametrize(("major", "minor"), [(2, None), (1, 9)])
def test_a_newer_version(major: int, minor: int | None, jklb_query: Path, tmp_path: Path) -> None:
    """Another major version is refused; a later minor one is read as far as it is known."""
    data = bytearray(COMPILED)
    root = CompiledLevel(COMPILED)._root._tab
    data[root.Offset(4) + root.Pos] = major
    if minor is not None:
        data[root.Offset(6) + root.Pos] = minor
    path = tmp_path / "new.jklb"
    path.write_bytes(data)
    done = subprocess.run([jklb_query, path], capture_output=True, text=True, check=False)
    assert done.stderr.removeprefix("jklb_query: error: ").strip() == python_says(bytes(data), str(path))
    assert done.returncode == (0 if minor else 2)
