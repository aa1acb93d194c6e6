"""What once broke a run: each input here made jktools crash, hang, lose results or overwrite something."""

from __future__ import annotations

import importlib
import json
import os
import re
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from jktools.cli import main
from jktools.compiler import CompiledFileError, CompiledLevel, CompileSettings, compile_level
from jktools.session import checking, compiling
from jktools.source import Member
from tests.support.levels import TWO_ROOMS, level_of, two_rooms

BROKEN = two_rooms("World adjoins 2", "1: 0x7 1 1")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.jkl").write_text(BROKEN)
    return tmp_path


def codes_of(text: str) -> list[str]:
    return [d.code.id for d in level_of(text).diagnostics]


@pytest.mark.parametrize("heading", ["World sounds", "World models", "World templates", "World Colormaps"])
@pytest.mark.parametrize("count", ["-1", "-5", "-2147483648", "9" * 50, "9" * 900])
def test_any_count_is_read(heading: str, count: str) -> None:
    text = re.sub(rf"{heading} \d+", f"{heading} {count}", TWO_ROOMS)
    assert ("JK001" in codes_of(text)) == count.startswith("-")


def test_layers_that_are_shorter_than_they_say() -> None:
    text = TWO_ROOMS + "Section: Layers\nEditor layers 2\nOne\n5: 1 2 3\n2: 1 2\nTwo\n0:\n0:\nend\n"
    assert level_of(text).document.layers[0].sectors == (1, 2, 3)


@pytest.mark.parametrize("blank", ["\xa0", "\x1f", "\x85", "\x1c"])
def test_only_the_engines_blanks_part_words(blank: str) -> None:
    for line in ("Sector 1", "World vertices 12", "Flags 0x0", "0: 0x7 1 1", "World Gravity 4"):
        level = level_of(TWO_ROOMS.replace(line, line.replace(" ", blank, 1), 1))
        assert level.diagnostics


@pytest.mark.parametrize("digits", ["9" * 3000, "-" + "9" * 3000])
def test_numbers_of_any_length_over_joined_lines(digits: str) -> None:
    joined = " \\\n".join([f"0: 0x7 {digits[:900]}", digits[900:1800], digits[1800:] + " 1"])
    assert level_of(TWO_ROOMS.replace("0: 0x7 1 1", joined.replace(" \\\n", "\\\n"))).diagnostics


def test_header_numbers_beyond_the_engine(here: Path) -> None:
    for old, new in (("Version 1", "Version 99999999999"), ("World Gravity 4", "World Gravity 1e99")):
        level = level_of(TWO_ROOMS.replace(old, new))
        assert [d.code.id for d in level.diagnostics] == ["JK002"]
        assert compile_level(level)


def test_hex_takes_a_sign_as_scanf_does() -> None:
    assert level_of(two_rooms("World adjoins 2", "0: -1 1 1")).adjoins[0].flags == 0xFFFFFFFF


def test_a_list_that_announces_nothing_needs_no_end() -> None:
    assert codes_of(two_rooms("World models 0", "- end")) == []


def test_a_misspelt_heading_hides_nothing() -> None:
    level = level_of(TWO_ROOMS.replace("World vertices 12", "Wrold vertices 12"))
    assert [d.code.id for d in level.diagnostics] == ["JK001"]
    assert (len(level.vertices), len(level.surfaces)) == (12, 12)


def test_a_bug_on_one_file_leaves_the_others(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "mod").mkdir()
    for name in "ab":
        (here / f"mod/{name}.jkl").write_text(BROKEN)
    real = checking.read_level

    def failing(member: Member, *rest: object) -> object:
        if member.name == "a.jkl":
            raise ZeroDivisionError("by nought")
        return real(member, *rest)

    for module in (checking, compiling):
        monkeypatch.setattr(module, "read_level", failing)
    assert main(["lint", "mod", "--format", "json"]) == 3
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [(d["code"], d["path"]) for d in found] == [("JK902", "mod/a.jkl"), ("JK201", "mod/b.jkl")]
    assert main(["build", "mod", "-o", "out"]) == 3
    assert (here / "out/b.jklb").exists()
    assert "mod/a.jkl: jktools failed on this file: ZeroDivisionError" in capsys.readouterr().err


