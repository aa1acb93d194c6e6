"""Document, "Insert Offset": bodies with none and with 0.3, over a floor and over ground that is none."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine.hover import SETTLING_SPEED
from jktools.facts.ledges import Kind
from tests.experiments.conftest import Compile
from tests.experiments.smithdev import GOLDEN, Experiment
from tests.experiments.tracing import Run

ENGINES = ("research", "openjkdf2")
RULES = GOLDEN["insert_offset"]
RADIUS = GOLDEN["walkplayer"]["movesize"]
CLEAR = {"research": 0.0, "openjkdf2": 0.005}
"""JKU that a profile keeps between the sphere and the floor where the insert offset does not."""


def hover(level: Experiment, template: str) -> float:
    ledges = level.level.ledges
    assert ledges is not None
    return float(ledges.body_hover[level.body(template)])


def test_only_z_counts(smithdev: Experiment) -> None:
    """-0.1 more in x and 0.3 more in y: 'absolutely no effect'. All three are one body to the compiler."""
    assert RULES["only_z_matters"] is True
    assert smithdev.body("io_03") == smithdev.body("io_03_x") == smithdev.body("io_03_y")
    assert smithdev.body("io_03") != smithdev.body("io_zero")


def test_the_offsets_are_the_documents(smithdev: Experiment) -> None:
    assert RULES["default"][2] == GOLDEN["walkplayer"]["insert_offset_z"]
    assert hover(smithdev, "walkplayer") == pytest.approx(RULES["default"][2], abs=1e-7)
    assert hover(smithdev, "io_03") == pytest.approx(RULES["transition_seen_at_insert_offset_z"], abs=1e-7)


@pytest.mark.parametrize("engine", ENGINES)
def test_landing(compiled: Compile, trace: Run, engine: str) -> None:
    """'The player's collision sphere is used to detect initial floor collision', then a linear rise to the offset."""
    assert RULES["landing"] == "found by the collision sphere, then raised"
    assert RULES["transition"].startswith("linear")
    drop = trace("3 end", "insert_offset/over the floor", "--body", "io_03", "--engine", engine)
    assert drop.said == ["lands"]
    landed = int(np.flatnonzero(drop.attached)[0])
    height = drop.position[:, 2]
    # Found by the sphere's touch, far below the offset.
    assert height[landed] == pytest.approx(RADIUS, abs=CLEAR[engine] + 1e-6)
    rising = np.diff(height[landed:])
    moving = rising[rising > 1e-9]
    assert moving[:-1].tolist() == pytest.approx([SETTLING_SPEED * 0.02] * (len(moving) - 1))
    assert height[-1] == pytest.approx(hover(compiled("--engine", engine), "io_03"), abs=1e-6)
    # Open: the document's eye saw "perhaps a quarter of a second"; at 0.5 JKU/s it is 0.47 s.
    assert len(moving) * 0.02 == pytest.approx(0.47, abs=0.02)


@pytest.mark.parametrize("engine", ENGINES)
def test_crouching(trace: Run, engine: str) -> None:
    """'Crouching seemed to circumvent the effect of the modified insert offset entirely', down and up alike linear."""
    assert RULES["crouching_z"] == 0.0
    script = "0 crouch\n2 stand\n4 end"
    low = [
        trace(script, "pit_rows/before 0.4 0.4", "--body", body, "--engine", engine).position[:, 2]
        for body in ("io_03", "walkplayer")
    ]
    assert low[0][99] == pytest.approx(low[1][99], abs=1e-9)
    assert low[0][99] == pytest.approx(RADIUS + (0 if engine == "research" else 0.01), abs=1e-6)
    assert low[0][-1] == pytest.approx(0.3, abs=1e-6)
    steps = np.abs(np.diff(low[0]))
    assert steps[steps > 1e-9].max() == pytest.approx(SETTLING_SPEED * 0.02)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_offset_of_0(compiled: Compile, trace: Run, engine: str) -> None:
    """'Sunken into the floor slightly, presumably in the same fashion as standing on a non-floor surface'."""
    level = compiled("--engine", engine)
    assert hover(level, "io_zero") == pytest.approx(RADIUS + CLEAR[engine], abs=1e-7)
    on_floor = trace("3 end", "insert_offset/over the floor", "--body", "io_zero", "--engine", engine)
    on_none = trace("3 end", "insert_offset/over no floor", "--body", "io_zero", "--engine", engine)
    assert on_floor.position[-1, 2] == pytest.approx(RADIUS + CLEAR[engine], abs=1e-6)
    assert on_none.position[-1, 2] == pytest.approx(RADIUS, abs=1e-6)
    assert on_floor.attached[-1] and not on_none.attached[-1]


def test_crouching_raises_a_body_without_an_offset(trace: Run) -> None:
    """'Going into crouch actually raised the player/camera view ever so slightly': the decompiled engine by 0.005."""
    assert RULES["zero_z"] == "sinks to the sphere; crouching raises the view at once"
    script = "2 crouch\n3 end"
    start = "insert_offset/over the floor"
    height = trace(script, start, "--body", "io_zero", "--engine", "openjkdf2").position[:, 2]
    assert height[-1] - height[99] == pytest.approx(0.005, abs=1e-6)
    assert height[101] == pytest.approx(height[-1], abs=1e-9), "within a frame: 0.005 JKU take 0.01 s"


WALKED_UP = {"walkplayer": {"0.05"}, "io_03": {"0.05", "0.1", "0.2"}, "io_zero": set()}
"""What passes under the sphere: insert offset less 0.065."""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("body", WALKED_UP)
def test_a_larger_offset_walks_up_what_needed_a_jump(compiled: Compile, trace: Run, body: str, engine: str) -> None:
    """The blocks along the room's wall: what the ledge pass says of each, and what a walk comes to."""
    assert RULES["larger_z"] == "walks up onto surfaces that needed a jump"
    level = compiled("--engine", engine)
    floors = level.surfaces("insert_offset/room.floor")
    for rise in level.about("insert_offset")["rises"]:
        (block,) = level.surfaces(f"insert_offset/block {rise}.floor")
        rows = [row for floor in floors for row in level.ledges(level.body(body), floor, block)]
        assert level.level.ledges is not None and rows
        kinds = {Kind(level.level.ledges.kind[row]) for row in rows}
        walk = trace("0 walk forward\n2.5 end", f"insert_offset/before {rise}", "--body", body, "--engine", engine)
        height = float(walk.position[-1, 2]) - hover(level, body)
        if rise in WALKED_UP[body]:
            assert kinds == {Kind.STEP}, rise
            assert height == pytest.approx(float(rise), abs=1e-6)
        elif kinds == {Kind.LIP}:
            assert height == pytest.approx(float(rise), abs=1e-6), "a lip is slid up"
        else:
            jumped = float(rise) <= level.level.ledges.body_jump[level.body(body)]
            assert kinds == {Kind.JUMP if jumped else Kind.WALL}, rise
            assert height < float(rise) / 2, "it stays before the block, leaning on its edge"
