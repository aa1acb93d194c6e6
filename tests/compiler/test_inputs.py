"""The files that a compiled level lists: all that it depends on, however it came to be compiled."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import jktools
from fixtures.smithdev.pack import GOB
from jktools.cli import main
from jktools.compiler import CompiledFileError, CompiledLevel, CompileSettings, compile_level, open_compiled
from jktools.compiler.checksum import seal
from jktools.session import load
from tests.support.levels import TWO_ROOMS, gob_of, level_of

SCRIPT = b"symbols\nmessage startup\nend\ncode\nstartup:\nreturn;\nend\n"
FILES = {"jkl/rooms.jkl": TWO_ROOMS.encode(), "cog/Door.cog": SCRIPT, "3do/mat/wall.mat": b"MAT "}


def folder_of(place: Path, files: dict[str, bytes] = FILES) -> Path:
    """A mod on disk."""
    for name, data in files.items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        (place / name).write_bytes(data)
    return place


def sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def test_what_was_read_and_what_was_not_found(tmp_path: Path) -> None:
    """By the game's folders and in lower case; a name by where it was found, or the first folder that is searched."""
    level = CompiledLevel(compile_level(load(str(folder_of(tmp_path)))))
    assert level.inputs == [
        ("jkl/rooms.jkl", sha256(TWO_ROOMS.encode())),
        ("3do/mat/wall.mat", sha256(b"MAT ")),
        ("cog/door.cog", sha256(SCRIPT)),
    ]
    assert level.missing_inputs == ["jkl/static.jkl", "misc/items.dat", "misc/cmp/rooms.cmp", "sound/wind.wav"]


def test_files_of_packs_and_bases_are_named_alike(tmp_path: Path) -> None:
    """No path of a machine is in the file: the bytes are those of the same files elsewhere."""
    made = []
    base = {name: FILES[name] for name in ("3do/mat/wall.mat",)}
    for place in (tmp_path / "here", tmp_path / "else/where"):
        place.mkdir(parents=True)
        packed = [(name.replace("/", "\\"), data) for name, data in FILES.items() if name not in base]
        (place / "mod.gob").write_bytes(gob_of(packed))
        game = folder_of(place / "game", base)
        made.append(compile_level(load(str(place / "mod.gob"), base=[str(game)])))
    assert made[0] == made[1]
    assert str(tmp_path).encode() not in made[0]
    assert CompiledLevel(made[0]).inputs[0] == ("jkl/rooms.jkl", sha256(TWO_ROOMS.encode()))
    assert [path for path, _ in CompiledLevel(made[0]).inputs[1:]] == ["3do/mat/wall.mat", "cog/door.cog"]


def test_a_file_right_beside_the_level_has_no_folder(tmp_path: Path) -> None:
    level = CompiledLevel(
        compile_level(load(str(folder_of(tmp_path, {"rooms.jkl": TWO_ROOMS.encode(), "door.cog": SCRIPT}))))
    )
    assert level.inputs[1:] == [("door.cog", sha256(SCRIPT))]


