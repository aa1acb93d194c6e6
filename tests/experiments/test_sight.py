"""The document's section on sight: HasLOS past walls, windows, things, and what it costs in a fast pulse.

Past walls alone the compiled level answers: its geometry, its visibility, its hotspots. Past things `jktools.sights`
does, in a process of its own.
"""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

from fixtures.smithdev.chambers.sight_room import CASES
from fixtures.smithdev.pack import GOB
from jktools.engine import sight as rules
from jktools.engine.profile import Engine
from jktools.geometry.mesh import SectorMesh
from tests.experiments.conftest import Compile
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, Experiment

ROOM = "sight_room"
RULES: dict[str, Any] = GOLDEN["sight"]
BLOCKS = -1
PULSE = 0.05
"""Seconds, of the lamps' script."""

SEEN = {
    "open": True, "back turned": True, "wall": False, "window": True, "glass": True, "curtain": False,
    "hidden glass": False, "hidden": False, "crate": False, "over the block": True, "block": False, "actor": False,
    "item": False, "ghost": True,
}  # fmt: skip
"""By the document: the looker need not face the target, a solid thing or surface between them blocks.

What is drawn does not count: glass is seen through by its adjoin's visible flag, and the hidden one lacks it. The block
is a box of its model's faces, 0.3 high; a ghost is not solid.
"""
ASK = """
import json, sys, jktools
level, pairs, engine = jktools.load(sys.argv[1]), json.loads(sys.argv[2]), sys.argv[3]
print("\\n".join(str(verdict) for verdict in jktools.sights(level, pairs, engine=engine)))
"""
PAST_WALLS = {**SEEN, **dict.fromkeys(("crate", "block", "actor", "item"), True)}
BY_THE_ENGINE = {**SEEN, "actor": True, "item": True}
"""The decompiled engine lets only things of type cog block."""


def place(smithdev: Experiment, thing: str) -> tuple[Any, int]:
    """Where a thing stands, and its sector."""
    held = smithdev.level.things
    assert held is not None
    row = int(np.flatnonzero(held.source == smithdev.thing(f"{ROOM}/{thing}"))[0])
    return held.position[row].astype(np.float64), int(held.sector[row])


def mesh_of(smithdev: Experiment, engine: Engine) -> SectorMesh:
    """The walls, from the compiled arrays."""
    level = smithdev.level
    adjoin = level.surface_adjoin
    has = adjoin >= 0
    blocks = rules.surface_blocks(level.surface_flags, level.adjoin_flags[np.where(has, adjoin, 0)], has, engine)
    behind = level.surface_sector[level.adjoin_surface[level.adjoin_mirror[np.where(has, adjoin, 0)]]]
    return SectorMesh.from_arrays(
        level.vertices.astype(np.float64), level.surface_corner_start, level.corner_vertex,
        np.where(has & ~blocks, behind, BLOCKS), level.sector_first_surface, level.sector_surface_count,
    )  # fmt: skip


def test_every_case_has_its_answer() -> None:
    assert set(SEEN) == set(CASES)


def test_sight(smithdev: Experiment) -> None:
    """Past walls: adjoins by their visible flag, whatever is drawn on them, and nothing else."""
    mesh = mesh_of(smithdev, Engine.RESEARCH)
    lookers, targets = ([place(smithdev, f"{end} {case}") for case in CASES] for end in ("looker", "target"))
    told = mesh.sight([p for p, _ in lookers], [s for _, s in lookers], [p for p, _ in targets])
    assert dict(zip(CASES, told.visible.tolist(), strict=True)) == PAST_WALLS
    # The compiled visibility never denies what a ray sees, and denies the booths that nothing leads to.
    matrix = smithdev.level.visible_sectors
    assert matrix is not None
    hall = smithdev.sector(f"{ROOM}/hall")
    for case in CASES:
        assert bool(matrix[hall, smithdev.sector(f"{ROOM}/booth {case}")]) is PAST_WALLS[case], case


