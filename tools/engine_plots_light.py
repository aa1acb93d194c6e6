"""Draw the plots of docs/engine.md on colour, light, particles and sight.

`python -m tools.engine_plots_light` gives the same bytes each time: no date, no random ids, text as text.
`--into FOLDER` writes elsewhere.
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from jktools.engine import ai_sight, colour, light, particles
from jktools.engine.colour import Renderer
from jktools.engine.colour_effect import ColourEffect
from jktools.engine.framebuffer import Depth
from jktools.engine.particle_spawn import spawn
from jktools.engine.particle_template import ParticleTemplate
from jktools.engine.profile import Engine

ROOT = Path(__file__).resolve().parent.parent
GOLDEN = tomllib.loads((ROOT / "tests/engine/golden.toml").read_text())
SQUARE = [[s, 0.0, t] for s in (-0.1, 0.1) for t in (-0.1, 0.1)]
STYLE = {
    "svg.hashsalt": "jktools",
    "svg.fonttype": "none",
    "font.size": 8.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.2,
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
}
MEASURED = {"marker": "o", "linestyle": "none", "color": "black", "markersize": 3.5, "label": "measured"}


def level(effect: ColourEffect, given: int, channel: int, engine: Engine, renderer: Renderer) -> int:
    """One channel of a grey under an effect, as the 565 screen shows it."""
    return int(colour.apply([given] * 3, effect, engine, renderer, Depth.RGB565)[channel])


def response(axes: Any, title: str, values: Any, given: int, channel: int, effect: Callable[[float], Any]) -> None:
    """Draw one channel against one parameter, by profile and renderer."""
    ways = (
        ("research", Engine.RESEARCH, Renderer.HARDWARE, "-"),
        ("openjkdf2, hardware", Engine.OPENJKDF2, Renderer.HARDWARE, "--"),
        ("openjkdf2, software", Engine.OPENJKDF2, Renderer.SOFTWARE, ":"),
    )
    for name, engine, renderer, dashes in ways:
        shown = [level(effect(float(value)), given, channel, engine, renderer) for value in values]
        axes.plot(values, shown, dashes, label=name)
    axes.set(title=title, ylim=(-8, 263), yticks=range(0, 256, 51))


def draw_colour(figure: Any) -> None:
    """Add on black, tint on white, brightness on white."""
    add, tint, brightness = figure.subplots(1, 3)
    response(add, "green of black, by add", np.arange(-20, 311, 2), 0, 1, lambda v: ColourEffect(add=(v, v, v)))
    add.plot([220], [199], **MEASURED)
    response(
        tint,
        "green of white, by red tint",
        np.linspace(-1, 3, 161),
        255,
        1,
        lambda v: ColourEffect(tint=(v, 0, 0)),
    )
    response(
        brightness,
        "red of white, by brightness",
        np.linspace(-0.5, 1.5, 161),
        255,
        0,
        lambda v: ColourEffect(brightness=v),
    )
    brightness.plot([0.0, 0.5], [0, 123], **MEASURED)
    add.legend(loc="lower right")


def draw_light(figure: Any) -> None:
    """Tables 17 to 19 on the line of the formula."""
    over_distance, over_value = figure.subplots(1, 2)
    table = GOLDEN["dynamic_light"]["distance"][0]
    distances = np.linspace(0.0, 2.6, 261)
    for value in (0.5, 1.0, 2.0):
        at = [light.light_on_vertices(SQUARE, [[0, -d, 0]], [value]).mean() for d in distances]
        over_distance.plot(distances, light.pixel(at), label=f"light {value}")
    over_distance.plot(table["distance_corrected"], table["pixel"], **MEASURED)
    over_distance.set(title="pixel at a target's centre", xlabel="distance, JKU")
    values = np.linspace(0.0, 1.4, 141)
    centre = float(np.hypot(0.1, 0.1))
    for name, offset, key in (
        ("at the vertex", 0.001, "at_vertex"),
        ("at the centre", centre, "at_surface_centre"),
    ):
        at = [light.light_on_vertices([[0, 0, 0]], [[0, offset, 0]], [value])[0] for value in values]
        over_value.plot(values, light.pixel(at), label=name)
        table = GOLDEN["dynamic_light"][key]
        over_value.plot(table["light"], table["pixel"], **{**MEASURED, "label": "_"})
    over_value.set(title="pixel next to the light", xlabel="light value")
    over_distance.legend()
    over_value.legend()


def draw_particles(figure: Any) -> None:
    """Where particles spawn, how they fade, how their cels go on."""
    top, bottom = figure.subplots(2, 3)
    shapes = (
        ("range 0.11, minsize 0.09", {}),
        ("pitchrange 35, yawrange 35", {"pitchrange": 35.0, "yawrange": 35.0}),
        ("pitchrange 5, yawrange 170", {"pitchrange": 5.0, "yawrange": 170.0}),
    )
    for axes, (title, change) in zip(top, shapes, strict=True):
        places = spawn(ParticleTemplate(count=256, range=0.11, minsize=0.09, **change), 1)[0]
        axes.plot(places[:, 0], places[:, 1], ".", markersize=2)
        axes.set(
            title=title,
            aspect="equal",
            xlim=(-0.12, 0.12),
            ylim=(-0.12, 0.12),
            xlabel="x, JKU",
            ylabel="y, JKU",
        )
    fade, cels, size = bottom
    for rate in (16.0, 128.0):
        track = particles.simulate(ParticleTemplate(count=128, timer=1.0, typeflags=0x8, rate=rate), 1, seconds=9.0)
        fade.plot(track.times, track.alive.sum(axis=1), label=f"rate {rate:.0f}")
    fade.set(title="particles left, timer 1 s, 0x8", xlabel="s")
    for engine in Engine:
        track = particles.simulate(
            ParticleTemplate(count=128, timer=1.0, typeflags=0x28, cels=5), 1, seconds=1.5, engine=engine
        )
        cels.plot(track.times, track.cels.mean(axis=1), label=engine.value)
    cels.set(title="mean cel of 5, timer 1 s, 0x20", xlabel="s")
    for thrust in (-0.5, 0.5, 3.0):
        cloud = ParticleTemplate(count=1, typeflags=0x1, maxthrust=thrust)
        size.plot(np.arange(76) * 0.02, particles.scales(cloud, 76, 20), label=f"maxthrust {thrust}")
    size.set(title="size of the cloud, 0x1", xlabel="s")
    for axes in bottom:
        axes.legend()


def draw_sight(figure: Any) -> None:
    """Which directions an AI sees, by fov."""
    angles = np.radians(np.arange(-180, 181, 3))
    for column, fov in enumerate((0.71, 0.29, 0.0, -0.5)):
        axes = figure.add_subplot(1, 4, column + 1, projection="polar")
        seen = ~ai_sight.out_of_view(np.sin(angles), np.cos(angles), fov)
        axes.fill_between(angles, 0, seen.astype(float), alpha=0.4, linewidth=0)
        axes.set_theta_zero_location("N")
        axes.set_theta_direction(-1)
        axes.set(title=f"fov {fov}", yticks=[], xticks=np.radians(range(0, 360, 45)))


PLOTS: dict[str, tuple[Callable[[Any], None], tuple[float, float]]] = {
    "colour.svg": (draw_colour, (9.0, 2.8)),
    "light.svg": (draw_light, (7.0, 2.8)),
    "particles.svg": (draw_particles, (9.0, 5.6)),
    "ai_sight.svg": (draw_sight, (9.0, 2.6)),
}


def draw(into: Path) -> list[Path]:
    """Write every plot into a folder and list them."""
    import matplotlib as mpl  # noqa: PLC0415 - half a second, and only plots need it
    from matplotlib.figure import Figure  # noqa: PLC0415 - as above

    into.mkdir(parents=True, exist_ok=True)
    for name, (plot, size) in PLOTS.items():
        with mpl.rc_context(STYLE):
            figure = Figure(figsize=size)
            plot(figure)
            figure.savefig(into / name, format="svg", metadata={"Date": None, "Creator": None})
    return [into / name for name in PLOTS]


def main() -> None:
    """The command line."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--into", type=Path, default=ROOT / "docs/engine")
    for path in draw(arguments.parse_args().into):
        print(path)


if __name__ == "__main__":
    main()
