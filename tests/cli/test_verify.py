"""`jktools inspect --verify`: compiled again from the source, and without it what the file itself tells."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from jktools.cli import main
from jktools.compiler import CompiledLevel, CompileSettings, compile_level, open_compiled, passes
from jktools.compiler.checksum import seal
from jktools.compiler.passes import PASSES, Pass
from jktools.compiler.sections import NotNeeded
from jktools.compiler.verification import by_itself, first_difference
from jktools.session.verifying import verify
from tests.compiler.test_scene_sections import LAMP
from tests.support.levels import ROOT, TWO_ROOMS, gob_of, level_of, level_with_files, two_rooms

SCRIPT = b"symbols\nmessage startup\nend\ncode\nstartup:\nreturn;\nend\n"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rooms.jkl").write_text(TWO_ROOMS)
    (tmp_path / "out").mkdir()
    return tmp_path


def changed(data: bytes, section: str, column: str, value: int, octet: int = 0) -> bytes:
    """The file with one byte of a column's first number changed, and a checksum that says it is whole."""
    values = CompiledLevel(data).sections[section].stored[column].values
    assert values is not None
    whole = np.frombuffer(data, np.uint8).__array_interface__["data"][0]
    at = values.__array_interface__["data"][0] - whole + octet
    return seal(data[:at] + value.to_bytes(1, "little") + data[at + 1 :])


@pytest.mark.parametrize("words", [[], ["--accuracy", "fast"], ["--engine", "openjkdf2", "--skip", "ledges"]])
def test_a_level_beside_its_source(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "rooms.jkl", "-o", ".", "-q", *words]) == 0
    assert main(["inspect", "rooms.jklb", "--verify"]) == 0
    shown = capsys.readouterr().out
    assert "  the checksum is that of the file\n" in shown
    assert "  compiled again from rooms.jkl: every section is as in the file\n" in shown


@pytest.mark.parametrize("place", ["--source pack.gob", "--source pack.gob!jkl/rooms.jkl", "--base pack.gob"])
def test_a_source_elsewhere(place: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "pack.gob").write_bytes(
        gob_of([("jkl\\other.jkl", b"SECTION: JK\n"), ("jkl\\rooms.jkl", TWO_ROOMS.encode())])
    )
    assert main(["build", "pack.gob!jkl/rooms.jkl", "-o", "out", "-q"]) == 0
    assert main(["inspect", "out/rooms.jklb", "--verify", *place.split(), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/inspect.schema.json").read_text()))
    assert report["fault"] is None
    assert report["verified"][-1] == "compiled again from pack.gob!jkl/rooms.jkl: every section is as in the file"


def test_what_differs_is_named_and_ends_with_1(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data = compile_level(level_of(TWO_ROOMS, "rooms.jkl"))
    (here / "rooms.jklb").write_bytes(changed(data, "geometry", "vertices", 0x40, octet=3))
    assert main(["inspect", "rooms.jklb", "--verify", "--json"]) == 1
    shown = capsys.readouterr()
    fault = "geometry.vertices 0 is [2. 0. 0.], but [0. 0. 0.] when compiled again"
    assert shown.err == f"jktools: error: rooms.jklb is not what it was compiled from: {fault}\n"
    assert json.loads(shown.out)["fault"] == fault


def test_without_the_source_the_file_is_held_against_itself(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "rooms.jkl", "-o", "out", "-q"]) == 0
    assert main(["inspect", "out/rooms.jklb", "--verify"]) == 2
    said = capsys.readouterr()
    assert "  its source rooms.jkl is not at hand: nothing is derived again from it\n" in said.out
    assert "  what can be seen through the file's own adjoins: the file says nothing else\n" in said.out
    why = "cannot verify out/rooms.jklb: its source rooms.jkl is not at hand; name it with --source PATH"
    assert said.err == f"jktools: error: {why}\n"
    data = (here / "out/rooms.jklb").read_bytes()
    (here / "out/rooms.jklb").write_bytes(changed(data, "visibility", "row", 1))
    assert main(["inspect", "out/rooms.jklb", "--verify"]) == 1
    assert "sector 1 can be seen from sector 0, but the file denies it (1 such pairs)" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["--source", "rooms.jkl"], ["--base", "base"]])
def test_a_source_that_was_edited_since(here: Path, capsys: pytest.CaptureFixture[str], words: list[str]) -> None:
    (here / "base/jkl").mkdir(parents=True)
    (here / "base/jkl/other.jkl").write_text(TWO_ROOMS)
    assert main(["build", "rooms.jkl", "-o", ".", "-q"]) == 0
    (here / "rooms.jkl").write_text(TWO_ROOMS + "# edited\n")
    then, now = (hashlib.sha256(text.encode()).hexdigest() for text in (TWO_ROOMS, TWO_ROOMS + "# edited\n"))
    assert main(["inspect", "rooms.jklb", "--verify", *words]) == 1
    said = f"rooms.jklb is out of date: its source rooms.jkl is SHA-256 {now}, but was {then}\n"
    assert capsys.readouterr().err == f"jktools: error: {said}"


def test_another_source_is_refused(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "rooms.jkl", "-o", ".", "-q"]) == 0
    (here / "halls.jkl").write_text(TWO_ROOMS + "# edited\n")
    assert main(["inspect", "rooms.jklb", "--verify", "--source", "halls.jkl"]) == 2
    assert "cannot verify rooms.jklb by halls.jkl: it holds no file of SHA-256 " in capsys.readouterr().err
    assert main(["inspect", "rooms.jklb", "--source", "rooms.jkl"]) == 2
    assert "--source and --base are for --verify" in capsys.readouterr().err


# ---- the other inputs


