"""The sample program against Python: both answer from one compiled file, and every answer is equal, ties included."""

from __future__ import annotations

import os
import platform
import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from benchmarks.runtime_disagreement import QUESTIONS, asked_of
from benchmarks.runtime_queries import ask, differing
from jktools.compiler import CompiledLevel, CompileSettings, Ledge, ThingFace, compile_level
from jktools.facts.ledges import Kind
from jktools.model import Level
from jktools.session import load
from tests.facts.test_ledges_on_things import FRAMES, with_box
from tests.runtime.compiler import FLATBUFFERS, built, compiler
from tests.support.halls import crooked_halls, crossroads, halls
from tests.support.levels import ROOT, TWO_ROOMS, corpus_files, level_of, two_rooms

SMITHDEV = (ROOT / "fixtures/smithdev/level/jkl/smithdev.jkl").read_bytes()
CORPUS_LEVELS = ("masspack.gob!jkl/lagoon.jkl", "namekwaters.jkl", "treeofmight2.jkl")


def fixtures() -> Iterator[tuple[str, Level]]:
    yield "two rooms", level_of(TWO_ROOMS)
    yield "a vertex beyond float32", level_of(two_rooms("World vertices 12", "11: 1e39 2 1"))
    yield "water", level_of(two_rooms("Sector 1", "FLAGS 0x2"))
    yield "halls", halls()
    for seed in range(3):
        yield f"crooked halls {seed}", crooked_halls(seed)


def compiled_at(folder: Path, level: Level, accuracy: str = "balanced") -> tuple[Path, CompiledLevel]:
    path = folder / "level.jklb"
    path.write_bytes(compile_level(level, CompileSettings(accuracy=accuracy)))  # type: ignore[arg-type]
    return path, CompiledLevel(path.read_bytes())


def assert_equal(program: Path, path: Path, compiled: CompiledLevel, level: Level, count: int) -> None:
    rng = np.random.default_rng(11)
    for question in QUESTIONS:
        for asked in asked_of(question, level, compiled, count, rng, 1):
            found, _ = ask(program, path, asked.queries)
            wrong = differing(asked.answers, found)
            assert not len(wrong), (question, asked.queries[wrong[0]], asked.answers[wrong[0]], found[wrong[0]])


@pytest.mark.parametrize(("name", "level"), list(fixtures()), ids=lambda x: x if isinstance(x, str) else "")
@pytest.mark.parametrize("accuracy", ["balanced", "fast"])
def test_every_answer_is_equal(name: str, level: Level, accuracy: str, jklb_query: Path, tmp_path: Path) -> None:
    assert name
    assert_equal(jklb_query, *compiled_at(tmp_path, level, accuracy), level, 3000)


def test_every_answer_is_equal_on_the_test_level_of_the_document(jklb_query: Path, tmp_path: Path) -> None:
    level = level_of(SMITHDEV)
    assert_equal(jklb_query, *compiled_at(tmp_path, level), level, 6000)


@pytest.mark.parametrize("name", CORPUS_LEVELS)
def test_every_answer_is_equal_on_real_levels(name: str, corpus: Path, jklb_query: Path, tmp_path: Path) -> None:
    level = level_of(dict(corpus_files())[name])
    assert_equal(jklb_query, *compiled_at(tmp_path, level), level, 6000)


def answers(program: Path, path: Path, lines: list[str]) -> list[str]:
    done = subprocess.run([program, path, "-"], input="\n".join(lines), capture_output=True, text=True, check=False)
    return done.stdout.split("\n")[:-1]


def told(compiled: CompiledLevel, body: int, surface: int, corner: int, place: float | None = None) -> str:
    """A ledge as jklb_query tells it."""
    return texts(compiled.ledges_at(body, surface, corner, place))


def texts(ledges: list[Ledge]) -> str:
    texts = []
    for each in ledges:
        text = f"{each.start:.9g} to {each.end:.9g} {Kind(each.kind).name.lower()}"
        text += f", surface {each.below}" if each.below >= 0 else ""
        text += f", face {each.onto_face} of thing {each.onto}" if each.onto >= 0 else ""
        text += f", {each.drop_start:.9g} to {each.drop_end:.9g} JKU down" if each.drop_start == each.drop_start else ""
        texts.append(text)
    return "; ".join(texts) or "level"


