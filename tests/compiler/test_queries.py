"""What a compiled level answers from its own columns, against the level that it was made from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import jktools
from benchmarks.runtime_queries import KINDS
from jktools.compiler import CompiledLevel, compile_level
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind
from jktools.geometry import SectorMesh
from jktools.model import Level
from tests.support.halls import halls
from tests.support.levels import TWO_ROOMS, corpus_files, level_of, two_rooms

FIXTURES = {
    "two rooms": TWO_ROOMS,
    "a vertex beyond float32": two_rooms("World vertices 12", "11: 1e39 2 1"),
    "a surface of 25 corners": two_rooms(
        "World surfaces 12", "6: 0 0x4 0x4 4 3 1 -1 0 25 " + " ".join(["3,0 2,1 8,2 9,3 3,0"] * 5) + " 1" * 25
    ),
    "a wall instead of an adjoin": two_rooms("World adjoins 2", "0: 0x0 1 1"),
}


def assert_answers_as(level: Level) -> None:
    mesh, own = CompiledLevel(compile_level(level)).mesh, SectorMesh.from_level(level)
    rng = np.random.default_rng(3)
    for make in KINDS.values():
        asked = make(level, 500, rng)
        for one, other in (
            (mesh.sight(*asked), own.sight(*asked)),
            (mesh.drop(asked.origins, asked.sectors), own.drop(asked.origins, asked.sectors)),
            (mesh.location(asked.targets), own.location(asked.targets)),
        ):
            for mine, theirs in zip(one, other, strict=True):
                assert np.array_equal(mine, theirs, equal_nan=mine.dtype.kind == "f")


@pytest.mark.parametrize("name", FIXTURES)
def test_its_mesh_answers_as_the_level_does(name: str) -> None:
    assert_answers_as(level_of(FIXTURES[name]))


def test_its_mesh_answers_as_the_halls_do() -> None:
    assert_answers_as(halls())


def test_its_mesh_answers_as_a_real_level_does(corpus: Path) -> None:
    assert_answers_as(level_of(dict(corpus_files())["namekwaters.jkl"]))


def test_what_the_engine_would_not_load_is_not_known() -> None:
    for name in ("a vertex beyond float32", "a surface of 25 corners"):
        mesh = CompiledLevel(compile_level(level_of(FIXTURES[name]))).mesh
        assert mesh.sight([(0.5, 1.5, 0.5)], [1], [(0.5, 1.25, 0.5)]).crossed.tolist() == [0], name
        assert mesh.sight([(0.5, 0.5, 0.5)], [0], [(0.5, 0.75, 0.5)]).crossed.tolist() == [1], name


def test_ledges_are_found_by_edge_and_place() -> None:
    level = halls()
    facts, compiled = LevelFacts(level), CompiledLevel(compile_level(level))
    (body,) = facts.bodies
    found = facts.ledges(body, Engine("research"), "balanced")
    listed = np.flatnonzero(found.kind != Kind.LEVEL)
    assert len(listed) > 20
    for row in listed.tolist():
        edge = (0, int(found.surface[row]), int(found.corner[row]))
        middle = (found.start[row] + found.end[row]) / 2
        (ledge,) = compiled.ledges_at(*edge, middle)
        assert ledge[:6] in [each[:6] for each in compiled.ledges_at(*edge)], (
            "all but the drops, which can be no numbers"
        )
        assert (ledge.kind, ledge.below) == (found.kind[row], found.below[row])
        assert ledge.start == np.float32(found.start[row])
    edges = {(s, c) for s, c in zip(found.surface[listed].tolist(), found.corner[listed].tolist(), strict=True)}
    assert sum(len(compiled.ledges_at(0, s, c)) for s, c in edges) == len(listed)
    assert compiled.ledges_at(0, 0, 200) == []


def test_basins_are_found_by_body() -> None:
    compiled = CompiledLevel(compile_level(halls()))
    assert compiled.basins is not None
    (basin,) = compiled.basins_of(0)
    assert list(basin.surfaces) == compiled.basins.surface.tolist()
    assert compiled.basins_of(1) == []


def test_a_body_that_is_not_there() -> None:
    without = CompiledLevel(compile_level(level_of(two_rooms("World templates 0", "World things 0"))))
    for compiled, body in ((CompiledLevel(compile_level(level_of(TWO_ROOMS))), 1), (without, 0)):
        with pytest.raises(IndexError, match=r"body \d does not exist: there are [01]"):
            compiled.ledges_at(body, 0, 0)


def test_a_column_that_is_absent_takes_its_rows_from_one_declared_behind_it() -> None:
    """No surface has a material: the column is left out, and the one that counts its rows comes after it."""
    lines = TWO_ROOMS.split("\n")
    start = lines.index("World surfaces 12")
    bare = [f"{line.split(':')[0]}: -1{line.split(':')[1][2:]}" if ":" in line else line for line in lines[start:]]
    end = bare.index("")
    level = level_of("\n".join([*lines[:start], *bare[:end], *lines[start + end :]]))
    assert set(level.document.surfaces.material.tolist()) == {-1}
    assert CompiledLevel(jktools.build(level)).surface_material.tolist() == [-1] * 12
