"""Document, "Mass / Gravity": two crates over a trapdoor, and the same two pushed."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine.profile import Engine
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, Experiment
from tests.experiments.tracing import Run

ENGINES = ("research", "openjkdf2")
LIGHT, HEAVY = "sd_throwcrate_light", "sd_throwcrate_heavy"
RULES = GOLDEN["gravity"]


def test_the_masses_of_the_document(smithdev: Experiment) -> None:
    assert smithdev.template(LIGHT)["mass"] == pytest.approx(0.1, rel=1e-6)
    assert smithdev.template(HEAVY)["mass"] == 1000
    light, heavy = (smithdev.template(name) for name in (LIGHT, HEAVY))
    assert {key for key in light if light[key] != heavy[key]} == {"mass"}


@pytest.mark.parametrize("engine", ENGINES)
def test_crates_of_0_1_and_1000_land_together(smithdev: Experiment, trace: Run, engine: str) -> None:
    """From under the hatch to the cellar's floor: the same way, the same moment."""
    about, cellar = smithdev.about("gravity_drop"), smithdev.sector("gravity_drop/cellar")
    place = ",".join(map(str, [*about["under the hatch"], cellar]))
    falls = [trace("1.5 end", place, "--body", name, "--engine", engine) for name in (LIGHT, HEAVY)]
    assert bool((falls[0].position != falls[1].position).any()) is RULES["mass_changes_fall"]
    assert falls[0].said == falls[1].said == ["lands"]
    clear = 0.005 if engine == "openjkdf2" else 0.0
    assert falls[0].position[-1, 2] == pytest.approx(0.15 + clear - about["depth"], abs=1e-6)
    # By hand: at 4 JKU/s^2 against an air drag of 0.5 a body has fallen 8 t - 16 (1 - exp(-t / 2)), 1.6 JKU in 0.966 s.
    landed = float(falls[0].time[np.flatnonzero(falls[0].attached)[0]])
    assert 8 * 0.966 - 16 * (1 - np.exp(-0.483)) == pytest.approx(1.6, abs=2e-3)
    assert landed == pytest.approx(0.966, abs=0.025)


def test_what_the_hatch_is_before_and_after(smithdev: Experiment) -> None:
    """Closed it is a floor that nothing passes; the script names both of its sides."""
    (above,) = smithdev.surfaces("gravity_drop/room.hatch")
    (below,) = smithdev.surfaces("gravity_drop/cellar.hatch")
    geometry = smithdev.level.geometry
    assert geometry.surface_flags[above] == GOLDEN["flags"]["surface"]["floor"] | 0x4
    adjoin = geometry.surface_adjoin[above]
    assert not geometry.adjoin_flags[adjoin] & 0x2
    assert geometry.adjoin_surface[geometry.adjoin_mirror[adjoin]] == below
    assert smithdev.cog_values("gravity_drop/drop")[1:3] == [str(above), str(below)]
    crates = [str(smithdev.thing(f"gravity_drop/{name}")) for name in (LIGHT, HEAVY)]
    assert smithdev.cog_values("gravity_drop/drop")[3:] == crates


@pytest.mark.parametrize("engine", Engine)
def test_the_script_opens_the_hatch_and_lets_go_of_both(smithdev: Experiment, engine: Engine) -> None:
    """`sd_drop.cog`: 'a switch to change the surface to passable and detaching the things simultaneously'."""
    play = Play(smithdev, "gravity_drop/door", engine=engine)
    (light,), (heavy,) = play.living(LIGHT), play.living(HEAVY)
    play.run(0.5)
    rest = light.place[2]
    assert rest == heavy.place[2] == pytest.approx(0.15, abs=0.006), "both lie on the hatch"
    play.press("switch")
    heights = []
    for _ in range(75):
        play.run(0.02)
        heights.append((light.place[2], heavy.place[2]))
    assert bool([pair for pair in heights if pair[0] != pair[1]]) is RULES["mass_changes_fall"]
    assert rest - heights[-1][0] == pytest.approx(smithdev.about("gravity_drop")["depth"], abs=1e-6)
    hatch = {smithdev.surfaces(f"gravity_drop/{side}.hatch")[0] for side in ("room", "cellar")}
    assert play.geo_modes == dict.fromkeys(hatch, 0), "an open hatch is not drawn"


@pytest.mark.parametrize("engine", Engine)
def test_the_light_crate_is_pushed_easily(smithdev: Experiment, engine: Engine) -> None:
    """`sd_push.cog`: one force gives 2.5 JKU/s to the light one and 0.00025 to the heavy one; they slide so far."""
    force = smithdev.about("pushed_crates")["force"]
    play = Play(smithdev, "pushed_crates/door", engine=engine)
    play.run(0.5)
    crates = [*play.living(LIGHT), *play.living(HEAVY)]
    masses = [smithdev.template(crate.template)["mass"] for crate in crates]
    starts = [crate.place.copy() for crate in crates]
    play.press("switch")
    speeds = [float(np.linalg.norm(play.velocity(crate))) for crate in crates]
    assert speeds == pytest.approx([force / mass for mass in masses], rel=1e-6) == [2.5, 0.00025]
    play.run(5)
    ways = [crate.place - start for crate, start in zip(crates, starts, strict=True)]
    ahead = smithdev.look("pushed_crates/pushed " + LIGHT)
    far = [float(way @ ahead) for way in ways]
    assert [np.linalg.norm(way) for way in ways] == pytest.approx(far, abs=1e-9), "straight into the room"
    # Drag 3 a second takes a body v / 3 far, less a frame's; the document's rest is at 0.001, so the heavy one stays.
    assert far[0] == pytest.approx(2.5 / 3, rel=0.03)
    assert bool(far[1] < far[0] / 1000) is RULES["heavy_is_harder_to_push"]