def assert_ledges_are_equal(program: Path, path: Path, compiled: CompiledLevel, body: int = 0) -> None:
    """Every edge of every floor, whole and at places, gives what Python gives; rows of surfaces are each found once."""
    assert compiled.ledges is not None
    whole = answers(program, path, [f"ledges {body} {s} 0" for s in range(len(compiled.surface_flags))])
    floors = {s for s, text in enumerate(whole) if text != f"refused: surface {s} is no floor"}
    assert set(compiled.ledges.surface.tolist()) - {-1} <= floors
    corners = np.diff(compiled.geometry.surface_corner_start.astype(int))
    edges = [(body, s, c) for s in sorted(floors) for c in range(corners[s])]
    found = answers(program, path, [f"ledges {b} {s} {c}" for b, s, c in edges])
    assert found == [told(compiled, *edge) for edge in edges]
    first, end = compiled.ledges.body_ledge_start[body : body + 2].tolist()
    listed = sum(0 if text == "level" else text.count(";") + 1 for text in found)
    assert listed == (compiled.ledges.surface[first:end] >= 0).sum() > 20
    places = [0, 0.25, 0.5, 1]
    found = answers(program, path, [f"ledges {b} {s} {c} {t}" for b, s, c in edges for t in places])
    assert found == [told(compiled, *edge, t) for edge in edges for t in places]


def test_ledges_and_basins_are_those_of_the_file(jklb_query: Path, tmp_path: Path) -> None:
    path, compiled = compiled_at(tmp_path, halls())
    assert_ledges_are_equal(jklb_query, path, compiled)
    (basin,) = compiled.basins_of(0)
    assert answers(jklb_query, path, ["basins 0"]) == [
        f"{len(basin.surfaces)} floors from surface {basin.surfaces[0]}, {basin.shallowest:.9g} to {basin.deepest:.9g} "
        f"JKU deep, entered 0x{basin.entered:x}, left 0x{basin.left:x}"
    ]


def test_ledges_of_a_real_level_that_lead_onto_things(corpus: Path, jklb_query: Path, tmp_path: Path) -> None:
    path, compiled = compiled_at(tmp_path, load(str(corpus / "gob/masspack.gob!jkl/lagoon.jkl")))
    assert_ledges_are_equal(jklb_query, path, compiled)
    assert answers(jklb_query, path, ["ledges 0 346 4 .7772"]) == [
        "0.777153552 to 0.777292371 wall, face 2 of thing 74"
    ]


def left(compiled: CompiledLevel, floor: int | ThingFace, origin: list[float], target: list[float]) -> str:
    """What jklb_query tells of a way."""
    leave = compiled.leave(0, floor, origin, target)
    if leave.corner < 0:
        return "stays" if leave.kind == Kind.LEVEL else "unknown"
    text = f"leaves by corner {leave.corner} at {leave.place:.9g}, {leave.along:.9g} along the way: "
    text += Kind(leave.kind).name.lower()
    text += f", surface {leave.ledge.below}" if leave.ledge.below >= 0 else ""
    text += f", face {leave.ledge.onto_face} of thing {leave.ledge.onto}" if leave.ledge.onto >= 0 else ""
    text += f", {leave.drop:.9g} JKU down" if leave.drop == leave.drop else ""
    return text + (", detaches" if leave.detaches else "")


def test_ways_over_things_are_those_of_python(jklb_query: Path, tmp_path: Path) -> None:
    """Over the top of a box, its placed pose and frame 1, from places on a grid to others, its corners among them."""
    frames = FRAMES.format(a=-0.2, b=-0.35).replace("1.4", "1.5")
    with with_box(".5 1.5 -.2 0 0 0", more=frames) as level:
        path, compiled = compiled_at(tmp_path, level)
    rng = np.random.default_rng(8)
    lines, wanted = [], []
    for frame, top in ((-1, -0.075), (1, -0.225)):
        ring = [[x, y, top] for x, y in ((0.125, 1.125), (0.875, 1.125), (0.875, 1.875), (0.125, 1.875))]
        for origin, target in (rng.integers([0, 8, 0], [9, 17, 1], (150, 2, 3)) / 8).tolist():
            words = [f"{x:.17g}" for point in (origin, target, *ring) for x in point]
            lines.append(f"leave-thing 0 2 {'placed' if frame < 0 else frame} 0 " + " ".join(words))
            wanted.append(left(compiled, ThingFace(2, frame, 0, ring), origin, target))
    assert answers(jklb_query, path, lines) == wanted
    said = {re.sub(r"[\d.]+", "0", text) for text in wanted}
    assert said == {
        "stays",
        "unknown",
        "leaves by corner 0 at 0, 0 along the way: fall, surface 0, 0 JKU down, detaches",
    }
    edges = [(frame, corner) for frame in (-1, 1) for corner in range(4)]
    asked = [f"ledges-of-thing 0 2 {'placed' if frame < 0 else frame} 0 {corner}" for frame, corner in edges]
    found = answers(jklb_query, path, asked)
    assert found == [texts(compiled.ledges_of_thing(0, 2, frame, 0, corner)) for frame, corner in edges]
    assert answers(jklb_query, path, [f"{line} .5" for line in asked]) == found
    assert answers(jklb_query, path, ["ledges-of-thing 0 2 placed 1 0"]) == ["level"]
    assert answers(jklb_query, path, ["ledges-of-thing 0 2 0 0 0", "leave-thing 0 1 placed 0" + " 0" * 15]) == [
        "refused: no edge of thing 2 is listed at frame 0", "refused: no edge of thing 1 is listed at frame placed"
    ]  # fmt: skip


