from __future__ import annotations

import hashlib
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.compiler import CompiledFileError, CompiledLevel, CompileError, compile_level, open_compiled
from jktools.compiler.columns import SECTIONS, STRINGS
from jktools.compiler.verification import first_difference
from jktools.facts import LevelFacts
from jktools.model import Level
from tests.support.levels import ROOT, TWO_ROOMS, level_of, two_rooms

COMPILED = compile_level(level_of(TWO_ROOMS))


def test_what_was_written_is_read_back() -> None:
    level, compiled = level_of(TWO_ROOMS), CompiledLevel(COMPILED)
    assert np.array_equal(compiled.vertices, level.vertices)
    assert np.array_equal(compiled.surface_normal, level.document.normals.direction)
    assert compiled.surface_sector.tolist() == [0] * 6 + [1] * 6
    assert compiled.adjoin_surface.tolist() == [3, 8]
    assert compiled.corner_vertex[12:16].tolist() == level.surfaces[3].vertices.tolist()
    assert compiled.things is not None
    assert compiled.things.position.tolist() == level.document.things.position.tolist()
    assert [compiled.strings[i] for i in compiled.things.template] == ["walkplayer", "ghost"]
    assert compiled.templates is not None
    start = compiled.templates.value_start
    keys = [compiled.strings[i] for i in compiled.templates.value_key[start[0] : start[1]]]
    assert keys == ["type", "move", "size", "movesize", "physflags"]
    assert compiled.cogs is not None
    assert [compiled.strings[i] for i in compiled.cogs.value] == ["3", "-1", "wind.wav"]
    assert compiled.inputs == [("test.jkl", hashlib.sha256(TWO_ROOMS.encode()).hexdigest())]
    assert compiled.settings == {"game": "jk", "engine": "research", "accuracy": "balanced"}


def test_arrays_are_read_only_views_of_the_file_on_eight_bytes(tmp_path: Path) -> None:
    path = tmp_path / "rooms.jklb"
    path.write_bytes(COMPILED)
    compiled = open_compiled(path, verify=True)
    whole = np.frombuffer(compiled.data, np.uint8)
    for section in compiled.sections.values():
        for name, stored in section.stored.items():
            assert not getattr(section, name).flags.writeable, name
            for values in stored.vectors:
                assert not values.flags.writeable, name
                assert np.shares_memory(values, whole), name
                assert values.__array_interface__["data"][0] % 8 == 0, name
    for name in ("vertices", "texture_vertices", "surface_normal"):
        assert np.shares_memory(getattr(compiled, name), whole), name


@pytest.mark.parametrize("accuracy", ["balanced", "fast"])
def test_the_same_input_gives_the_same_bytes_whatever_the_hash_seed(accuracy: str, level_file: Path) -> None:
    code = "import sys, jktools; sys.stdout.buffer.write(jktools.build(jktools.load(sys.argv[1]), sys.argv[2]))"
    seen = {
        subprocess.run(
            [sys.executable, "-c", code, str(level_file), accuracy], capture_output=True, check=True,
            env={"PYTHONHASHSEED": seed, "PATH": "", "JKTOOLS_CACHE": ""},
        ).stdout
        for seed in ("1", "2")
    }  # fmt: skip
    assert len(seen) == 1
    assert len(seen.pop()) > 1000


def test_what_the_engine_drops_is_left_out_and_sources_count_the_file() -> None:
    text = two_rooms("World things 3", "1: ghost ghost .5 1.5 .5 0 0 0 7", "2: crate crate .5 1.5 .5 0 0 0 1")
    things = CompiledLevel(compile_level(level_of(text))).things
    assert things is not None
    assert things.source.tolist() == [0, 2]


def test_a_section_that_nothing_needs_is_absent_and_says_why() -> None:
    compiled = CompiledLevel(compile_level(level_of(two_rooms("World cogs 0", "- 0: door.cog 3 -1 wind.wav"))))
    assert compiled.cogs is None
    assert compiled.passes["cogs"] == {"ran": False, "failed": False, "note": "no COG is placed"}


