"""Document, "Mass / Gravity": two crates over a trapdoor, and the same two pushed."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.engine.gravity import apply_force
from tests.experiments.conftest import Compile
from tests.experiments.scripts import calls
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
    # By hand: 1.6 JKU at 4 JKU/s^2 take 0.894 s, a little more with an air drag of 0.5.
    landed = float(falls[0].time[np.flatnonzero(falls[0].attached)[0]])
    assert np.sqrt(2 * 1.6 / 4) < landed < 1.06


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


def test_the_script_opens_the_hatch_and_lets_go_of_both() -> None:
    """'Activating a switch to change the surface to passable and detaching the things simultaneously'."""
    assert calls("sd_drop.cog", "setadjoinflags") == ["setadjoinflags(above, 0x2)", "setadjoinflags(below, 0x2)"]
    assert calls("sd_drop.cog", "clearsurfaceflags") == [
        "clearsurfaceflags(above, 0x5)", "clearsurfaceflags(below, 0x4)",
    ]  # fmt: skip
    assert calls("sd_drop.cog", "detachthing") == ["detachthing(light)", "detachthing(heavy)"]
    assert calls("sd_drop.cog", "sleep") == []


def test_the_light_crate_is_pushed_easily(compiled: Compile) -> None:
    """One force, the script's, gives 2.5 JKU/s to the light one and 0.00025 to the heavy one."""
    level = compiled()
    force = [float(part) for part in level.cog_values("pushed_crates/push")[3].strip("()").split("/")]
    assert np.linalg.norm(force) == pytest.approx(level.about("pushed_crates")["force"])
    light, heavy = (apply_force(level.engine_body(name), force).velocity_change for name in (LIGHT, HEAVY))
    assert np.linalg.norm(light) == pytest.approx(2.5, rel=1e-6)
    assert np.linalg.norm(heavy) == pytest.approx(0.00025, rel=1e-6)
    assert bool(np.linalg.norm(heavy) < np.linalg.norm(light)) is RULES["heavy_is_harder_to_push"]