def test_a_way_from_a_thing_to_a_floor_at_its_height(jklb_query: Path, tmp_path: Path) -> None:
    with with_box(".5 1.4 -.5 0 0 0", (0.4, 0.4, 0.5)) as level:
        path, _ = compiled_at(tmp_path, level)
    ways = "0 2 placed 0 .5 1.4 .12 {} .12 .1 1 0 .9 1 0 .9 1.8 0 .1 1.8 0"
    asked = ["leave-thing " + ways.format(target) for target in (".5 .6", ".5 2.2")]
    back, on = answers(jklb_query, path, asked)
    assert back == "leaves by corner 0 at 0.5, 0.5 along the way: level"
    assert re.fullmatch(
        r"leaves by corner 2 at 0\.5, 0\.5 along the way: fall, surface 6, 0\.6\d* JKU down, detaches", on
    )


def test_what_is_no_edge_of_a_floor_is_not_said_to_be_level(jklb_query: Path, tmp_path: Path) -> None:
    path, compiled = compiled_at(tmp_path, halls())
    count = len(compiled.surface_flags)
    floor = int(np.flatnonzero(compiled.surface_flags & 1)[0])
    wall = int(np.flatnonzero((compiled.surface_flags & 1 == 0) & (compiled.geometry.surface_adjoin < 0))[0])
    corners = int(np.diff(compiled.geometry.surface_corner_start.astype(int))[floor])
    assert answers(
        jklb_query, path,
        [
            f"ledges 0 {count} 0", "ledges 0 -1 0", f"ledges 0 {wall} 0", f"ledges 0 {floor} {corners}",
            f"ledges 0 {floor} 0 x", f"ledges 0 {floor} 0 7", f"ledges 0 {floor} 0 nan", "basins 1",
        ],
    ) == [
        f"refused: surface {count} does not exist: there are {count}",
        f"refused: surface -1 does not exist: there are {count}",
        f"refused: surface {wall} is no floor", f"refused: corner {corners} does not exist: there are {corners}",
        "refused: 'x' is no number", "refused: 7 is no place on an edge: they go from 0 to 1",
        "refused: nan is no place on an edge: they go from 0 to 1",
        "refused: body 1 does not exist: there are 1",
    ]  # fmt: skip


def test_the_two_rooms_by_hand(jklb_query: Path, tmp_path: Path) -> None:
    """Two unit cubes, 0 and 1, one behind the other along y, with an adjoin between; floors are surfaces 0 and 6."""
    path, _ = compiled_at(tmp_path, level_of(TWO_ROOMS))
    assert answers(
        jklb_query, path,
        [
            "sight .5 .5 .5 0 .5 1.5 .5", "sight .5 .5 .5 ? .5 .5 -1", "sight .5 .5 .5 0 .5 .5 0",
            "drop .5 .5 .5 0", "drop .5 .5 .5 0 .25", "locate .5 1 .5", "locate 9 9 9", "visible 0 1",
            "locate 0x1p-1 .5 .5",
        ],
    ) == [
        "visible through 2 sectors", "blocked by surface 0 after 1 sector", "visible through 1 sector",
        "floor surface 0 in sector 0, 0.5 JKU down", "far in sector 0, 0.25 JKU down",
        "sector 0, inside 0, on the boundary of 2", "in no sector", "may be visible",
        "sector 0, inside 1, on the boundary of 0",
    ]  # fmt: skip


