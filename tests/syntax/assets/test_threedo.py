"""The 3DO reader: no line unexplained, bad ones told, grammar and native reader alike."""

from __future__ import annotations

import random

import numpy as np
import pytest

from jktools.source import Source
from jktools.syntax.assets.model import Model
from jktools.syntax.assets.threedo import read_model
from tests.support.assets import BLOCK, corpus_assets
from tests.syntax.test_differential import same

MODELS = list(corpus_assets("3do"))
IDS = [path for path, _ in MODELS]
corpus = pytest.mark.skipif(not MODELS, reason="the corpus of real mods is not at hand")


def model_of(text: str | bytes) -> Model:
    return read_model(Source("test.3do", text.encode("latin-1") if isinstance(text, str) else text))


def told(text: str) -> list[tuple[str, int | None, str]]:
    """Code, line and message of each finding."""
    return [
        (d.code.id, d.label.span.first.line if d.label.span else None, d.message) for d in model_of(text).diagnostics
    ]


def words_of(data: bytes) -> list[list[str]]:
    """The lines of a file as the engine gets them: lower case, comments cut, split at blanks and commas."""
    return [
        line.partition("#")[0].replace(",", " ").split()
        for line in data.decode("latin-1").lower().splitlines()
        if line[:1] not in {"#", ";", ""}
    ]


def lines_of(model: Model) -> list[list[object]]:
    """What the model holds, as the lines that would say it."""
    out: list[list[object]] = [["section:"], ["3do", 2.1], ["section:"], ["materials", len(model.materials)]]
    out += [[i, name.lower()] for i, name in enumerate(model.materials)]
    out += [["section:"], ["radius", model.radius], ["insert", "offset", *model.insert_offset]]
    out.append(["geosets", len(model.geosets)])
    for number, geoset in enumerate(model.geosets):
        out += [["geoset", number], ["meshes", len(geoset.meshes)]]
        for index, mesh in enumerate(geoset.meshes):
            out += [["mesh", index], ["name", mesh.name.lower()], ["radius", mesh.radius]]
            out += [["geometrymode", mesh.geometry_mode], ["lightingmode", mesh.light_mode]]
            out += [["texturemode", mesh.texture_mode], ["vertices", len(mesh.vertices)]]
            out += [[i, *v, mesh.intensity[i]] for i, v in enumerate(mesh.vertices)]
            out.append(["texture", "vertices", len(mesh.texture_vertices)])
            out += [[i, *v] for i, v in enumerate(mesh.texture_vertices)]
            out.append(["vertex", "normals"])
            out += [[i, *v] for i, v in enumerate(mesh.vertex_normals)]
            out.append(["faces", len(mesh.faces)])
            faces = mesh.faces
            for i in range(len(faces)):
                corners = range(faces.corner_start[i], faces.corner_start[i + 1])
                pairs = [n for c in corners for n in (faces.corner_vertex[c], faces.corner_texture_vertex[c])]
                modes = (faces.geometry_mode[i], faces.light_mode[i], faces.texture_mode[i], faces.extra_light[i])
                out.append([i, faces.material[i], ("hex", faces.flags[i]), *modes, len(corners), *pairs])
            out.append(["face", "normals"])
            out += [[i, *v] for i, v in enumerate(faces.normal)]
    nodes = model.nodes
    out += [["section:"], ["hierarchy", "nodes", len(nodes)]]
    for i in range(len(nodes)):
        links = (nodes.mesh[i], nodes.parent[i], nodes.child[i], nodes.sibling[i], nodes.child_count[i])
        place = (*nodes.position[i], *nodes.rotation[i], *nodes.pivot[i])
        out.append([i, ("hex", nodes.flags[i]), ("hex", nodes.type[i]), *links, *place, nodes.names[i].lower()])
    return out


def says(value: object, word: str) -> bool:
    if isinstance(value, str):
        return value == word
    if isinstance(value, tuple):
        return int(word, 16) == value[1]
    return bool(np.float32(word.rstrip(":")) == np.float32(value))  # type: ignore[arg-type]


@corpus
@pytest.mark.parametrize(("path", "data"), MODELS, ids=IDS)
def test_no_line_of_a_real_model_is_unexplained(path: str, data: bytes) -> None:
    model = model_of(data)
    assert model.diagnostics == ()
    written, held = words_of(data), lines_of(model)
    assert len(written) == len(held)
    for words, values in zip(written, held, strict=True):
        wanted = words[:1] if words[0] == "section:" else words
        assert len(wanted) == len(values), (words, values)
        assert all(says(v, w) for v, w in zip(values, wanted, strict=True)), (words, values)


@corpus
@pytest.mark.parametrize(("path", "data"), MODELS, ids=IDS)
def test_grammar_and_native_reader_agree_on_real_models(path: str, data: bytes) -> None:
    if len(data) > 40_000:
        pytest.skip("the grammar alone reads half a megabyte a second")
    check(data)


def check(data: bytes) -> Model:
    source = Source("x.3do", data)
    fast, strict = read_model(source), read_model(source, strict_grammar=True)
    same("document", fast, strict)
    return fast


