"""The columns of the runtime as they lie in the file, and the templates of a level, against Python's."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.geometry import Accuracy
from tests.runtime.compiler import built
from tests.support.halls import halls
from tests.support.levels import ROOT, level_of, two_rooms

ROOMS = level_of(
    two_rooms(
        "World sounds 60", *(f"squeak_{i:02}.wav" for i in range(60)), "World templates 12",
        *(f"box{i} crate size=.{i}" for i in range(1, 6)),
        "base none type=actor move=physics size=.1 health=40", "guard base health=60 soundclass=ky.snd",
        "captain guard frame=(1/2/3:4/5/6) light=.5", "shot guard type=weapon explode=captain",
    )
)  # fmt: skip


@pytest.mark.parametrize("accuracy", ["balanced", "fast"])
def test_what_the_stored_numbers_stand_for_is_what_the_column_answers(
    accuracy: Accuracy, programs: Path, tmp_path: Path
) -> None:
    program = built("tests/runtime/columns.cpp", programs / "columns")
    path = tmp_path / "halls.jklb"
    seen = dict.fromkeys(("narrow", "pooled", "grids", "runs", "absent"), 0)
    for level in (halls(), ROOMS):
        path.write_bytes(compile_level(level, CompileSettings(accuracy=accuracy)))
        done = subprocess.run([program, path], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        for kind, found in re.findall(r"(\w+) (\d+)", done.stdout):
            if kind in seen:
                seen[kind] += int(found)
    assert bool(seen.pop("grids")) == (accuracy == "fast")
    assert all(seen.values()), seen


def test_every_value_of_every_template_is_what_python_reads(programs: Path, tmp_path: Path) -> None:
    program = built("tests/runtime/templates.cpp", programs / "templates")
    new = tmp_path / "rooms.jklb"
    new.write_bytes(compile_level(ROOMS))
    data = ROOT / "tests/data"
    for path in (new, data / "two_rooms_1_0.jklb", data / "two_rooms_1_1.jklb", data / "two_rooms_1_2.jklb"):
        done = subprocess.run([program, path], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert [line.split("\t") for line in done.stdout.splitlines()] == list(told(CompiledLevel(path.read_bytes())))


def told(level: CompiledLevel) -> list[list[str]]:
    """What the program prints of a level, by key in the order of the strings."""
    t = level.templates
    assert t is not None
    if not hasattr(t, "value_key"):
        return []
    lines = []
    for row in range(len(t.source)):
        values = sorted(range(t.value_start[row], t.value_start[row + 1]), key=lambda i: int(t.value_key[i]))
        for i in values:
            numbers = t.number[t.number_start[i] : t.number_start[i + 1]].tolist()
            text = "" if t.value_text[i] < 0 else level.strings[t.value_text[i]]
            lines.append([str(row), level.strings[t.value_key[i]], text, str(t.value_source[i]), *map(c_hex, numbers)])
    return lines


def c_hex(number: float) -> str:
    """As `%a` of the C library prints a double."""
    mantissa, exponent = number.hex().split("p")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return f"{mantissa if mantissa != '0x' else '0x0'}p{exponent}"