@pytest.mark.parametrize(
    ("fragment", "message"),
    [
        (("World vertices 12", "3: x"), r"line \d+ \[JK001\] vertex 3: expected the x"),
        (("World surfaces 12", "1: 0 0 0 4 3 1 -1 0 3 4,0 5,1 99,2 1 1 1"), "corner_vertex 6 is 99, but there are 12"),
        (("World adjoins 2", "0: 0x7 5 1"), "geometry.adjoin_mirror 0 is 5, but there are 2 adjoin_flags"),
        (("Sector 1", "Surfaces 6 7"), "claims 7 surfaces from 6, but there are 12"),
        (("World surfaces 12", "1: 4 0 0 4 3 1 -1 0 3 4,0 5,1 6,2 1 1 1"), "surface_material 1 is 4, but there are 1"),
    ],
)  # fmt: skip
def test_a_level_that_the_engine_would_refuse_is_not_compiled(fragment: tuple[str, ...], message: str) -> None:
    with pytest.raises(CompileError, match=message):
        compile_level(level_of(two_rooms(*fragment)))


def test_static_jkl_is_no_level() -> None:
    with pytest.raises(CompileError, match="it has no GEORESOURCE"):
        compile_level(level_of("Section: MODELS\nWorld models 0\nend\n", "static.jkl"))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "not a compiled level"),
        (b"GOB " * 4, "not a compiled level"),
        (COMPILED[: len(COMPILED) // 2], "cut off or damaged"),
        (COMPILED[:8], "cut off or damaged"),
    ],
)
def test_a_damaged_file_is_one_clear_sentence(data: bytes, message: str) -> None:
    with pytest.raises(CompiledFileError, match=message):
        CompiledLevel(data, "x.jklb")


def test_a_newer_major_version_is_refused() -> None:
    newer = bytearray(COMPILED)
    at = CompiledLevel(COMPILED)._root._tab
    newer[at.Offset(4) + at.Pos] = 2
    with pytest.raises(CompiledFileError, match=r"format version 2\.3, but this jktools reads 1\.x"):
        CompiledLevel(bytes(newer))


def test_every_flipped_byte_is_found_by_the_checksum() -> None:
    for at in range(0, len(COMPILED), 7):
        flipped = bytearray(COMPILED)
        flipped[at] ^= 0x40
        with pytest.raises(CompiledFileError):
            CompiledLevel(bytes(flipped), verify=True)


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_a_flipped_byte_is_refused_or_stays_in_bounds(data: st.DataObject) -> None:
    flipped = bytearray(COMPILED)
    for _ in range(data.draw(st.integers(1, 4))):
        flipped[data.draw(st.integers(8, len(flipped) - 1))] = data.draw(st.integers(0, 255))
    try:
        level = CompiledLevel(bytes(flipped))
    except CompiledFileError:
        return
    geometry = level.geometry
    assert not len(geometry.corner_vertex) or 0 <= geometry.corner_vertex.min() <= geometry.corner_vertex.max()
    assert not len(geometry.corner_vertex) or geometry.corner_vertex.max() < len(geometry.vertices)
    assert (geometry.sector_first_surface + geometry.sector_surface_count <= len(geometry.surface_flags)).all()


def test_columns_and_schema_say_the_same() -> None:
    schema = (ROOT / "grammars/level.fbs").read_text()
    types = {"float": "f4", "int": "i4", "uint": "u4", "double": "f8", "ubyte": "u1"}
    for section, columns in SECTIONS.items():
        table = "".join(part.capitalize() for part in section.split("_"))
        body = re.search(rf"^table {table} {{(.*?)^}}", schema, re.MULTILINE | re.DOTALL)
        assert body
        fields = re.findall(r"^  (\w+): \[(\w+)\](?: \(([^)]*)\))?;", body[1], re.MULTILINE)
        assert [name for name, *_ in fields] == list(columns)
        for name, kind, attributes in fields:
            column = columns[name]
            target = re.search(r'index_of: "([\w.]+)"', attributes)
            assert types[kind] == column.type, name
            assert (target[1] if target else None) == column.index_of, name
            assert ("or_none" in attributes) == column.or_none, name
    assert STRINGS == "strings"


def test_visible_sectors_are_read_back() -> None:
    compiled = CompiledLevel(COMPILED)
    assert compiled.visible_sectors is not None
    assert compiled.visible_sectors.tolist() == LevelFacts(level_of(TWO_ROOMS)).visibility.matrix.tolist()
    assert compiled.visible_sectors.all()
    assert compiled.visibility is not None
    assert compiled.visibility.row.tolist() == [3, 3], "a byte a sector, a bit for each of the two rooms"