SCRAPS = [
    "",
    " ",
    "abc",
    "-1",
    "0x10",
    "1.#QNAN",
    "99999999999",
    "1e99",
    ".5",
    "3:",
    "mesh 7",
    "end",
    "#",
    "1,,2",
    "\x01",
]


def mutated(text: str, seed: int) -> str:
    chance = random.Random(seed)
    lines = text.split("\n")
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(lines))
        words = lines[at].split(" ")
        kind = chance.randrange(5)
        if kind == 0:
            del lines[at]
        elif kind == 1:
            lines.insert(at, lines[chance.randrange(len(lines))])
        elif kind == 2:
            words[chance.randrange(len(words))] = chance.choice(SCRAPS)
            lines[at] = " ".join(words)
        elif kind == 3:
            lines[at] = lines[at][: chance.randrange(len(lines[at]) + 1)]
        else:
            lines[at] = lines[at] + " " + chance.choice(SCRAPS)
    return "\n".join(lines)


@pytest.mark.parametrize("block", range(8))
def test_grammar_and_native_reader_agree_on_broken_models(block: int) -> None:
    for seed in range(block * 50, block * 50 + 50):
        check(mutated(BLOCK, seed).encode("latin-1"))


def test_values_of_a_model() -> None:
    model = model_of(BLOCK)
    assert model.diagnostics == ()
    assert not model.rejected
    assert model.materials == ("stone.mat", "glass.mat")
    assert model.radius == 3.5
    assert model.insert_offset.tolist() == [0, 0, np.float32(0.12)]
    floor, arm = model.geosets[0].meshes
    assert (floor.name, floor.geometry_mode, floor.light_mode, floor.texture_mode) == ("floor", 4, 3, 1)
    assert floor.intensity.tolist() == [1, 1, 0.5, 0.5]
    assert floor.texture_vertices[2].tolist() == [64, 64]
    assert floor.faces.corner_vertex.tolist() == [0, 1, 2, 3]
    assert arm.faces.flags.tolist() == [2]
    assert arm.faces.extra_light.tolist() == [0.5]
    assert model.nodes.names == ("floor", "arm")
    assert list(model.nodes.walk()) == [(0, -1), (1, 0)]


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


@pytest.mark.parametrize(
    ("old", "new", "code", "message"),
    [
        ("2: 1 1 0 .5\n", "", "JK032", "the heading announces 4 vertices, but 3 follow"),
        ("RADIUS 3.5\n", "", "JK030", 'expected the line "radius", but found "INSERT OFFSET 0 0 .12"'),
        ("0: -1 -1 0 1", "0: -1 -1 zero 1", "JK030", 'vertex 0: expected the z, a number, but found "zero"'),
        ("0: -1 -1 0 1", "0: -1 -1 0 1 7", "JK031", 'vertex 0 ends before "7", but the line goes on'),
        ("0: -1 -1 0 1", "0: -1 -1 0x1 1", "JK030", 'vertex 0: expected the z, a number, but found "0x1"'),
        ("1, 1 2, 2 3, 3", "1, 1 9, 2 3, 3", "JK033", "face 0 of mesh 0 (floor) names vertex 9, but the last is 3"),
        (
            "1, 1 2, 2 3, 3", "1, 1 2, 4 3, 3",
            "JK033", "face 0 of mesh 0 (floor) names texture vertex 4, but the last is 3",
        ),
        (
            "0: 0 0x0 4", "0: 2 0x0 4",
            "JK033", "face 0 of mesh 0 (floor) has material 2, but the model has the materials 0 to 1",
        ),
        ("2, 2 3, 3", "2, 2 3", "JK032", "face 0 announces 4 vertices, which take 8 numbers, but 7 follow"),
        ("3DO 2.1", "3DO 2.0", "JK036", "the version is 2.0, but only 2.1 is known"),
        ("1: 0x0 0x1 1 0", "1: 0x0 0x1 2 0", "JK033", "node 1 (arm) has mesh 2, but the model has the meshes 0 to 1"),
        (
            "-1 1 -1 1 0 0 0 0 0 0 0 0 0 floor", "-1 1 -1 2 0 0 0 0 0 0 0 0 0 floor",
            "JK037", "node 0 (floor) announces 2 children, but their chain has 1",
        ),
        (
            "-1 1 -1 1 0 0 0 0 0 0 0 0 0 floor", "-1 1 -1 0 0 0 0 0 0 0 0 0 0 floor",
            "JK037", "node 1 (arm) has a mesh, but the tree below node 0 does not reach it",
        ),
        (" arm\n", " arm\nSECTION: MORE\n", "JK035", 'the model ends before "SECTION: MORE", but the file goes on'),
    ],
)  # fmt: skip
def test_what_is_told(old: str, new: str, code: str, message: str) -> None:
    assert BLOCK.count(old) >= 1
    text = new.join(BLOCK.rsplit(old, 1)) if old == " arm\n" else BLOCK.replace(old, new, 1)
    found = told(text)
    assert (code, message) in [(c, m) for c, _, m in found]


