"""Draw the plots of docs/engine.md: `python -m tools.engine_plots [FOLDER]`. Same matplotlib, same bytes."""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from jktools.engine import drag, hover, jump, reattach
from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.ground import SURFACES, Steps
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.simulation import History, Phase, Simulation, simulate
from jktools.engine.thrust import Keys
from tools.integration_tradeoff import CASES, FRAME_RATES, front, measure

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "engine"
WALK = Keys(forward=1)
RADIUS = WALKPLAYER.movesize

STYLE = {
    "svg.hashsalt": "jktools",
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.grid": True,
    "grid.alpha": 0.3,
}


def walk(axes: Axes) -> None:
    """The document's Drawing 1: thrust and velocity of a walk and its stop."""
    history = _run([Phase(1, WALK), Phase(8, Keys())], 10.0)
    axes.plot(history.time, np.linalg.norm(history.thrust, axis=1), "r-", label="thrust, JKU/s²")
    axes.plot(history.time, np.linalg.norm(history.velocity, axis=1), "b-", label="velocity, JKU/s")
    axes.set_xlabel("seconds")
    axes.legend()


def stops(axes: Axes) -> None:
    """Drawings 8 to 10: the drop to 0 at the first speed at or below staticdrag."""
    for threshold in (0.15, 0.3, 0.6):
        of = dataclasses.replace(WALKPLAYER, staticdrag=threshold)
        history = _run([], 1.0, of=of, speed=1.0, dt=0.021)
        (line,) = axes.plot(history.time, history.velocity[:, 1], "x-", markersize=3, label=f"staticdrag {threshold}")
        axes.axhline(threshold, color=line.get_color(), linewidth=0.6, linestyle=":")
    axes.set_xlabel("seconds")
    axes.set_ylabel("velocity, JKU/s")
    axes.legend()


def decay(axes: Axes) -> None:
    """Table 12: time from speed 1 to a shown 0, against what Euler and each rest threshold give."""
    coefficients = np.geomspace(0.3, 8, 60)
    for rest_speed in drag.REST_SPEED.values():
        frames = drag.decay_frames(coefficients, 0.021, rest_speed=rest_speed)
        axes.loglog(coefficients, (frames - 2) * 0.021, label=f"Euler at 0.021 s to {rest_speed:g} JKU/s")
    axes.loglog([0.375, 1.5, 3, 6], [18.309, 4.488, 2.193, 1.042], "kx", label="measured (Table 12)")
    axes.set_xlabel("surfdrag, 1/s")
    axes.set_ylabel("seconds")
    axes.legend()


def surfaces(axes: Axes) -> None:
    """A walk and its stop by surface, in the profile that says how ice acts."""
    for name in ("floor", "icy", "very-icy", "deep-water", "non-floor"):
        history = _run([Phase(0, WALK), Phase(6, Keys())], 12.0, surface=name, engine=Engine.OPENJKDF2)
        axes.plot(history.time, history.velocity[:, 1], label=name)
    axes.set_xlabel("seconds")
    axes.set_ylabel("velocity, JKU/s (openjkdf2)")
    axes.legend()


def jumps(axes: Axes) -> None:
    """Apex by jump speed with walkplayer's air drag and without, standing and crouched."""
    speeds = np.linspace(0, 4, 81)
    axes.plot(speeds, jump.apex(speeds).height, label="no air drag")
    axes.plot(speeds, jump.apex(speeds, WALKPLAYER.airdrag).height, label="airdrag 0.5")
    for label, crouching in (("walkplayer", False), ("crouched", True)):
        speed = jump.jump_speed(WALKPLAYER, crouching=crouching)
        axes.plot(speed, jump.apex(speed, WALKPLAYER.airdrag).height, "o", label=label)
    axes.set_xlabel("jump speed, JKU/s")
    axes.set_ylabel("apex, JKU")
    axes.legend()


def changeover(axes: Axes) -> None:
    """Drawing 15: the step down that a body takes without falling, by insert offset."""
    inserts = np.linspace(0, 0.42, 300)
    for engine in Engine:
        limit = reattach.reattach_distance(inserts, RADIUS, engine=engine)
        axes.plot(inserts, limit, label=f"{engine}")
    brackets = {
        0.01: (0.13, 0.135),
        0.06: (0.13, 0.135),
        0.120114: (0.1851, 0.1852),
        0.2: (0.265, 0.27),
        0.4: (0.465, 0.47),
    }
    for insert, (low, high) in brackets.items():
        axes.plot([insert, insert], [low, high], "k_-", markersize=8)
    axes.set_xlabel("insert offset z, JKU (bars: measured brackets)")
    axes.set_ylabel("deepest seamless step, JKU")
    axes.legend()


