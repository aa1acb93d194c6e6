"""Damaged files: one clear error or numbers in bounds, never a crash, and never more memory than the file explains."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import pytest

from jktools._native_file import level_fault, level_parts  # noqa: TID251 (the native check is held against another)
from jktools.cli import main
from jktools.compiler import CompiledFileError, CompiledLevel, CompileSettings, compile_level
from jktools.compiler import level_generated as fb
from jktools.compiler.checksum import seal
from jktools.compiler.packing import Stored
from jktools.compiler.section import NO_SECTION, Section, layouts
from jktools.compiler.slots import wanted
from tests.support.levels import ROOT, TWO_ROOMS, level_of, two_rooms
from tests.support.range_check import first_fault, text_fault

PLAIN = compile_level(level_of(TWO_ROOMS), CompileSettings(plain=True))
"""With texts as they are, each with a zero byte behind it."""
FILES = {
    "balanced": compile_level(level_of(TWO_ROOMS)),
    "fast": compile_level(level_of(TWO_ROOMS), CompileSettings(accuracy="fast", cut_anyway=True)),
    "coded": compile_level(
        level_of(
            two_rooms(
                "World sounds 60",
                *(f"squeak_{i:02}.wav" for i in range(60)),
                "World templates 9",
                "guard walkplayer health=60",
                "captain guard light=.5",
                "box crate size=.2",
            )
        )
    ),
    "1.2": (ROOT / "tests/data/two_rooms_1_2.jklb").read_bytes(),
    "1.1": (ROOT / "tests/data/two_rooms_1_1.jklb").read_bytes(),
}
MOST_ROWS = 1 << 16


def read_all(level: CompiledLevel) -> None:
    """Ask for everything that a file tells."""
    for section in level.sections.values():
        for name, values in section.columns.items():
            assert len(values) <= MOST_ROWS, name
            assert values.nbytes >= 0
    told = (level.counts, level.passes, level.omissions, level.world, level.settings, level.inputs, level.only)
    assert told
    assert len(level.strings) <= len(level.data)
    assert level.visible_sectors is None or level.visible_sectors.ndim == 2
    geometry = level.geometry
    assert (geometry.vertices[geometry.corner_vertex]).shape == (len(geometry.corner_vertex), 3)
    assert (geometry.surface_corner_start[1:] <= len(geometry.corner_vertex)).all()


def stored(data: bytes) -> Iterator[tuple[str, Mapping[str, Stored]]]:
    """The columns of a file that only the verifier has seen."""
    parts, steps = level_parts(np.frombuffer(data, np.uint8), wanted())
    parts = parts.reshape(len(steps), -1)
    minor = fb.Level.GetRootAs(data).FormatMinor()  # type: ignore[no-untyped-call]
    for name, layout in layouts(minor).items():
        if parts[layout.rows.start, 0] != NO_SECTION:
            yield name, Section(memoryview(data), (parts, steps), layout).stored


def by_numpy(data: bytes) -> str | None:
    """The fault that the check in numpy finds in the sections and strings."""
    sections = dict(stored(data))
    root = fb.Level.GetRootAs(data)  # type: ignore[no-untyped-call]
    texts, strings = sections.pop("strings"), root.StringsLength()
    missing = next((name for name in ("resources", "geometry") if name not in sections), None)
    if missing:
        return f"has no {missing}"
    if root.FormatMinor() >= 2:
        fault = text_fault(texts, len(data))
        if fault:
            return fault
        strings = len(texts["text_start"]) - 1
    return first_fault(sections, strings, len(data))


@pytest.mark.parametrize(
    ("file", "change", "step"),
    [("balanced", 0xFF, 1), ("fast", 0x80, 3), ("coded", 0x80, 2), ("1.2", 0x40, 3), ("1.1", 0x01, 3)],
)
def test_every_byte_flipped(file: str, change: int, step: int) -> None:
    data, refused = FILES[file], 0
    for at in range(0, len(data), step):
        flipped = bytearray(data)
        flipped[at] ^= change
        try:
            read_all(CompiledLevel(bytes(flipped), "x.jklb"))
        except CompiledFileError as error:
            refused += 1
            assert str(error).startswith("cannot read x.jklb: ")
            assert "\n" not in str(error)
    assert refused > len(data) / step / 20


@pytest.mark.parametrize("file", FILES)
def test_the_native_check_and_the_one_in_numpy_agree(file: str) -> None:
    data, seen = FILES[file], set()
    for at in range(len(data)):
        flipped = bytearray(data)
        flipped[at] ^= 0x55
        changed = bytes(flipped)
        native = level_fault(np.frombuffer(changed, np.uint8))
        if native and not native.startswith("the file is damaged"):
            continue  # the verifier's, or another version
        inside = native.removeprefix("the file is damaged; build it again (")[:-1]
        if inside.startswith(("visibility.row", "omission.")):
            continue  # what numpy looks at when it is asked for
        assert (inside or None) == by_numpy(changed), at
        seen.add(inside.partition(" ")[0])
    assert len(seen) > 10
    assert {"level.text", "level.symbols", "templates.base"} <= seen or file != "coded"


@pytest.mark.parametrize("file", FILES)
def test_cut_off_at_every_length(file: str) -> None:
    data = FILES[file]
    refusal = r"^cannot read x\.jklb: (not a compiled level|the file is cut off)"
    used = len(data)
    while used > len(data) - 8 and data[used - 1] == 0:  # what fills the file up to a multiple of 8
        used -= 1
    for size in range(used):
        with pytest.raises(CompiledFileError, match=refusal):
            CompiledLevel(data[:size], "x.jklb")
    for size in range(used, len(data)):
        with pytest.raises(CompiledFileError, match=r"cut off|the checksum does not match"):
            CompiledLevel(data[:size], "x.jklb", verify=True)


def test_garbage() -> None:
    random = np.random.default_rng(3)
    for size in (0, 7, 8, 64, 1000, 100_000):
        for _ in range(20):
            noise = random.bytes(size)
            for data in (noise, noise[:4] + b"JKLB" + noise[8:], b"\x10\0\0\0JKLB" + noise):
                with pytest.raises(CompiledFileError, match=r"not a compiled level|cut off|damaged|format version"):
                    CompiledLevel(data, "x.jklb")


def test_a_buffer_at_an_odd_place_is_copied() -> None:
    whole = memoryview(b"x" + FILES["balanced"])
    level = CompiledLevel(whole[1:])
    assert level.vertices.tolist() == CompiledLevel(FILES["balanced"]).vertices.tolist()


def test_a_column_cannot_claim_more_rows_than_the_file_has_bytes() -> None:
    data = bytearray(FILES["balanced"])
    packed = next(
        table
        for section in (fb.Level.GetRootAs(data).Geometry(),)  # type: ignore[no-untyped-call]
        for name in ("SurfaceGeometryMode", "SurfaceLightMode", "SurfaceTextureMode")
        if (table := getattr(section, f"{name}Packed")()) is not None and table.Count()
    )
    place = packed._tab.Offset(24) + packed._tab.Pos
    assert int.from_bytes(data[place : place + 4], "little") == packed.Count() == 12
    data[place : place + 4] = (0xFFFFFFFF).to_bytes(4, "little")
    with pytest.raises(CompiledFileError, match="claims 4294967295 rows, more than the file has bytes"):
        CompiledLevel(bytes(data))


def test_a_newer_minor_version_that_cannot_be_read_says_so() -> None:
    data = bytearray(PLAIN)
    table = fb.Level.GetRootAs(data)._tab  # type: ignore[no-untyped-call]
    minor = table.Offset(6) + table.Pos
    data[minor] = 9
    assert CompiledLevel(bytes(data)).format == "1.9"
    data[data.index(b"wind.wav\0") + 8] = 1
    with pytest.raises(
        CompiledFileError, match=r"of format 1\.9, and this jktools reads up to 1\.3 of it; use a newer"
    ):
        CompiledLevel(bytes(data))


def test_the_command_line_refuses_a_damaged_file(
    tmp_path_factory: pytest.TempPathFactory, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path_factory.mktemp("damage") / "x.jklb"
    data = bytearray(PLAIN)
    data[data.index(b"wind.wav\0") + 8] = 1
    file.write_bytes(seal(data))
    for words in (["inspect", str(file)], ["inspect", str(file), "--verify"], ["diff", str(file), str(file)]):
        assert main(words) == 2
        shown = capsys.readouterr()
        assert shown.out == ""
        assert shown.err.count("\n") == 1
        assert "level.text should have a zero byte behind each string, but has not" in shown.err