@pytest.mark.parametrize(("first", "second"), [(True, True), (True, False), (False, True), (False, False)])
def test_a_way_that_parts_at_an_edge(first: bool, second: bool, jklb_query: Path, tmp_path: Path) -> None:
    """One way that sees is enough; where none does, the first that is blocked tells."""
    level = crossroads(first, second)
    path, compiled = compiled_at(tmp_path, level)
    (found,) = answers(jklb_query, path, ["sight 1 1 1 0 3 3 1"])
    if first or second:
        assert found == "visible through 3 sectors"
    else:
        walls = [i for i, s in enumerate(level.surfaces) if s.adjoin and s.adjoin.sector == level.sectors[3]]
        assert found == f"blocked by surface {max(walls)} after 2 sectors", (
            "by room 2: its window comes first in room 0"
        )
    assert_equal(jklb_query, path, compiled, level, 1200)


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (["sight", "1"], "sight takes 7 words, not 1"),
        (["drop", "1", "2", "3"], "drop takes 4 or more words, not 3"),
        (["ask", "1"], "no question 'ask'; ask without one for help"),
        (["locate", "1", "x", "2"], "'x' is no number"),
        (["locate", "nan", "1", "2"], "a coordinate is not finite or 2^150 or more"),
        (["drop", "1", "1", "1", "1.5"], "'1.5' is no index"),
        (["drop", "1", "1", "1", "2"], "sector 2 does not exist: there are 2"),
        (["visible", "0", "2"], "sector 2 does not exist: there are 2"),
        (["drop", "9", "9", "9", "?"], "the point lies in no sector"),
        (["drop", "1", "1", "1", "0", "-1"], "the limit is negative or not a number"),
        (["ledges", "3", "0", "0"], "body 3 does not exist: there are 1"),
        (["ledges", "0", "0", "0"], "how high body 0 floats was not known when the level was compiled"),
        (["basins", "0"], "how high body 0 floats was not known when the level was compiled"),
        (["basins", "1"], "body 1 does not exist: there are 1"),
        (["ledges", "kyle", "0", "0"], "no body is of the template 'kyle'"),
        (["leave", "0", "0", "1"], "leave takes 8 words, not 3"),
        (["leave-thing", "0", "0", "0", "0", *"0" * 16], "leave-thing takes 4 numbers, 2 points and 3 corners or more"),
        (["--binary", "nowhere", "out"], "cannot read nowhere: no such file or directory"),
        (["--binary", ".", "out"], "cannot read .: is a directory"),
        (["--binary", "odd", "out"], "odd is not whole queries of 72 bytes"),
        (["--binary", "none", "nowhere/out"], "cannot write nowhere/out: no such file or directory"),
        (["--binary", "none"], "--binary takes two files, not 1"),
        (["--time", "1"], "--time takes no words, not 1"),
        (["-", "1"], "- takes no words, not 1"),
        (["--what"], "no question '--what'; ask without one for help"),
    ],
)
def test_a_wrong_question_is_one_sentence(arguments: list[str], why: str, jklb_query: Path, tmp_path: Path) -> None:
    path, _ = compiled_at(tmp_path, level_of(TWO_ROOMS))
    (tmp_path / "none").touch()
    (tmp_path / "odd").write_bytes(bytes(71))
    done = subprocess.run([jklb_query, path, *arguments], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"jklb_query: error: {why}\n")


def test_what_cannot_be_asked_is_answered_as_unknown(jklb_query: Path, tmp_path: Path) -> None:
    from benchmarks.runtime_queries import DROP, LOCATE, QUERY, SIGHT, VISIBLE  # noqa: PLC0415 (the record alone)

    path, _ = compiled_at(tmp_path, level_of(TWO_ROOMS))
    queries = np.zeros(7, QUERY)
    queries["kind"] = [SIGHT, SIGHT, DROP, DROP, LOCATE, VISIBLE, 99]
    queries["which"][:, 0] = [2, 0, -1, 0, 0, 2, 0]
    queries["origin"][1] = np.nan
    queries["target"][3, 0] = -1
    queries["origin"][4] = 2.0**150
    found, _ = ask(jklb_query, path, queries)
    assert found["whole"][:, :3].tolist() == [
        [0, 0, -1], [0, 0, -1], [5, -1, -1], [5, -1, 0], [-1, 0, 0], [0, 0, 0], [-1, -1, -1]
    ]  # fmt: skip
    assert np.isnan(found["real"][2:4, 0]).all()


def test_the_summary_and_the_times(jklb_query: Path, tmp_path: Path) -> None:
    path, _ = compiled_at(tmp_path, level_of(TWO_ROOMS))
    done = subprocess.run([jklb_query, path], capture_output=True, text=True, check=True)
    assert done.stdout.startswith(f"{path}: compiled level, format 1.")
    assert "12 vertices, 12 surfaces, 2 sectors, 2 adjoins, 2 things, 1 bodies" in done.stdout
    timed = subprocess.run([jklb_query, path, "--time"], capture_output=True, text=True, check=True)
    assert "ms to the first answer; median of 51" in timed.stdout


