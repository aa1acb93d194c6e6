"""Document, "Descending From Height": pits of many depths, walked over by bodies with several insert offsets.

The pit rows of smithdev: what the ledge pass of the compiled file says of each pit's rim, by both engine profiles, and
what a body does that is walked over it with `jktools trace`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from jktools.engine.reattach import search_distance
from jktools.facts.ledges import Kind
from tests.experiments.conftest import Compile
from tests.experiments.smithdev import GOLDEN, HANDLE, Experiment
from tests.experiments.tracing import Run

PITS: list[dict[str, str]] = HANDLE["pit_rows"]["about"]["pits"]
ROWS: list[dict[str, str]] = HANDLE["pit_rows"]["about"]["rows"]
ENGINES = ("research", "openjkdf2")


def changeover(offset: str) -> dict[str, float]:
    (row,) = (r for r in GOLDEN["reattach"]["changeover"] if r["insert_offset_z"] == float(offset))
    return row  # type: ignore[no-any-return]


def rim(smithdev: Experiment, pit: dict[str, str], template: str | None = None) -> int:
    """The row of the ledge from the walkway down into a pit: the whole width of it is one interval."""
    (walk,) = smithdev.surfaces(f"pit_rows/{pit['walk']}.floor")
    (bottom,) = smithdev.surfaces(f"pit_rows/{pit['pit']}.floor")
    (row,) = smithdev.ledges(smithdev.body(template or pit["template"]), walk, bottom)
    ledges = smithdev.level.ledges
    assert ledges is not None and (ledges.start[row], ledges.end[row]) == (0, 1)
    return int(row)


def seamless(smithdev: Experiment, pit: dict[str, str], template: str | None = None) -> bool:
    assert smithdev.level.ledges is not None
    kind = Kind(smithdev.level.ledges.kind[rim(smithdev, pit, template)])
    assert kind in (Kind.SEAMLESS, Kind.FALL)
    return kind is Kind.SEAMLESS


# ---- what the ledge pass says


def test_the_bodies_have_the_offsets_of_their_models(smithdev: Experiment) -> None:
    ledges = smithdev.level.ledges
    assert ledges is not None
    radius = GOLDEN["walkplayer"]["movesize"]
    for row in ROWS:
        body = smithdev.body(row["template"])
        assert ledges.body_movesize[body] == pytest.approx(radius, abs=1e-9)
        assert ledges.body_hover[body] == pytest.approx(max(radius, float(row["insert_offset"])), abs=1e-7)


def test_the_drops_are_the_depths_of_the_pits(smithdev: Experiment) -> None:
    ledges = smithdev.level.ledges
    assert ledges is not None
    for pit in PITS:
        row = rim(smithdev, pit)
        assert [ledges.drop_start[row], ledges.drop_end[row]] == pytest.approx([float(pit["depth"])] * 2, abs=5e-8)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("measured", GOLDEN["reattach"]["pit"], ids=lambda row: str(row["depth"]))
def test_the_three_pits_of_illustration_5(compiled: Compile, measured: dict[str, Any], engine: str) -> None:
    """0.11 and 0.13 are walked over without detaching, 0.2 is not."""
    (pit,) = (
        p
        for p in PITS
        if float(p["insert_offset"]) == measured["insert_offset_z"] and float(p["depth"]) == measured["depth"]
    )
    level = compiled("--engine", engine)
    assert seamless(level, pit) is measured["seamless"]
    assert seamless(level, pit, "walkplayer") is measured["seamless"]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("offset", [row["insert_offset"] for row in ROWS])
def test_the_changeover_lies_where_it_was_measured(compiled: Compile, offset: str, engine: str) -> None:
    """Drawing 15: of the pits at both ends of the measured interval the first is seamless, the second is not."""
    level, measured = compiled("--engine", engine), changeover(offset)
    verdicts = {float(p["depth"]): seamless(level, p) for p in PITS if p["insert_offset"] == offset}
    assert {measured["low"], measured["high"]} <= verdicts.keys()
    assert verdicts[measured["low"]] is True
    assert verdicts[measured["high"]] is False
    assert list(verdicts.values()) == sorted(verdicts.values(), reverse=True)


@pytest.mark.parametrize("offset", [row["insert_offset"] for row in ROWS])
def test_raycast_distance(smithdev: Experiment, offset: str) -> None:
    """RaycastDist = max(Radius, InsertOffsetZ) + Radius."""
    assert GOLDEN["reattach"]["formula"] == "max(radius, insert_offset_z) + radius"
    ledges = smithdev.level.ledges
    assert ledges is not None
    (template,) = (row["template"] for row in ROWS if row["insert_offset"] == offset)
    limit = float(ledges.body_reattach[smithdev.body(template)])
    assert limit == pytest.approx(changeover(offset)["predicted"], abs=1e-7)
    assert changeover(offset)["low"] <= round(limit, 6) <= changeover(offset)["high"]
    # "If the origin of the raycast is at the player's position then the insert offset should be added again."
    assert GOLDEN["reattach"]["from_position_adds"] == "insert_offset_z"
    if float(offset) >= GOLDEN["walkplayer"]["movesize"]:
        reach = search_distance(float(offset), GOLDEN["walkplayer"]["movesize"], attached=True)
        assert reach == pytest.approx(limit + float(offset), abs=1e-7)


@pytest.mark.parametrize("offset", ["0.01", "0.06"])
def test_below_the_movesize_the_offset_does_not_count(compiled: Compile, offset: str) -> None:
    """0.06 and 0.01 behave identically; the profiles take the two ends of the interval that was read, 0.005 apart."""
    limits = []
    for engine in ENGINES:
        level = compiled("--engine", engine)
        depths = [float(pit["depth"]) for pit in PITS if pit["insert_offset"] == offset and seamless(level, pit)]
        limits.append(max(depths))
    assert limits == [0.13, 0.1349]


TOLD_APART = [
    ("0.120114", "0.1851", "0.1852"), ("0.01", "0.13", "0.1301"), ("0.06", "0.13", "0.1301"),
    ("0.2", "0.265", "0.2651"), ("0.4", "0.465", "0.4651"),
]  # fmt: skip
"""Insert offset and two depths 0.0001 JKU apart, of which one is seamless by `research` and the next is not."""


@pytest.mark.parametrize("accuracy", ["balanced", "exact"])
def test_pits_a_ten_thousandth_apart_are_told_apart(compiled: Compile, accuracy: str) -> None:
    level = compiled("--accuracy", accuracy)
    assert level.level.settings["accuracy"] == accuracy
    assert told_apart(level) == TOLD_APART


def test_the_fast_tier_rounds_such_pits_together(compiled: Compile) -> None:
    """`fast` puts all vertices on one grid, whose step is wider than 0.0001: it still tells 0.13 from 0.2."""
    level = compiled("--accuracy", "fast")
    verdicts = {p["depth"]: seamless(level, p) for p in PITS if p["insert_offset"] == "0.120114"}
    assert (verdicts["0.11"], verdicts["0.13"], verdicts["0.2"]) == (True, True, False)
    assert told_apart(level) == []


def told_apart(level: Experiment) -> list[tuple[str, str, str]]:
    """The neighbours in depth that get different verdicts."""
    verdicts = {(p["insert_offset"], p["depth"]): seamless(level, p) for p in level.about("pit_rows")["pits"]}
    told = []
    for (offset, depth), verdict in verdicts.items():
        deeper = f"{round(float(depth) + 1e-4, 4)}"
        if (offset, deeper) in verdicts and verdict is not verdicts[offset, deeper]:
            told.append((offset, depth, deeper))
    return told


# ---- what a body does that is walked over them


RIM = 0.5
"""JKU from a ghost to the rim that it looks over."""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("pit", PITS, ids=lambda pit: f"{pit['insert_offset']} {pit['depth']}")
def test_a_walk_detaches_where_the_ledge_pass_says(
    compiled: Compile, pit: dict[str, str], engine: str, trace: Run
) -> None:
    start, body = f"pit_rows/{pit['start']}", ("--body", pit["template"])
    walk = trace("0 walk forward\n3 end", start, *body, "--engine", engine)
    assert walk.ahead[-1] > RIM + 0.2
    fell = not seamless(compiled("--engine", engine), pit)
    assert walk.said == (["leaves the ground", "lands"] if fell else [])
    rest = max(float(pit["insert_offset"]), 0.065 if engine == "research" else 0.07)
    assert walk.position[0, 2] == pytest.approx(rest, abs=1e-7)
    assert walk.position[-1, 2] == pytest.approx(rest - float(pit["depth"]), abs=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("measured", GOLDEN["reattach"]["pit"], ids=lambda row: str(row["depth"]))
def test_a_run_over_the_three_pits(measured: dict[str, Any], engine: str, trace: Run) -> None:
    """'Detachment did NOT occur in either of the two right pits; even when running over them.'"""
    start = f"pit_rows/before {measured['insert_offset_z']} {measured['depth']}"
    run = trace("0 run forward\n2 end", start, "--body", "walkplayer", "--engine", engine)
    assert run.ahead[-1] > RIM + 0.2
    assert run.position[-1, 2] == pytest.approx(run.position[0, 2] - measured["depth"], abs=1e-6)
    assert (run.said == []) is measured["seamless"]


@pytest.mark.parametrize("depth", ["0.11", "0.13", "0.185", "0.1851"])
def test_the_bump(depth: str, trace: Run) -> None:
    """'A bump point that is transitioned to first, then a following transition to the final point', at 0.11 too.

    Gingerly, at 0.2 JKU/s: the body sinks at 0.5 JKU/s, rests on the pit's edge with its sphere, and sinks on.
    """
    assert GOLDEN["reattach"]["bump"] == "settles twice, at depth 0.11 too"
    (pit,) = (p for p in PITS if (p["insert_offset"], p["depth"]) == ("0.120114", depth))
    options = ("--body", pit["template"], "--set", "maxthrust=0.6", "--fps", "100")
    walk = trace("0 walk forward\n5 end", f"pit_rows/{pit['start']}", *options)
    assert walk.said == []
    sinking = np.abs(np.diff(walk.position[:, 2]) + 0.5 / 100) < 1e-9
    starts = np.flatnonzero(np.diff(sinking.astype(int), prepend=0) == 1)
    assert len(starts) == 2
    assert RIM <= walk.ahead[starts[0]] < walk.ahead[starts[1]]


@pytest.mark.parametrize("depth", ["0.11", "0.13", "0.185", "0.1851"])
def test_the_bump_of_the_decompiled_engine(depth: str, trace: Run) -> None:
    """It settles twice where the pit is no deeper than the hover height, as `research` does.

    A deeper one its sphere takes once it has let go of the walkway, a movesize past the rim: the body sinks in one go.
    The document says that the bump was observed "even in the 0.11 depth pit", so the two differ here.
    """
    (pit,) = (p for p in PITS if (p["insert_offset"], p["depth"]) == ("0.120114", depth))
    options = ("--body", pit["template"], "--set", "maxthrust=0.6", "--fps", "100", "--engine", "openjkdf2")
    walk = trace("0 walk forward\n5 end", f"pit_rows/{pit['start']}", *options)
    assert walk.said == []
    sinking = np.abs(np.diff(walk.position[:, 2]) + 0.5 / 100) < 1e-9
    starts = np.flatnonzero(np.diff(sinking.astype(int), prepend=0) == 1)
    takes_at_once = float(depth) <= GOLDEN["walkplayer"]["insert_offset_z"]
    assert len(starts) == (2 if takes_at_once else 1)
    let_go = RIM if takes_at_once else RIM + GOLDEN["walkplayer"]["movesize"]
    # A frame at 0.2 JKU/s is 0.002 JKU.
    assert let_go <= walk.ahead[starts[0]] <= let_go + 0.002