def test_a_damaged_row_of_visible_sectors_is_refused() -> None:
    compiled = CompiledLevel(COMPILED)
    assert compiled.visibility is not None
    row = compiled.visibility.row
    data = bytearray(COMPILED)
    data[row.__array_interface__["data"][0] - np.frombuffer(COMPILED, np.uint8).__array_interface__["data"][0]] = 0
    with pytest.raises(CompiledFileError, match="the file is damaged; build it again"):
        _ = CompiledLevel(bytes(data)).visible_sectors


def test_a_file_of_format_1_0_is_read() -> None:
    """Written by the code of format 1.0 from tests/data/two_rooms.jkl."""
    old = CompiledLevel((ROOT / "tests/data/two_rooms_1_0.jklb").read_bytes(), verify=True)
    assert old.format == "1.0"
    assert old.templates is not None
    assert [old.strings[i] for i in old.templates.name] == ["walkplayer", "ghost", "crate"]
    assert not hasattr(old.templates, "value_key")
    assert old.omissions == []


def test_a_file_of_format_1_1_is_read() -> None:
    """Written by commit 8462e37, the last of format 1.1, from tests/data/two_rooms.jkl; it says what today's says."""
    old = CompiledLevel((ROOT / "tests/data/two_rooms_1_1.jklb").read_bytes(), verify=True)
    new = CompiledLevel(COMPILED)
    assert old.format == "1.1"
    assert set(old.sections) == set(new.sections) - {"models", "files"}, "sections of 1.2"
    for section, columns in SECTIONS.items():
        texts = [name for name, column in columns.items() if column.index_of == STRINGS]
        for name in (name for name, column in columns.items() if column.since < 2 and section in old.sections):
            if name.startswith("parameter_") and section == "templates":
                continue
            ours, theirs = (getattr(level.sections[section], name) for level in (new, old))
            assert ours.dtype == theirs.dtype, name
            if name in texts:
                told = [
                    [None if i < 0 else level.strings[i] for i in each] for level, each in ((new, ours), (old, theirs))
                ]
                assert told[0] == told[1], name
            else:
                assert ours.tobytes() == theirs.tobytes(), name
    assert old.templates is not None
    assert [old.strings[i] for i in old.templates.parameter_value[:4]] == ["player", "physics", ".065", "0x4a4f"]
    assert not hasattr(old.templates, "value_list")


def test_a_file_of_format_1_2_is_read() -> None:
    """Written by commit 4616d79, the last of format 1.2, from tests/data/two_rooms.jkl; it says what today's says."""
    old = CompiledLevel((ROOT / "tests/data/two_rooms_1_2.jklb").read_bytes(), verify=True)
    new = CompiledLevel(COMPILED)
    assert old.format == "1.2"
    assert first_difference(old, new) is None
    assert old.templates is not None
    assert new.templates is not None
    assert not hasattr(old.templates, "own_key")
    for name in ("value_start", "value_source", "number_start", "number"):
        assert getattr(old.templates, name).tolist() == getattr(new.templates, name).tolist(), name
    for name in ("value_key", "value_text"):
        told = [[None if i < 0 else level.strings[i] for i in getattr(level.templates, name)] for level in (old, new)]
        assert told[0] == told[1], name


def test_parameters_that_a_value_tells_are_not_repeated() -> None:
    text = two_rooms("World templates 4", "door none type=cog size=.5 size=.7 colour=red move=path surfdrag=3")
    compiled = CompiledLevel(compile_level(level_of(text)))
    templates = compiled.templates
    assert templates is not None
    at = [compiled.strings[i] for i in templates.name].index("door")
    rows = slice(templates.unused_start[at], templates.unused_start[at + 1])
    unused = [
        (compiled.strings[k], compiled.strings[v])
        for k, v in zip(templates.unused_key[rows], templates.unused_value[rows], strict=True)
    ]
    assert unused == [("size", ".5"), ("colour", "red"), ("surfdrag", "3")]


def test_a_column_of_nothing_is_read_before_the_one_that_counts_it() -> None:
    """`surface_material` stands before `surface_flags` in the file."""
    level = level_of(TWO_ROOMS)
    surfaces = level.document.surfaces
    bare = replace(level.document, surfaces=replace(surfaces, material=np.full_like(surfaces.material, -1)))
    compiled = CompiledLevel(compile_level(Level(bare)))
    assert not compiled.geometry.stored["surface_material"].in_file
    assert compiled.surface_material.tolist() == [-1] * 12