@pytest.fixture(scope="module")
def smithdev(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pack, unpacked."""
    place = tmp_path_factory.mktemp("smithdev") / "mod"
    assert main(["pack", "extract", str(GOB), "-o", str(place)]) == 0
    return place


WASTE = (
    "cog/waste.cog", "3do/waste.3do", "mat/waste.mat", "3do/mat/waste.mat", "3do/key/waste.key", "misc/pup/ky.pup",
    "misc/snd/ky.snd", "misc/cmp/waste.cmp", "misc/ai/waste.ai", "misc/par/waste.par", "misc/spr/waste.spr",
    "sound/waste.wav", "jkl/waste.jkl", "misc/cogstrings.uni",
)  # fmt: skip


def test_a_file_that_is_not_listed_changes_nothing(smithdev: Path) -> None:
    """All other files of the mod become waste, and waste of every kind is added to them."""
    path = str(smithdev / "jkl/smithdev.jkl")
    data = compile_level(load(path))
    level = CompiledLevel(data)
    listed = {name for name, _ in level.inputs} | set(level.missing_inputs) | {"jkl/smithdev.jkl"}
    files = {p: p.read_bytes() for p in smithdev.rglob("*") if p.is_file()}
    others = [p for p in files if p.relative_to(smithdev).as_posix().lower() not in listed]
    assert smithdev / "episode.jk" in others
    assert len(files) - len(others) == len(level.inputs) > 60
    laid = [smithdev / name for name in WASTE if name not in listed]
    assert len(laid) > 10
    try:
        for place in (*others, *laid):
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(b"waste")
        assert compile_level(load(path)) == data
    finally:
        for place in laid:
            place.unlink()
        for place in others:
            place.write_bytes(files[place])


def test_what_was_asked_before_is_no_input(smithdev: Path) -> None:
    """Lint looks for more files than the compiler: a level that was linted compiles to the same bytes."""
    path = str(smithdev / "jkl/smithdev.jkl")
    level = load(path)
    plain = jktools.build(level)
    jktools.lint(level)
    assert len(level.resources.looked_for) > len(CompiledLevel(plain).inputs)
    assert jktools.build(level) == plain == compile_level(load(path))


def test_only_what_the_passes_that_ran_looked_for(smithdev: Path) -> None:
    level = load(str(smithdev / "jkl/smithdev.jkl"))
    whole = CompiledLevel(compile_level(level))
    things = CompiledLevel(compile_level(level, CompileSettings(only=frozenset(("things",)))))
    assert set(things.inputs) < set(whole.inputs)


@pytest.mark.parametrize("seed", ["0", "1", "77"])
def test_the_list_does_not_depend_on_the_hash_seed(smithdev: Path, tmp_path: Path, seed: str) -> None:
    command = [
        sys.executable,
        "-m",
        "jktools",
        "build",
        str(smithdev / "jkl"),
        "-o",
        str(tmp_path / "level.jklb"),
        "-q",
    ]
    subprocess.run([*command, "--config", "none"], check=True, env={**os.environ, "PYTHONHASHSEED": seed}, timeout=120)
    assert (tmp_path / "level.jklb").read_bytes() == compile_level(load(str(smithdev / "jkl/smithdev.jkl")))


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_levels_that_share_files_list_their_own(tmp_path: Path, jobs: str) -> None:
    """What one level read is kept for the next: the next one lists it all the same, and no more than its own."""
    other = TWO_ROOMS.replace("door.cog", "lift.cog")
    folder_of(tmp_path, {**FILES, "jkl/halls.jkl": other.encode(), "jkl/rooms2.jkl": FILES["jkl/rooms.jkl"]})
    (tmp_path / "cog/lift.cog").write_bytes(SCRIPT)
    assert main(["build", str(tmp_path), "-o", str(tmp_path / "out"), "-q", "--jobs", jobs]) == 0
    halls, rooms, rooms2 = (open_compiled(tmp_path / f"out/{name}.jklb") for name in ("halls", "rooms", "rooms2"))
    assert [path for path, _ in halls.inputs] == ["jkl/halls.jkl", "3do/mat/wall.mat", "cog/lift.cog"]
    assert rooms.inputs[1:] == rooms2.inputs[1:]
    assert [path for path, _ in rooms.inputs[1:]] == ["3do/mat/wall.mat", "cog/door.cog"]


def test_a_list_that_does_not_fit_its_digests_is_refused(tmp_path: Path) -> None:
    data = compile_level(load(str(folder_of(tmp_path))))
    found = CompiledLevel(data).sections["files"].stored["found"].values
    assert found is not None
    place = found.__array_interface__["data"][0] - np.frombuffer(data, np.uint8).__array_interface__["data"][0]
    assert data[place] == 1
    level = CompiledLevel(seal(data[:place] + b"\0" + data[place + 1 :]), verify=True)
    with pytest.raises(CompiledFileError, match="the file is damaged; build it again"):
        _ = level.inputs


def test_a_level_without_files_lists_its_source_alone() -> None:
    level = CompiledLevel(compile_level(level_of(TWO_ROOMS)))
    assert level.inputs == [("test.jkl", sha256(TWO_ROOMS.encode()))]
    assert "cog/door.cog" in level.missing_inputs