def bump(axes: Axes) -> None:
    """The height of a body that walks gently into a pit of 0.11: it settles twice."""
    for speed in (0.1, 0.2, 2 / 3):
        of = dataclasses.replace(WALKPLAYER, maxthrust=speed * WALKPLAYER.surfdrag)
        history = _run([Phase(0, WALK)], 4.0, of=of, dt=0.005, ground=Steps.pit(0.11), start=-0.05)
        past = history.position[:, 1] > 0
        shown = past & (history.time - history.time[past.argmax()] < 0.8)
        height = history.position[shown, 2]
        axes.plot(history.time[shown] - history.time[past.argmax()], height, label=f"{speed:.2g} JKU/s")
    axes.set_xlabel("seconds after the edge")
    axes.set_ylabel("height over the upper floor, JKU")
    axes.legend()


def stairs(axes: Axes) -> None:
    """The lag of a walk and a run down stairs of 0.08 every 0.1 JKU, and the limit."""
    steps = np.arange(8)
    limit = float(reattach.reattach_distance(WALKPLAYER.insert_offset_z, RADIUS))
    for label, speed in (("walk", 2 / 3), ("run", 4 / 3)):
        flight = reattach.walk_down(np.full(8, 0.08), 0.1, speed, limit)
        axes.plot(steps, flight.lag + 0.08, "o-", label=label)
    axes.axhline(limit, color="k", linewidth=0.8, label="reattach distance")
    axes.set_xlabel("step")
    axes.set_ylabel("lag + drop, JKU")
    axes.legend()


def landing(axes: Axes) -> None:
    """From the touch of the sphere to the full insert offset of 0.3: the document's "quarter of a second"."""
    seconds = np.linspace(0, 0.6, 121)
    start = RADIUS - float(hover.hover_height(0.3, RADIUS))
    axes.plot(seconds, 0.3 + np.minimum(0, start + hover.SETTLING_SPEED * seconds), label="0.5 JKU/s")
    axes.axvline(0.25, color="k", linewidth=0.8, linestyle=":", label='"perhaps a quarter of a second"')
    axes.set_xlabel("seconds after touching the floor")
    axes.set_ylabel("height, JKU")
    axes.legend()


def integrators(axes: Axes) -> None:
    """Error of the walk against cost, each integrator at 10 to 1000 frames a second, and the Pareto front."""
    points = [measure(scheme, CASES[0], rate) for scheme in Scheme for rate in FRAME_RATES]
    for scheme in (Scheme.EXPLICIT_EULER, Scheme.ENGINE, Scheme.VELOCITY_VERLET, Scheme.RK4, Scheme.EXACT):
        own = [p for p in points if p.scheme is scheme]
        axes.loglog([p.cost for p in own], [max(p.error, 1e-16) for p in own], "o-", markersize=3, label=f"{scheme}")
    best = front(points)
    axes.loglog([p.cost for p in best], [max(p.error, 1e-16) for p in best], "ks", fillstyle="none", label="front")
    axes.set_xlabel("evaluations of the acceleration a simulated second")
    axes.set_ylabel("worst position error, JKU")
    axes.legend()


PLOTS: tuple[Callable[[Axes], None], ...] = (
    integrators, walk, stops, decay, surfaces, jumps, landing, changeover, bump, stairs,
)  # fmt: skip


def _run(
    phases: list[Phase],
    seconds: float,
    *,
    of: Body = WALKPLAYER,
    dt: float = 0.02,
    surface: str = "floor",
    engine: Engine = Engine.RESEARCH,
    ground: Steps | None = None,
    start: float = 0.0,
    speed: float = 0.0,
) -> History:
    simulation = Simulation(of, ground or Steps.flat(SURFACES[surface]), engine=engine)
    simulation.position, simulation.velocity = np.array([0.0, start, 0.0]), np.array([0.0, speed, 0.0])
    simulation.rest_on_ground()
    return simulate(simulation, phases, seconds, dt)


def draw(plot: Callable[[Axes], None], folder: Path) -> Path:
    """Draw one plot as FOLDER/<its name>.svg."""
    path = folder / f"{plot.__name__}.svg"
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 3.6), layout="constrained")
        plot(figure.add_subplot())
        FigureCanvasSVG(figure).print_svg(str(path), metadata={"Date": None, "Creator": None})
    return path


def main(folder: Path = FOLDER) -> None:
    """Draw them all."""
    folder.mkdir(parents=True, exist_ok=True)
    for plot in PLOTS:
        draw(plot, folder)


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