def test_a_bug_is_never_hidden(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (here / "jktools.toml").write_text("[[ignore]]\ncode = 'JK901'\n")
    (here / "broken.jkl").write_text(BROKEN + "# jktools: ignore-file JK901\n")
    module = importlib.import_module("jktools.linter.rules.topology.adjoin_mirror_mismatch")
    monkeypatch.setattr(module, "Label", None)
    assert main(["lint", "broken.jkl"]) == 3


def test_a_name_that_is_no_utf8(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkdir(b"odd")  # noqa: PTH102 (bytes)
    with open(b"odd/\xff.jkl", "w") as stream:  # noqa: PTH123 (bytes)
        stream.write(BROKEN)
    assert main(["lint", "odd", "--format", "json"]) == 1
    assert json.loads(capsys.readouterr().out)["diagnostics"][0]["path"] == "odd/\\xff.jkl"
    assert main(["lint", "odd", "--output", "report.txt"]) == 1
    assert main(["build", "odd", "-o", "out"]) in (0, 2)


def test_a_damaged_text_in_a_compiled_level() -> None:
    data = bytearray(compile_level(level_of(TWO_ROOMS), CompileSettings(plain=True)))
    at = data.index(b"wind.wav")
    data[at] = 0xFF
    with pytest.raises(CompiledFileError, match="the file is damaged"):
        _ = CompiledLevel(bytes(data)).strings


def test_output_goes_through_pipes_and_links(here: Path) -> None:
    os.mkfifo("pipe")
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append(Path("pipe").read_bytes()))
    reader.start()
    assert main(["lint", "broken.jkl", "--output", "pipe"]) == 1
    reader.join(10)
    assert stat.S_ISFIFO(os.stat("pipe").st_mode)  # noqa: PTH116
    assert b"JK201" in read[0]
    Path("link.txt").symlink_to(here / "target.txt")
    main(["lint", "broken.jkl", "--output", "link.txt"])
    assert Path("link.txt").is_symlink()
    assert "JK201" in Path("target.txt").read_text()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_an_output_that_cannot_be_written() -> None:
    with open("/dev/full", "w") as full:  # noqa: PTH123
        done = subprocess.run(
            [sys.executable, "-m", "jktools", "lint", "broken.jkl"], stdout=full, stderr=subprocess.PIPE, check=False
        )
    assert done.returncode == 2
    assert b"Traceback" not in done.stderr


def test_a_target_that_cannot_be_written_leaves_the_others(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "good.jkl").write_text(TWO_ROOMS)
    (here / "out/broken.jklb").mkdir(parents=True)
    assert main(["build", "broken.jkl", "good.jkl", "-o", "out"]) == 2
    assert (here / "out/good.jklb").is_file()
    assert "cannot write out/broken.jklb" in capsys.readouterr().err


def test_equal_names_in_subfolders(here: Path) -> None:
    for mod in "ab":
        (here / f"mods/{mod}/jkl").mkdir(parents=True)
        (here / f"mods/{mod}/jkl/x.jkl").write_text(TWO_ROOMS)
    assert main(["build", "mods", "-o", "out", "-q"]) == 0
    assert main(["build", "mods/a/../../mods", "-o", "deep/out", "-q"]) == 0
    for out in ("out", "deep/out"):
        assert sorted(p.relative_to(here / out).as_posix() for p in (here / out).rglob("*.jklb")) == [
            "mods/a/jkl/x.jklb",
            "mods/b/jkl/x.jklb",
        ]


def test_one_file_is_one_file_however_it_is_typed(capsys: pytest.CaptureFixture[str]) -> None:
    main(["lint", "broken.jkl", "./broken.jkl"])
    assert "1 error in 1 file" in capsys.readouterr().out


@pytest.mark.parametrize("path", ["", "pipe"])
def test_what_is_no_file(path: str) -> None:
    os.mkfifo("pipe")
    assert main(["lint", path]) == 2


def test_thousands_of_sections_take_no_thousands_of_looks(here: Path) -> None:
    (here / "many.jkl").write_text("".join(f"SECTION: S{i}\n" for i in range(100_000)))
    command = [sys.executable, "-m", "jktools", "lint", "many.jkl"]
    done = subprocess.run(command, timeout=20, check=False, capture_output=True)  # it took 22 s, now under 1
    assert done.returncode == 1


def test_a_surface_of_thousands_of_corners(here: Path) -> None:
    corners = " \\\n".join(" ".join(f"{i % 12},0" for i in range(k, k + 50)) for k in range(0, 5000, 50))
    line = f"1: 0 0x4 0x4 4 3 1 -1 0 5000 \\\n{corners} \\\n" + " \\\n".join(["1 " * 100] * 50)
    (here / "round.jkl").write_text(TWO_ROOMS.replace("1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1", line))
    assert main(["lint", "round.jkl", "--select", "JK205,JK302,JK303"]) == 1


def test_what_is_selected_runs_whatever_the_configuration_ignores(capsys: pytest.CaptureFixture[str]) -> None:
    Path("jktools.toml").write_text("[lint]\nignore = ['JK201']\n")
    assert main(["lint", "broken.jkl"]) == 0
    assert main(["lint", "broken.jkl", "--select", "JK201"]) == 1


def test_a_configuration_in_a_folder_with_an_odd_name() -> None:
    Path("wow!").mkdir()
    Path("wow!/x.jkl").write_text(BROKEN)
    Path("wow!/jktools.toml").write_text("[lint]\nignore = ['JK201']\n")
    assert main(["lint", "wow!/x.jkl"]) == 0


@pytest.mark.parametrize("typed", ["broken.jkl", ".", "../{here}/broken.jkl"])
def test_a_pattern_means_the_same_however_the_path_is_typed(typed: str, here: Path) -> None:
    Path("jktools.toml").write_text("[[ignore]]\ncode = 'JK201'\npath = '*/broken.jkl'\n")
    assert main(["lint", typed.format(here=here.name)]) == 0


def test_a_file_cannot_steer_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    Path("esc.jkl").write_text(two_rooms("World adjoins 2", "0: 0x7 \x1b[31m 1"))
    main(["lint", "esc.jkl"])
    assert "\x1b" not in capsys.readouterr().out


def test_an_adjoin_that_is_its_own_mirror() -> None:
    Path("self.jkl").write_text(two_rooms("World adjoins 2", "0: 0x7 0 1", "1: 0x7 1 1"))
    assert main(["lint", "self.jkl", "--select", "JK201"]) == 1