def test_a_children_chain_that_comes_back_ends() -> None:
    text = BLOCK.replace("1: 0x0 0x1 1 0 -1 -1 0", "1: 0x0 0x1 1 0 0 1 7")
    assert ("JK037", line_of(text, "1: 0x0 0x1 1 0 0 1 7")) in [(c, line) for c, line, _ in told(text)]


def test_a_broken_mesh_does_not_hide_the_next() -> None:
    model = model_of(BLOCK.replace("FACES 1\n0: 0 0x0", "FACETS 1\n0: 0 0x0"))
    assert [mesh.name for mesh in model.geosets[0].meshes] == ["", "arm"]
    assert len(model.nodes) == 2
    assert [d.code.id for d in model.diagnostics] == ["JK030"]


def test_a_broken_section_does_not_hide_the_next() -> None:
    model = model_of(BLOCK.replace("MATERIALS 2", "MATERIAL 2"))
    assert len(model.geosets[0].meshes) == 2
    assert model.materials == ()


@pytest.mark.parametrize("text", ["", "\n", "hello", "SECTION: HEADER", BLOCK[:300], "\0" * 100, "\xff" * 3000])
def test_no_model_at_all(text: str) -> None:
    model = model_of(text)
    assert model.rejected
    assert len(model.nodes) == 0


def test_a_model_that_is_cut_off_is_told_once() -> None:
    assert told(BLOCK[: BLOCK.index("RADIUS 3.5")]) == [
        ("JK030", None, 'expected the line "radius", but the file ends')
    ]
    assert told("") == [("JK030", None, 'expected the line "section:", but the file ends')]


def test_garbage_is_told_briefly() -> None:
    text = BLOCK.replace("VERTICES 4\n0: -1 -1 0 1", "VERTICES 9000\n" + "0: x\n" * 9000, 1)
    found = told(text)
    assert len(found) == 101
    assert found[0][0] == "JK039"


@pytest.mark.parametrize(
    ("heading", "kind", "line", "most"),
    [
        ("VERTICES 4\n0: -1", "vertices", "0: 0 0 0 0", 0x200),
        ("TEXTURE VERTICES 4", "texture vertices", "0: 0 0", 0x300),
        ("FACES 1", "faces", "0: -1 0 4 3 1 0 1 0 0", 0x200),
    ],
)
def test_meshes_that_are_too_large(heading: str, kind: str, line: str, most: int) -> None:
    start = BLOCK.index(heading)
    words, own = heading.split("\n")[0].rsplit(" ", 1)
    for count in (most, most + 1):
        more = f"{words} {count}\n" + f"{line}\n" * (count - int(own))
        text = BLOCK[:start] + more + BLOCK[start + len(words) + 1 + len(own) + 1 :]
        messages = [m for c, _, m in told(text) if c == "JK816"]
        wanted = f"mesh 0 (floor) has {count} {kind}, but the engine takes {most}"
        assert messages == ([wanted] if count > most else [])


@pytest.mark.parametrize(("corners", "large"), [(24, False), (25, True)])
def test_a_face_with_too_many_corners(corners: int, large: bool) -> None:
    text = BLOCK.replace("0 4 0, 0 1, 1 2, 2 3, 3", f"0 {corners}" + " 0, 0" * corners)
    assert [m for c, _, m in told(text) if c == "JK816"] == (
        ["face 0 of mesh 0 (floor) has 25 vertices, but the engine takes 1 to 24"] if large else []
    )


def test_more_geosets_than_the_engine_has_room_for() -> None:
    start, end = BLOCK.index("GEOSET 0"), BLOCK.index("SECTION: HIERARCHYDEF")
    geoset = BLOCK[start:end]
    for count in (4, 5):
        text = BLOCK[:start].replace("GEOSETS 1", f"GEOSETS {count}") + geoset * count + BLOCK[end:]
        assert [c for c, _, _ in told(text)] == (["JK816"] if count > 4 else [])


def test_lost_geometry_is_told_once() -> None:
    """The nodes name meshes that are there and could not be read: nothing is wrong with the nodes."""
    assert [(code, line) for code, line, _ in told(BLOCK.replace("0 0 .12", "0 0 x", 1))] == [
        ("JK030", line_of(BLOCK, "INSERT OFFSET"))
    ]


def test_a_textured_face_may_name_texture_vertex_0_where_there_is_none() -> None:
    bare = BLOCK.replace("TEXTURE VERTICES 1\n0: 0 0\n", "TEXTURE VERTICES 0\n")
    assert told(bare) == []
    assert [code for code, _, _ in told(bare.replace("0, 0 1, 0 2, 0", "0, 0 1, 0 2, 1"))] == ["JK033"]


def test_a_face_with_a_negative_number_of_corners_has_none() -> None:
    model = model_of(BLOCK.replace("4 3 1 0 4 0, 0", "4 3 1 0 -1 0, 0"))
    faces = model.geosets[0].meshes[0].faces
    assert faces.broken.tolist() == [True]
    assert faces.corner_vertex.tolist() == []
    assert any(d.code.id == "JK032" for d in model.diagnostics)
