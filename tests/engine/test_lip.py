"""Lips: the limit found by halving against whole walks."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from jktools.engine.body import WALKPLAYER
from jktools.engine.ground import SURFACES, Steps, Tread
from jktools.engine.lip import highest_lip
from jktools.engine.profile import Engine
from jktools.engine.simulation import Phase, Simulation, simulate
from jktools.engine.thrust import Keys

GRAVITY = 4.0


def goes_up(body: object, rise: float, start: float, engine: Engine) -> bool:
    """Whether a run that starts at rest two seconds before the lip ends above it."""
    floor = SURFACES["floor"]
    run = Simulation(
        body,
        Steps((Tread(-9.0, 0.0, floor), Tread(0.0, rise, floor))),
        engine=engine,
        position=np.array([0, start, 0.0]),
    )  # type: ignore[arg-type]
    run.rest_on_ground()
    return bool(simulate(run, [Phase(0.0, Keys(forward=1.0, run=True))], 4.0, 0.02).position[-1, 1] > 0)


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize("insert", [0.120114, 0.2, 0.4])
def test_a_running_player_climbs_a_lip_below_the_limit_and_none_well_above_it(insert: float, engine: Engine) -> None:
    body = dataclasses.replace(WALKPLAYER, insert_offset_z=insert)
    limit = highest_lip(body, GRAVITY, engine)
    standing = Simulation(body, engine=engine).hover_height()
    assert standing - body.movesize < limit < standing
    starts = -2.0 - np.arange(5) * 0.005
    assert all(goes_up(body, limit - 0.001, start, engine) for start in starts.tolist())
    assert not any(goes_up(body, limit + 0.008, start, engine) for start in starts.tolist())


def test_who_cannot_run_climbs_what_the_sphere_passes_over() -> None:
    body = dataclasses.replace(WALKPLAYER, maxthrust=0.0)
    assert highest_lip(body, GRAVITY) == pytest.approx(0.055114)


def test_an_actor_walks_and_climbs_less() -> None:
    actor = dataclasses.replace(WALKPLAYER, player=False)
    assert 0.06 < highest_lip(actor, GRAVITY) < highest_lip(WALKPLAYER, GRAVITY) < 0.08


@pytest.mark.parametrize(
    "change", [{"maxthrust": 1e9}, {"movesize": 50.0}, {"surfdrag": 1e-9}, {"surfdrag": 1e9}, {"maxvel": 0.0}]
)
def test_extreme_bodies_have_an_end(change: dict[str, float]) -> None:
    body = dataclasses.replace(WALKPLAYER, **change)  # type: ignore[arg-type]
    standing = Simulation(body).hover_height()
    assert max(standing - body.movesize, 0) <= highest_lip(body, GRAVITY) <= standing
