"""A level as a simulation sees it: a compiled file gives what its source gives, to the last bit."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from fixtures.smithdev.pack import GOB
from jktools.cli import main
from jktools.compiler import CompiledLevel, CompileSettings, compile_level, open_compiled
from jktools.engine.body import Body
from jktools.engine.profile import Engine
from jktools.engine.simulation import History
from jktools.geometry import Plan
from jktools.geometry.plan import plan_of
from jktools.model import Level
from jktools.session import load
from jktools.trace.in_level import body_named, start_at, trace_in_level
from jktools.trace.stage import Start, stage_of
from tests.support.levels import CORPUS, TWO_ROOMS, level_of, two_rooms

KEYS = "0 run forward\n2 run left\n3 jump\n4 run forward right\n6 run back\n7 jump\n8 crouch\n10 end\n"
SEEN_BY_TRACES = CompileSettings(only=frozenset(("things", "models")))
REAL = ("masspack.gob!jkl/lagoon.jkl", "masspack.gob!jkl/azulcity.jkl", "glowdemo.gob", "hell.jkl")
SMITHDEV = str(GOB)
LEVELS = [pytest.param(name, id=Path(name).name) for name in (SMITHDEV, *REAL)]
TWO = CompiledLevel(compile_level(level_of(TWO_ROOMS)))


def path_of(name: str) -> str:
    """A level of the corpus, or the fixture."""
    if name == SMITHDEV:
        return name
    if not CORPUS.exists():
        pytest.skip("the corpus of real mods is not at hand")
    return str(CORPUS / ("jkl" if name.endswith(".jkl") and "!" not in name else "gob") / name)


@cache
def both(name: str) -> tuple[Level, CompiledLevel]:
    """A level, and what it becomes."""
    level = load(path_of(name))
    return level, CompiledLevel(compile_level(level, SEEN_BY_TRACES), level.path)


def assert_same(one: History, other: History) -> None:
    for name in ("time", "thrust", "velocity", "position", "attached"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    assert (one.incidents, one.warnings) == (other.incidents, other.warnings)


def body_or_refusal(level: Level | CompiledLevel, template: str) -> Body | str:
    try:
        return body_named(level, template)
    except ValueError as error:
        return str(error)


@pytest.mark.parametrize("name", LEVELS)
def test_the_stage_of_a_file_is_that_of_its_source(name: str) -> None:
    """Geometry, gravity, every thing's place, and the body of every template that the file keeps."""
    level, file = both(name)
    plans: list[Plan] = [stage_of(each).plan for each in (level, file)]
    for field, mine, other in zip(Plan._fields, *plans, strict=True):
        assert np.array_equal(mine, other), field
    assert stage_of(level).gravity == stage_of(file).gravity > 0
    numbers = [thing.number for thing in level.things if thing.dropped is None]
    assert len(numbers) > 3
    assert [start_at(level, str(n)) for n in numbers] == [start_at(file, str(n)) for n in numbers]
    assert file.templates is not None
    kept = [file.strings[i] for i in file.templates.name]
    bodies = [body_or_refusal(level, template) for template in kept]
    assert bodies == [body_or_refusal(file, template) for template in kept]
    assert any(isinstance(body, Body) and body.insert_offset_z > 0 for body in bodies)


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize("name", LEVELS)
def test_a_trace_in_a_file_is_that_in_its_source(name: str, engine: Engine) -> None:
    """Ten seconds from up to five things' places, in the body of the player that the level has."""
    level, file = both(name)
    things = [thing for thing in level.things if thing.dropped is None and level.sound_sectors[thing.sector_index]]
    players = [thing for thing in things if thing.resolved.type == "player"]
    body = body_named(level, players[0].template_name)
    for thing in [players[0], *things[:: max(1, len(things) // 4)]]:
        walks = [
            trace_in_level(KEYS, each, start_at(each, str(thing.number)), body=body, engine=engine)
            for each in (level, file)
        ]
        assert_same(*walks)
        assert len(walks[0].time) == 501


def test_a_trace_in_a_new_process_from_the_file_on_disk(tmp_path: Path) -> None:
    """`jktools trace run --level FILE`: the CSV is that of the source, byte by byte."""
    _, file = both(SMITHDEV)
    built, script = tmp_path / "smithdev.jklb", tmp_path / "keys.txt"
    built.write_bytes(file.data)
    script.write_text(KEYS)
    said = []
    for level in (str(built), SMITHDEV):
        command = [sys.executable, "-m", "jktools", "trace", "run", str(script), "--level", level, "--at", "0"]
        run = subprocess.run([*command, "--body", "walkplayer"], check=True, capture_output=True, timeout=100)
        said.append((run.stdout, run.stderr))
    assert said[0] == said[1] and said[0][0].count(b"\n") == 502


def test_at_fast_the_file_answers_about_its_grid() -> None:
    level = level_of(two_rooms("World vertices 12", "0: 0.013 0 0"))
    file = CompiledLevel(compile_level(level, replace(SEEN_BY_TRACES, accuracy="fast")))
    assert file.vertex_step > 0
    moved = stage_of(file).plan.positions - plan_of(level).positions
    assert 0 < np.abs(moved).max() <= file.vertex_step / 2


def test_the_first_thing_of_a_number_that_is_in_the_level() -> None:
    """The engine skips a thing in no sector, and the next one takes its number."""
    things = ["0: walkplayer a .5 .5 .12 0 0 0 9", "0: walkplayer b .5 .25 .12 0 90 0 0"]
    before = TWO_ROOMS.partition("World things")[0]
    level = level_of("\n".join([f"{before}World things 2", *things, "end", ""]))
    assert start_at(level, "0") == Start((0.5, 0.25, float(np.float32(0.12))), 0, 90.0)
    assert start_at(CompiledLevel(compile_level(level)), "0") == start_at(level, "0")


# ---- what a file does not hold


@pytest.mark.parametrize(
    ("without", "asked", "said"),
    [
        ("things", lambda file: start_at(file, "0"), "the file has no things: left out by --skip"),
        ("templates", lambda file: body_named(file, "walkplayer"), "the file has no templates: left out by --skip"),
        ("motion", lambda file: start_at(file, "77"), "the level has no thing 77"),
        ("motion", lambda file: body_named(file, "nobody"), "the file has no template nobody"),
        ("motion", lambda file: body_named(file, "ghost"), "does not move by physics, but move="),
        ("motion", lambda file: start_at(file, "0,0,0,2"), "sector 2 is none of the level's 2"),
    ],
)
def test_what_is_not_in_the_file_is_told(without: str, asked: object, said: str) -> None:
    file = CompiledLevel(compile_level(level_of(TWO_ROOMS), CompileSettings(skip=frozenset((without,)))))
    assert callable(asked)
    with pytest.raises(ValueError, match=said):
        asked(file)


def test_a_body_whose_model_is_not_at_hand_is_refused_alike() -> None:
    walker = "bird none type=actor move=physics size=.1 movesize=.1 physflags=0x40 model3d=bird.3do"
    level = level_of(two_rooms("World templates 4", walker))
    file = CompiledLevel(compile_level(level))
    said = "template bird hovers over floors by its model bird.3do, not at hand"
    assert body_or_refusal(level, "bird") == body_or_refusal(file, "bird") == said


def test_what_is_known_of_the_games_models_is_as_a_file_would_say_it() -> None:
    """The file of a model is read in single precision: the table must say the same, with or without it."""
    walker = "kyle none type=player move=physics size=.1 movesize=.065 physflags=0x40 model3d=ky.3do"
    level = level_of(two_rooms("World templates 4", walker))
    file = CompiledLevel(compile_level(level))
    assert body_named(level, "kyle").insert_offset_z == float(np.float32(0.120114))
    assert body_named(file, "kyle") == body_named(level, "kyle")
    assert file.models is not None and (file.models.known.tolist(), np.isnan(file.models.radius).tolist()) == (
        [1],
        [True],
    )
    assert file.insert_offset("KY.3do") == tuple(np.array((-5e-5, 0, 0.120114), np.float32).tolist())


def test_the_models_at_hand_are_in_the_file() -> None:
    level, file = both(SMITHDEV)
    assert file.models is not None and not file.models.known.any()
    names = [file.strings[i] for i in file.models.name]
    assert len(names) == len(set(names)) > 10
    for row, name in enumerate(names):
        model = level.resources.model(name)
        assert model is not None
        assert file.models.insert_offset[row].tolist() == model.insert_offset.tolist()
        assert file.models.radius[row] == np.float32(model.radius)


@pytest.mark.parametrize(("option", "value"), [("--base", "."), ("--at", "99999")])
def test_wrong_use_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str], option: str, value: str) -> None:
    built, script = tmp_path / "rooms.jklb", tmp_path / "keys.txt"
    built.write_bytes(TWO.data)
    script.write_text(KEYS)
    at = [] if option == "--at" else ["--at", "0"]
    assert main(["trace", "run", str(script), "--level", str(built), *at, option, value]) == 2
    said = capsys.readouterr().err
    assert "when the level was compiled" in said if option == "--base" else "the level has no thing 99999" in said


def test_a_damaged_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    built, script = tmp_path / "rooms.jklb", tmp_path / "keys.txt"
    built.write_bytes(bytes(TWO.data)[:900])
    script.write_text(KEYS)
    assert main(["trace", "run", str(script), "--level", str(built), "--at", "0"]) == 2
    assert "rooms.jklb" in capsys.readouterr().err
    built.write_bytes(TWO.data)
    assert open_compiled(built).plan.sector_flags.tolist() == [0, 0]
