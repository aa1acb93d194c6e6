"""Particle templates: the values that reach the engine rule, and where the cels come from."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

from jktools.facts.particles import Cloud, clouds
from jktools.session import load
from tests.support.levels import TWO_ROOMS, level_of, level_with_files, two_rooms

PARTEST = (
    "+partest none type=particle timer=0.200000 typeflags=0x00 material=00gsmoke.mat range=0.020000 rate=128.000000 "
    "maxthrust=30.000000 elementsize=0.007000 count=128"
)


def cloud(line: str) -> Cloud:
    (found,) = clouds(level_of(two_rooms("World templates 4", line)))
    return found


def test_the_documents_own_template_is_taken_whole() -> None:
    found = cloud(PARTEST)
    made = found.particles
    assert (made.spawned, made.timer_ms, made.lost_a_step, made.cels) == (128, 200, 12, 4)
    assert (made.range, made.elementsize, made.maxthrust) == pytest.approx((0.02, 0.007, 30))
    assert found.knows_cels  # Illustration 35


def test_cels_of_a_material_that_is_not_at_hand_are_not_known() -> None:
    assert not cloud(PARTEST.replace("00gsmoke", "mist")).knows_cels


def test_cels_come_from_the_material(tmp_path: Path) -> None:
    cels = b"".join(struct.pack("<II4f", 0, index, 0, 0, 0, 0) for index in range(3))
    material = struct.pack("<4sIIIIII52x", b"MAT ", 0x32, 0, 3, 0, 0, 8) + cels
    (tmp_path / "jkl").mkdir()
    (tmp_path / "mat").mkdir()
    (tmp_path / "mat/00gsmoke.mat").write_bytes(material)
    text = TWO_ROOMS.replace("World templates 3", f"World templates 4\n{PARTEST}")
    (tmp_path / "jkl/rooms.jkl").write_text(text)
    (found,) = clouds(load(str(tmp_path / "jkl/rooms.jkl")))
    assert found.particles.cels == 3


def test_a_count_beyond_the_buffer_is_cut() -> None:
    assert cloud(PARTEST.replace("count=128", "count=300")).particles.spawned == 256
    assert cloud(PARTEST.replace("count=128", "count=-1")).particles.spawned == 0


PAR = """SECTION: HEADER
PAR 1.0
SIZE 0.05
MATERIAL 00ramp1.mat
LIGHTINGMODE 2
SECTION: GEOMETRYDEF
RADIUS 0.1
INSERT OFFSET 0 0 0
VERTICES 3
0: 0 0 0 0
1: 0 0 .1 1
2: 0 .1 0 2
"""


def test_a_cloud_from_a_file_is_the_files() -> None:
    line = f"{PARTEST} particle=ball.par"
    lines = ["World templates 4", line, "== misc/par/ball.par", *PAR.split("\n")]
    with level_with_files(*lines) as level:
        (found,) = clouds(level)
    assert (found.file, found.known, found.material) == ("ball.par", True, "00ramp1.mat")
    made = found.particles
    assert (made.spawned, made.elementsize, made.cels) == (3, pytest.approx(0.05), 5)
    assert made.timer_ms == 200


def test_of_a_file_that_is_not_at_hand_nothing_is_known() -> None:
    found = cloud(f"{PARTEST} particle=ball.par")
    assert (found.file, found.known, found.material) == ("ball.par", False, None)