def mod(here: Path) -> Path:
    """A mod of a level, its script and the material of a surface; compiled to `mod.jklb`."""
    for name, data in (("jkl/rooms.jkl", TWO_ROOMS.encode()), ("cog/door.cog", SCRIPT), ("mat/wall.mat", b"MAT ")):
        path = here / "mod" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    assert main(["build", "mod", "-o", "mod.jklb", "-q"]) == 0
    return here / "mod"


def verified(*words: str) -> int:
    return main(["inspect", "mod.jklb", "--verify", "--source", "mod/jkl/rooms.jkl", *words])


def test_inputs_are_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mod(here)
    assert verified("--json") == 0
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/inspect.schema.json").read_text()))
    level = open_compiled("mod.jklb")
    assert [tuple(each.values()) for each in report["level"]["inputs"]] == level.inputs
    assert report["level"]["missing_inputs"] == level.missing_inputs
    assert (
        report["verified"][1]
        == f"its inputs are what they were: 3 files, and {len(level.missing_inputs)} names that none has"
    )
    assert main(["inspect", "mod.jklb"]) == 0
    assert f"  and from 2 other files; {len(level.missing_inputs)} more looked for" in capsys.readouterr().out
    assert main(["inspect", "mod.jklb", "--inputs"]) == 0
    shown = capsys.readouterr().out
    assert f"    {hashlib.sha256(SCRIPT).hexdigest()}  cog/door.cog\n" in shown
    assert "    jkl/static.jkl\n" in shown and "    misc/items.dat\n" in shown


def test_an_input_that_changed_is_named(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script = mod(here) / "cog/door.cog"
    script.write_bytes(SCRIPT + b"# more\n")
    assert verified() == 1
    then, now = (hashlib.sha256(data).hexdigest() for data in (SCRIPT, SCRIPT + b"# more\n"))
    said = f"mod.jklb is out of date: its input cog/door.cog is SHA-256 {now}, but was {then}\n"
    assert capsys.readouterr().err == f"jktools: error: {said}"
    script.unlink()
    assert verified() == 1
    assert "out of date: its input cog/door.cog is not at hand\n" in capsys.readouterr().err


def test_an_input_that_is_new_is_named(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = mod(here)
    (folder / "misc").mkdir()
    (folder / "misc/items.dat").write_text("end\n")
    assert verified() == 1
    assert "out of date: its input misc/items.dat was not at hand, but is now\n" in capsys.readouterr().err


def test_what_no_pass_looks_for_is_no_input(here: Path) -> None:
    folder = mod(here)
    (folder / "cog/other.cog").write_bytes(SCRIPT)
    (folder / "readme.txt").write_text("read me")
    assert verified() == 0


def test_a_pass_that_failed_is_told(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def compute(*_: object) -> NotNeeded:
        raise ZeroDivisionError("nothing to divide by")

    monkeypatch.setattr(passes, "PASSES", {**PASSES, "lights": Pass("lights", compute)})
    assert main(["build", "rooms.jkl", "-o", ".", "-q", "--keep-going"]) == 3
    capsys.readouterr()
    assert main(["inspect", "rooms.jklb"]) == 0
    shown = capsys.readouterr().out
    assert "    lights             failed  (the pass lights failed on rooms.jkl: ZeroDivisionError" in shown
    assert "    hotspots          not run  (no script" in shown
    assert open_compiled("rooms.jklb").passes["lights"]["failed"]


def test_light_is_computed_again() -> None:
    with level_with_files(*LAMP) as level:
        data = compile_level(level)
    assert [fault for _, fault in by_itself(CompiledLevel(data), "balanced")] == [None, None]
    dimmer = CompiledLevel(changed(data, "lights", "amount", 0x3E, octet=3))
    faults = dict(by_itself(dimmer, "balanced"))
    assert "light 0 gives vertex 0" in str(faults["the light of lamps on the file's own vertices"])


@pytest.mark.parametrize(
    ("other", "fault"),
    [
        (two_rooms("World cogs 0", "- 0: door.cog 3 -1 wind.wav"), "the section cogs is there, but absent"),
        (TWO_ROOMS.replace("wind.wav", "rain.wav"), "resources.sounds 0 is 'wind.wav', but 'rain.wav'"),
        (TWO_ROOMS.replace("World Gravity 4", "World Gravity 3"), "world.gravity is 4.0, but 3.0"),
        (two_rooms("World things 3", "7: ghost x .5 .5 .5 0 0 0 0"), "things.source has 2 rows, but 3"),
    ],
)  # fmt: skip
def test_the_first_difference(other: str, fault: str) -> None:
    one, two = (CompiledLevel(compile_level(level_of(text))) for text in (TWO_ROOMS, other))
    assert str(first_difference(one, two)).startswith(fault)
    assert first_difference(one, one) is None


def test_a_file_of_an_older_format_is_verified_by_what_both_have(here: Path) -> None:
    (here / "two_rooms.jkl").write_text(TWO_ROOMS)
    (here / "two_rooms.jklb").write_bytes((ROOT / "tests/data/two_rooms_1_1.jklb").read_bytes())
    verdict = verify(open_compiled("two_rooms.jklb", verify=True))
    assert verdict.fault is None
    assert verdict.told == ["compiled again from two_rooms.jkl: every section is as in the file"]


def test_settings_are_recorded() -> None:
    settings = CompileSettings(
        "openjkdf2", "exact", frozenset({"things"}), frozenset({"ledges"}), cut_anyway=True, plain=True
    )
    level = CompiledLevel(compile_level(level_of(TWO_ROOMS), settings))
    assert (level.only, level.skip, level.cut_anyway, level.plain) == (["things"], ["ledges"], True, True)
    assert level.settings == {"game": "jk", "engine": "openjkdf2", "accuracy": "exact"}