@pytest.mark.parametrize(("engine", "expected"), [("research", SEEN), ("openjkdf2", BY_THE_ENGINE)])
def test_haslos(smithdev: Experiment, engine: str, expected: dict[str, bool]) -> None:
    """Walls and things: what `jktools.sights` says of each lookout's two things."""
    assert "the looker need not face the target" in RULES["has_los"]
    assert "a solid thing or surface between them blocks" in RULES["has_los"]
    pairs = [[smithdev.thing(f"{ROOM}/{end} {case}") for end in ("looker", "target")] for case in CASES]
    asked = [sys.executable, "-c", ASK, f"{GOB}!jkl/smithdev.jkl", json.dumps(pairs), engine]
    verdicts = subprocess.run(asked, check=True, capture_output=True, text=True, timeout=300).stdout.splitlines()
    answers = {case: {"visible": True, "not visible": False}[v] for case, v in zip(CASES, verdicts, strict=True)}
    assert answers == expected


@pytest.mark.parametrize(("engine", "expected"), [(Engine.RESEARCH, SEEN), (Engine.OPENJKDF2, BY_THE_ENGINE)])
def test_the_lookouts_say_what_they_see(smithdev: Experiment, engine: Engine, expected: dict[str, bool]) -> None:
    """`sd_lookout.cog`, once a second; `sd_swinglamp.cog` asks as often as the hotspots say, and shines or not."""
    play = Play(smithdev, f"{ROOM}/booth wall", engine=engine, frame=25)
    play.run(2)
    for case, seen in expected.items():
        assert play.printed(f"lookout {case}") == ([(1.0, ["seen"]), (2.0, ["seen"])] if seen else []), case
    lamps = play.living("sd_swinglamp")
    hotspots, asked = smithdev.level.hotspots, play.asked
    assert hotspots is not None and len(lamps) == smithdev.about(ROOM)["lamps"]
    assert asked["sd_swinglamp"] / 2 == pytest.approx(hotspots.calls_per_second[0]) == len(lamps) / PULSE
    assert asked["ghost"] / 2 == pytest.approx(hotspots.calls_per_second[1:].sum()) == len(CASES)
    assert {play.lights[lamp.number] for lamp in lamps} == {0.0}, "no lamp sees who stands behind the wall"
    in_the_hall = Play(smithdev, f"{ROOM}/hall", engine=engine, frame=25)
    in_the_hall.run(0.5)
    assert {in_the_hall.lights[lamp.number] for lamp in lamps} == {1.0}


@pytest.mark.parametrize("engine", ["research", "openjkdf2"])
def test_haslos_in_a_fast_pulse(compiled: Compile, engine: str) -> None:
    """The swing lamps come first: each asks twenty times a second, which is more than all lookouts together."""
    assert "HasLOS in a fast pulse in many instances at once" in RULES["costly_case"]
    smithdev = compiled("--engine", engine) if engine != "research" else compiled()
    held, strings = smithdev.level.hotspots, smithdev.level.strings
    assert held is not None
    scripts = [strings[i] for i in held.script]
    assert scripts.count("sd_lookout.cog") == len(CASES)
    assert {strings[i] for i in held.verb} == {"haslos"}
    work = held.calls_per_second * held.mean_surfaces
    assert (np.diff(work) <= 0).all()
    assert scripts[0] == "sd_swinglamp.cog"
    lamps = smithdev.about(ROOM)["lamps"]
    assert (held.cog[0], held.things[0]) == (-1, lamps)
    assert held.calls_per_second[0] == pytest.approx(lamps / PULSE)
    own = [i for i, script in enumerate(scripts) if script == "sd_lookout.cog"]
    assert held.calls_per_second[own] == pytest.approx(np.ones(len(CASES)))
    assert work[0] > work[own].sum()
    # A lookout's ray enters the hall, and the booth where it gets so far: their surfaces are what it tests.
    by_cog = {int(held.cog[i]): int(held.mean_surfaces[i]) for i in own}
    counts = smithdev.level.sector_surface_count
    for case, through in PAST_WALLS.items():
        booth = counts[smithdev.sector(f"{ROOM}/booth {case}")] if through else 0
        assert by_cog[smithdev.cog(f"{ROOM}/lookout {case}")] == counts[smithdev.sector(f"{ROOM}/hall")] + booth