@pytest.mark.skipif(not os.environ.get("JKTOOLS_FUZZ"), reason="compiles the sample once more")
def test_cmake_builds_the_sample(programs: Path, tmp_path: Path) -> None:
    assert programs
    folder = tmp_path / "build"
    configure = ["cmake", "-S", str(ROOT / "runtime/sample"), "-B", str(folder), f"-DFLATBUFFERS={FLATBUFFERS}"]
    for command in (configure, ["cmake", "--build", str(folder)]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
    assert (
        "usage: jklb_query"
        in subprocess.run([folder / "jklb_query", "--help"], capture_output=True, text=True, check=True).stdout
    )


def blocks_of_the_readme() -> list[str]:
    return re.findall(r"^```cpp\n(.*?)^```", (ROOT / "runtime/README.md").read_text(), re.DOTALL | re.MULTILINE)


def test_the_code_of_the_readme_compiles(programs: Path) -> None:
    include, code = blocks_of_the_readme()[0].split("\n", 1)
    source = programs / "readme.cpp"
    source.write_text(f"{include}\nvoid report(const std::string&);\nvoid shown() {{\n{code}\n}}\n")
    command = [compiler(), "-std=c++17", "-fsyntax-only", "-I", ROOT / "runtime", "-isystem", FLATBUFFERS, source]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_walk_of_the_readme(programs: Path, tmp_path: Path) -> None:
    """Over the halls: floors at 0 up to x = 4, a pit of 2 JKU to 6, a bank to 8, a step of 1/16 to 8.5, 0.5 beyond."""
    source = programs / "walk.cpp"
    source.write_text(blocks_of_the_readme()[1])
    program = built(str(source), programs / "walk", ("-O2", "-fno-exceptions", "-fno-rtti"))
    path, compiled = compiled_at(tmp_path, halls())
    floors = {
        round(float(compiled.vertices[own][:, 0].min()), 3): surface
        for surface in np.flatnonzero(compiled.surface_flags & 1).tolist()
        for own in [
            compiled.geometry.corner_vertex[slice(*compiled.geometry.surface_corner_start[surface : surface + 2])]
        ]
        if compiled.vertices[own][:, 1].max() <= 4
    }

    def walk(*words: str) -> list[str]:
        done = subprocess.run([program, path, *words], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
        return done.stdout.splitlines()

    assert walk("walkplayer", "2", "2", ".18", ".02", "0") == [f"detaches at 4 2, 2 JKU over surface {floors[4]}"]
    assert walk("WalkPlayer", "7", "2", ".18", ".02", ".01") == [
        f"goes over to surface {floors[8]}, -0.0625 JKU down", "is stopped at 8.5 2.75"
    ]  # fmt: skip
    assert walk("walkplayer", "2", "2", ".18", "0", "-.02") == ["is stopped at 2 0"]
    assert walk("another", "2", "2", ".18", "0", ".02") == [f"does not know surface {floors[0]}"]


def test_the_commands_of_the_readme_are_those_that_are_tried_here() -> None:
    readme = (ROOT / "runtime/README.md").read_text()
    assert "c++ -std=c++17 -O2 -I runtime -isystem .venv/include runtime/sample/jklb_query.cpp -o jklb_query" in readme
    assert "cmake -S runtime/sample -B build/sample -DFLATBUFFERS=" in readme


def test_the_questions_of_the_readme_have_answers(corpus: Path, jklb_query: Path, tmp_path: Path) -> None:
    path, _ = compiled_at(tmp_path, load(str(corpus / "gob/masspack.gob!jkl/lagoon.jkl")))
    lines = re.findall(
        r"^jklb_query lagoon\.jklb ((?:sight|drop|ledges) .*?)  ", (ROOT / "runtime/README.md").read_text(), re.M
    )
    found = answers(jklb_query, path, [" ".join(shlex.split(line)) for line in lines])
    assert [answer.split()[0] for answer in found] == ["visible", "floor", "0"]
    assert found[2].startswith("0 to 1 water, surface 19, ")


@pytest.mark.parametrize("flag", ["-ffast-math", "-mfpmath=387"])
def test_a_compiler_that_breaks_exactness_is_refused(flag: str, programs: Path) -> None:
    if platform.machine() != "x86_64":
        pytest.skip("flags of x86")
    source = programs / "exact.cpp"
    source.write_text('#include "jklb/exact.hpp"\n')
    command = [compiler(), "-std=c++17", flag, "-fsyntax-only", "-I", ROOT / "runtime", source]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "jklb" in done.stderr
