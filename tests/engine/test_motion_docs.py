"""docs/engine.md: what it names exists, what holds a golden value is named, and its plots are made by the code."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from jktools.cli import main
from jktools.engine import drag, hover, jump, reattach
from jktools.engine.body import WALKPLAYER
from jktools.engine.integration import TRAITS, Scheme
from jktools.engine.profile import Engine
from tests.engine.motion_checks import Check
from tests.engine.test_golden_motion import CHECKS
from tests.support.levels import ROOT

PAGE = (ROOT / "docs/engine.md").read_text(encoding="utf-8").split("## Motion\n")[1].split("\n## ")[0] + "\n"


def test_tests_that_it_names_exist() -> None:
    named = re.findall(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", PAGE)
    assert len(named) > 40
    for file, test in named:
        assert f"def {test}(" in (ROOT / file).read_text() if test else (ROOT / file).exists(), (file, test)


def test_names_every_check() -> None:
    assert [check.__name__ for check in CHECKS.values() if f"`{check.__name__}`" not in PAGE] == []


def test_code_that_it_names_exists() -> None:
    for name in re.findall(r"`(jktools/[\w/]+(?:\.py)?)`", PAGE):
        assert (ROOT / name).exists(), name


def test_states_the_figures_of_the_code() -> None:
    for scheme, stated in {Scheme.RK4: "2.785294"}.items():
        assert f"{TRAITS[scheme].stability_limit:.6f}" == stated and stated in PAGE
    times = (drag.decay_frames([3.0, 1.5, 6.0, 0.375], 0.021) - 2) * 0.021
    assert "{:.3f}, {:.3f}, {:.3f} and {:.3f} s against".format(*times) in " ".join(PAGE.split())
    assert f"takes {float(hover.landing_seconds(0.3, 0.065)):.2f} s" in " ".join(PAGE.split())
    limits = [float(reattach.reattach_distance(0.01, 0.065, engine=engine)) for engine in Engine]
    assert "| 0.01, 0.06 | {:.3f} | {:.3f} |".format(*limits) in PAGE


def test_states_the_figures_of_a_jump() -> None:
    top, low = jump.apex(1.5, 0.5), jump.apex(1.05, 0.5)
    back = float(jump.flight_seconds(1.5, 0.0, 0.5))
    far = [float(jump.reach(WALKPLAYER, speed, steering=0.6)) for speed in (2 / 3, 4 / 3)]
    drops = np.arange(1.0, 4.0, 0.001)
    harm = jump.fall_damage(jump.landing_speed(drops, 0.0, 0.5))
    first, dead = (float(drops[np.argmax(harm >= points)]) for points in (1.0, 100.0))
    page = " ".join(PAGE.split())
    assert f"{top.height:.3f} JKU high after {top.seconds:.3f} s, back after {back:.3f} s" in page
    assert f"{far[0]:.2f} JKU far from a walk and {far[1]:.2f} from a run" in page
    assert f"crouched {low.height:.3f} JKU high" in page
    assert f"from a drop of {first:.2f} JKU on; 100 points at {dead:.2f}" in page


def test_plots_are_there_and_made_by_the_code(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from tools import engine_plots  # noqa: PLC0415 (it imports matplotlib, which a bare set-up lacks)

    names = {f"{plot.__name__}.svg" for plot in engine_plots.PLOTS}
    assert set(re.findall(r"\(engine/(\w+\.svg)\)", PAGE)) == names
    assert names <= {path.name for path in (ROOT / "docs/engine").iterdir()}
    # Bytes depend on matplotlib's version: here only that a drawing is reproducible, and its longest line the kept one.
    for plot in (engine_plots.changeover, engine_plots.bump):
        (tmp_path / "again").mkdir(exist_ok=True)
        drawn, again = engine_plots.draw(plot, tmp_path), engine_plots.draw(plot, tmp_path / "again")
        assert drawn.read_bytes() == again.read_bytes()
        kept = ROOT / "docs/engine" / drawn.name
        assert curve(drawn) == pytest.approx(curve(kept), abs=1e-3)


def curve(path: Path) -> np.ndarray:
    """The points of a drawing's longest line."""
    lines = re.findall(r'id="line2d_\d+">\s*<path d="([^"]+)"', path.read_text(encoding="utf-8"))
    return np.array([float(number) for number in re.findall(r"-?\d+\.?\d*", max(lines, key=len))])


def test_lists_what_holds_each_golden_value() -> None:
    rows: dict[Check, list[str]] = {}
    for pattern, check in CHECKS.items():
        rows.setdefault(check, []).append(f"`{pattern}`")
    module = {check: check.__module__.rsplit(".", 1)[1] for check in rows}
    table = [f"| {', '.join(keys)} | `{module[check]}.{check.__name__}` |" for check, keys in rows.items()]
    assert "\n".join(("| keys | check |", "|---|---|", *table, "")) in PAGE


def test_example_script_does_what_it_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script, said = re.findall(r"```\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "script.txt").write_text(script)
    assert main(["trace", "run", str(tmp_path / "script.txt"), "-o", str(tmp_path / "out.csv")]) == 0
    assert capsys.readouterr().err == said
