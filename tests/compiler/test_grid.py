"""`accuracy="fast"`: one grid for all vertices, and all that follows them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from jktools.compiler import CompiledLevel, CompileSettings, compilation, compile_level
from jktools.compiler.columns import GEOMETRY
from jktools.compiler.grid import Grid, grid_of, on_grid, value_grid, vertex_grid
from jktools.facts import LevelFacts
from jktools.model import Level
from tests.support.levels import CORPUS, TWO_ROOMS, level_of

FAST = CompileSettings(accuracy="fast")


def odd(level: Level, by: float = 1 / 3) -> Level:
    """The level with every coordinate off any grid, and its boxes with it."""
    document = level.document
    return Level(
        replace(
            document,
            vertices=replace(document.vertices, position=document.vertices.position * np.float32(by)),
            sectors=replace(document.sectors, bound_box=document.sectors.bound_box * np.float32(by)),
        )
    )


def test_vertices_move_by_half_a_step_at_most_and_shared_ones_together() -> None:
    level = odd(level_of(TWO_ROOMS))
    done = compilation(level, FAST)
    moved = CompiledLevel(done.data)
    assert done.step == moved.vertex_step == 2.0**-14
    away = np.abs(moved.vertices.astype(np.float64) - level.vertices.astype(np.float64))
    assert 0 < away.max() <= done.step / 2
    steps = moved.vertices.astype(np.float64) / done.step
    assert (steps == np.rint(steps)).all()
    same = (level.vertices[:, None] == level.vertices[None]).all(axis=2)
    assert (same == (moved.vertices[:, None] == moved.vertices[None]).all(axis=2)).all()


def test_the_passes_see_the_vertices_of_the_file() -> None:
    level = odd(level_of(TWO_ROOMS), 20.03)
    moved, compiled = on_grid(level), CompiledLevel(compile_level(level, FAST))
    assert moved.vertices.tobytes() == compiled.vertices.tobytes()
    assert moved.vertices.tobytes() != level.vertices.tobytes()
    assert compiled.sector_bound_box.tobytes() == moved.document.sectors.bound_box.tobytes()


def test_a_box_holds_what_it_held() -> None:
    level = on_grid(odd(level_of(TWO_ROOMS)))
    sectors = level.document.sectors
    for i, sector in enumerate(level.sectors):
        inside = level.vertices[sector.vertices]
        assert inside.min(axis=0).tolist() == sectors.bound_box[i, :3].tolist()
        assert inside.max(axis=0).tolist() == sectors.bound_box[i, 3:].tolist()


def test_normals_turn_with_their_polygons_but_for_slivers() -> None:
    level = odd(level_of(TWO_ROOMS), 900.123)
    document = level.document
    position = document.vertices.position.copy()
    position[0, 2] += np.float32(0.4)  # tilts the floor of the first room, whose normal is then not its own
    level = Level(replace(document, vertices=replace(document.vertices, position=position)))
    grid = grid_of(on_grid(level))
    assert grid is not None
    before, after = LevelFacts(level).corners.normal, LevelFacts(on_grid(level)).corners.normal
    written = document.normals.direction
    turned = on_grid(level).document.normals.direction
    leaning = np.degrees(np.arccos(np.clip((before * written).sum(axis=1), -1, 1)))
    assert (leaning < 1).any()
    for i in range(len(written)):
        wanted = after[i] if leaning[i] < 1 else written[i]
        assert np.abs(turned[i] - wanted).max() <= 2.0**-15


@pytest.mark.parametrize(
    ("width", "step", "kind"),
    [(3.9, 2.0**-14, "<i2"), (4.0, 2.0**-13, "<i2"), (100, 2.0**-9, "<i2"), (200, 2.0**-14, "<i4")],
)  # fmt: skip
def test_the_step_follows_from_the_extent(width: float, step: float, kind: str) -> None:
    grid = vertex_grid(np.array([[5, 5, 5], [5 + width, 5, 5]], np.float32))
    assert grid is not None
    assert (grid.step, grid.kind) == (step, kind)
    assert np.abs(grid.steps(np.array([[5, 5, 5], [5 + width, 5, 5]], np.float32))).max() <= np.iinfo(kind).max + 1


@pytest.mark.parametrize("far", [0.0, 1000.0, 16000.0, 1e6, 1e30])
def test_every_value_on_a_grid_is_a_float32(far: float) -> None:
    random = np.random.default_rng(7)
    vertices = (random.uniform(-9, 9, (500, 3)) + far).astype(np.float32)
    grid = vertex_grid(vertices)
    assert grid is not None
    stored = grid.stored(vertices, "vertices")
    read = stored.array(GEOMETRY["vertices"])
    assert read.tobytes() == grid.snapped(vertices).tobytes()
    assert np.abs(read.astype(np.float64) - vertices).max() <= grid.step / 2


def test_there_is_no_grid_for_what_has_none() -> None:
    assert vertex_grid(np.zeros((0, 3), np.float32)) is None
    assert vertex_grid(np.array([[0, np.nan, 0]], np.float32)) is None
    assert value_grid(np.array([[0.0], [1e6]], np.float32), (-12, -8)) is None
    assert Grid(0.5, (0,), "<i2").snapped(np.array([np.nan], np.float32)).tolist() != [0]


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize("name", ["hell", "snakeway3"])
def test_real_levels(name: str) -> None:
    level = level_of((CORPUS / f"jkl/{name}.jkl").read_bytes())
    compiled = CompiledLevel(compile_level(level, FAST))
    away = np.abs(compiled.vertices.astype(np.float64) - level.vertices.astype(np.float64)).max()
    assert away <= compiled.vertex_step / 2
    turned = (compiled.surface_normal * level.document.normals.direction).sum(axis=1)
    assert (turned[: len(level.surfaces)] > np.cos(np.radians(1.01))).all()
    for column, bound in (("corner_light", 2.0**-9), ("texture_vertices", 2.0**-5)):
        written = {"corner_light": level.document.surfaces.light, "texture_vertices": level.texture_vertices}[column]
        assert np.abs(getattr(compiled, column).astype(np.float64) - written).max() <= bound
