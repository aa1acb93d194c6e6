"""Recovery: every fault is told, at its place, and the rest of the file is still read."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.model import Level
from jktools.source import Source
from jktools.syntax.jkl import read
from tests.support.levels import TWO_ROOMS, level_of, two_rooms


def faults(level: Level) -> list[tuple[str, int, str]]:
    """Code, line and the text that each fault points at."""
    return [
        (d.code.id, d.label.span.first.line if d.label.span else 0, d.label.span.text if d.label.span else "")
        for d in level.diagnostics
    ]


def line_of(text: str, record: str) -> int:
    return text.split("\n").index(record) + 1


def test_the_two_rooms_are_read_without_a_fault() -> None:
    level = level_of(TWO_ROOMS)
    assert level.diagnostics == ()
    assert [len(x) for x in (level.vertices, level.surfaces, level.sectors, level.adjoins)] == [12, 12, 2, 2]
    assert level.surfaces[3].vertices.tolist() == [3, 2, 6, 7]
    assert level.surfaces[3].texture_vertices.tolist() == [0, 1, 2, 3]
    assert level.surfaces[3].light.tolist() == [1, 1, 1, 1]
    assert level.sectors[1].positions.max(axis=0).tolist() == [1, 2, 1]
    assert level.things[1].angles.tolist() == [0, 90, 0]
    assert level.cogs[0].values == ("3", "-1", "wind.wav")
    assert level.templates[0].parameters[0] == ("type", "player")
    assert level.document.sectors.sound == ("wind.wav", "wind.wav")
    assert level.header.values["lod_distances"].tolist() == np.float32([0.3, 0.6, 0.9, 1.2]).tolist()


def test_several_broken_records_are_all_told_and_the_rest_is_read() -> None:
    text = two_rooms(
        "World vertices 12", "3: 0 x 0", "7: 0 1", "World adjoins 2", "1: 0x7", "World things 3", "1: ghost"
    )
    level = level_of(text)
    assert faults(level) == [
        ("JK001", line_of(text, "3: 0 x 0"), "x"),
        ("JK001", line_of(text, "7: 0 1"), "7: 0 1"),
        ("JK001", line_of(text, "1: 0x7"), "1: 0x7"),
        ("JK002", line_of(text, "1: ghost"), "1: ghost"),
    ]
    assert [d.message for d in level.diagnostics] == [
        'vertex 3: expected the y, a number, but found "x"',
        "vertex 7: expected the z, a number, but the line ends",
        "adjoin 1: expected the mirror, a whole number, but the line ends",
        "thing 1: expected the name, but the line ends",
    ]
    assert len(level.vertices) == 12
    assert np.isnan(level.vertices[3]).all()
    assert level.vertices[8].tolist() == [1, 2, 0]
    assert level.things[1].dropped == "its line could not be read"


@pytest.mark.parametrize(
    ("fragment", "code", "place"),
    [
        (("World adjoins 2", "0: 0x7 one 1"), "JK002", "one"),
        (("World adjoins 2", "0: 0x7 1.5 1"), "JK002", "1.5"),
        (("World vertices 12", "3: 0 1 0 0.5"), "JK002", "0.5"),
        (("World vertices 12", "3: 0 1 0.5.5"), "JK002", "0.5.5"),
        (("World vertices 12", "3: 0,1,0"), "JK001", "0,1,0"),
        (("World adjoins 2", "0: 0x7,1,,1"), None, ""),
        (("World materials 1", "0: wall.mat"), None, ""),
        (("World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1"), "JK002", None),
        (("World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1 0 5 4,0 7,1 6,2 5,3"), "JK001", None),
        (("World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,x 1 1 1 1"), "JK002", "x"),
        (("World vertices 12", "3: 0 1e39 0"), "JK002", None),
        (("World adjoins 2", "0: 0x7 99999999999 1"), "JK002", None),
        (("Sector 1", "Surfaces 6"), "JK001", "Surfaces 6"),
        (("Sector 1", "- Radius .866025"), "JK001", "Sector 1"),
        (("Sector 1", "Colour 3"), "JK001", "Colour 3"),
    ],
)
def test_what_the_engine_refuses_and_what_it_swallows(
    fragment: tuple[str, ...], code: str | None, place: str | None
) -> None:
    found = faults(level_of(two_rooms(*fragment)))
    if code is None:
        assert found == []
    else:
        assert found[0][0] == code
        assert place is None or found[0][2] == place


def test_the_header_is_read_by_name_and_its_order_is_told() -> None:
    level = level_of(TWO_ROOMS.replace("World Gravity 4", "World Gravity none"))
    assert faults(level)[0][2] == "none"
    swapped = TWO_ROOMS.replace("World Gravity 4\nCeiling Sky Z 15", "Ceiling Sky Z 15\nWorld Gravity 4")
    level = level_of(swapped)
    assert [code for code, *_ in faults(level)] == ["JK002", "JK002", "JK002"]
    assert level.header.values["gravity"].tolist() == [4]


def test_the_engine_reads_the_longest_prefix() -> None:
    level = level_of(two_rooms("World adjoins 2", "0: 0x7 1.5 1", "World vertices 12", "3: 0 1 0.5.5"))
    assert level.adjoins[0].mirror == 1
    assert level.vertices[3].tolist() == [0, 1, 0.5]


def test_a_thing_number_without_colon_is_read_as_a_number_all_the_same() -> None:
    level = level_of(
        two_rooms("World things 3", "- 1: ghost ghost .5 1.5 .5 0 90 0 1", "4; ghost ghost .5 1.5 .5 0 0 0 1")
    )
    assert level.things[1].number == 4
    (told,) = level.diagnostics
    assert told.message == 'thing 1: expected the label, a number and a colon, but found "4;"; the engine reads 4'


def test_hex_fields_are_hex_with_or_without_the_prefix() -> None:
    assert level_of(two_rooms("World adjoins 2", "0: 10 1 1")).adjoins[0].flags == 0x10


def test_a_decimal_is_rounded_once_to_float32() -> None:
    level = level_of(two_rooms("World vertices 12", "3: 1.00000005960464477539062500001 .1 -.5e-3"))
    assert level.vertices[3].tolist() == [
        float(np.nextafter(np.float32(1), np.float32(2))),
        np.float32(0.1),
        np.float32(-0.5e-3),
    ]


def test_a_missing_end_is_told_and_the_next_section_is_read() -> None:
    level = level_of(two_rooms("World templates 3", "- end"))
    assert [code for code, *_ in faults(level)] == ["JK005"]
    assert len(level.things) == 2


def test_a_count_of_two_billion_costs_nothing() -> None:
    level = level_of(two_rooms("World vertices 2000000000"))
    assert [(d.code.id, d.message) for d in level.diagnostics] == [
        ("JK004", "the heading announces 2000000000 vertices, but 12 follow")
    ]


def test_a_file_of_garbage_is_told_once() -> None:
    for data in (b"", b"\0" * 4096, bytes(range(256)) * 64, b"\n" * 1000, b"SECTION:"):
        assert 1 <= len(level_of(data).diagnostics) <= 2


def test_faults_are_bounded() -> None:
    broken = "\n".join(f"{i}: x" for i in range(5000))
    level = level_of(TWO_ROOMS.replace("World vertices 12", f"World vertices 5012\n{broken}"))
    assert len(level.diagnostics) == 1001
    assert level.diagnostics[0].message == "1000 faults are reported, but the file has 4000 more"


def test_what_is_not_told_is_counted_alike_by_both_readers() -> None:
    """The grammar is asked for every record when it is strict: those that are well-formed are no faults."""
    broken = "\n".join(f"{12 + i}: x" for i in range(1007))
    source = Source("x.jkl", TWO_ROOMS.replace("11: 0 2 1\n", f"11: 0 2 1\n{broken}\n").encode())
    counted = [read(source, strict_grammar=strict).diagnostics[0].message for strict in (False, True)]
    assert counted == ["1000 faults are reported, but the file has 8 more"] * 2  # seven, and the number announced


def test_a_continued_line_has_spans_in_both_its_parts() -> None:
    text = TWO_ROOMS.replace("walkplayer none type=player", "walkplayer none \\\n  type=player")
    level = level_of(text)
    assert level.templates[0].parameters[0] == ("type", "player")
    broken = level_of(text.replace("0: 0x7 1 1", "0: 0x7 \\\n  one 1"))
    assert faults(broken)[0][2] == "one"


def test_mysteries_of_the_sith_writes_four_intensities_and_an_arch_field() -> None:
    rooms = two_rooms(
        "World surfaces 12",
        "1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 " + " ".join(map(str, range(16))),
        "World things 3",
        "1: ghost ghost .5 1.5 .5 0 0 0 1 -1 timer=3",
    )
    arch = ["Num ArchObjects 1", "ArchObject 0", "NumMeshes: 1", "Mesh 0", "NumVertices: 1", "0: 1 .5 .5 .5"]
    text = "\n".join([rooms, "Section: ARCHLIGHTING", *arch, "end"])
    level = level_of(text, game="mots")
    assert level.diagnostics == ()
    assert level.surfaces[1].light.tolist() == list(range(16))
    assert level.things[1].parameters == [("timer", "3")]
    assert level.document.arch_lights.light.tolist() == [[1, 0.5, 0.5, 0.5]]


def test_the_lights_of_both_editors() -> None:
    jed = level_of(
        TWO_ROOMS + "Section: Lights\nEditor lights 1\n0: 0 1 2 3 .5 10 2\nend\n".replace(".5 10 2", ".5 10")
    )
    assert jed.diagnostics == ()
    lights = jed.document.lights
    assert (lights.position.tolist(), lights.intensity.tolist(), lights.range.tolist()) == ([[1, 2, 3]], [0.5], [10])
    assert lights.layer.tolist() == [-1]
    sed = level_of(TWO_ROOMS + "Section: Lights\nEditor lights 1\n0: 1f 2 1 2 3 10 .5 1 0 .25\nend\n").document.lights
    assert (sed.flags.tolist(), sed.layer.tolist(), sed.position.tolist()) == ([0x1F], [2], [[1, 2, 3]])
    assert (sed.range.tolist(), sed.intensity.tolist(), sed.color.tolist()) == ([10], [0.5], [[1, 0, 0.25]])


def test_what_only_an_editor_reads_is_told_as_information() -> None:
    level = level_of(TWO_ROOMS + "Section: Lights\nEditor lights 1\n0: 0 1 x 3 .5 10\nend\n")
    assert [(d.code.id, str(d.severity)) for d in level.diagnostics] == [("JK002", "info")]


def test_the_layers_of_sed() -> None:
    layers = ["Section: Layers", "Editor layers 2", "#name secs things", "Ground floor", "3:\t0\t1", "\t1", "1:\t0"]
    level = level_of(TWO_ROOMS + "\n".join([*layers, "Attic", "0:", "1:\t1", "", "#Visibility", "11", "end", ""]))
    assert level.diagnostics == ()
    assert [(x.name, x.sectors, x.things) for x in level.document.layers] == [
        ("Ground floor", (0, 1, 1), (0,)),
        ("Attic", (), (1,)),
    ]


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_a_mangled_level_never_crashes(data: st.DataObject) -> None:
    lines = TWO_ROOMS.split("\n")
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(lines) - 1))
        how = data.draw(st.sampled_from(["drop", "twice", "cut", "put", "swap"]))
        if how == "drop":
            del lines[at]
        elif how == "twice":
            lines.insert(at, lines[at])
        elif how == "cut":
            lines[at] = lines[at][: data.draw(st.integers(0, len(lines[at])))]
        elif how == "put":
            lines[at] += data.draw(st.text(st.characters(max_codepoint=255), max_size=8))
        else:
            other = data.draw(st.integers(0, len(lines) - 1))
            lines[at], lines[other] = lines[other], lines[at]
    level = level_of("\n".join(lines))
    for surface in level.surfaces:
        assert len(surface.vertices) == len(surface.texture_vertices)
    assert len(level.sound_sectors) == len(level.sectors)
