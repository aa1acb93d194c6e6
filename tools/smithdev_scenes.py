"""Draw docs/smithdev.md's pictures of colour, light, particles and sight: `python -m tools.smithdev_scenes [FOLDER]`.

What is drawn is what the compiled level holds. Same matplotlib, same bytes.
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from fixtures.smithdev.chambers.colour_room import REGIONS, effect
from fixtures.smithdev.chambers.orientation_room import ORIENTS
from fixtures.smithdev.palette import nearest
from jktools.engine import light, orientation, particles
from jktools.engine.framebuffer import quantise
from jktools.engine.orientation import Creation
from jktools.engine.particle_template import ParticleTemplate
from jktools.engine.sight import ADJOIN_VISIBLE
from jktools.facts.sights import sights
from tools.smithdev_pictures import FOLDER, HANDLE, STYLE, compiled, level

ROOT = Path(__file__).resolve().parents[1]
GOLDEN: dict[str, Any] = tomllib.loads((ROOT / "tests/engine/golden.toml").read_text("utf-8"))

EFFECTS = {
    "none": effect(), "add 220": effect(add=(220, 220, 220)), "add 145 yellow": effect(add=(145, 145, 0)),
    "tint 1 red": effect(tint=(1, 0, 0)), "tint 2 red": effect(tint=(2, 0, 0)), "filter 1 0 1": effect((1, 0, 1)),
    "brightness 0.5": effect(brightness=0.5), "yellow, 0.25": effect(add=(145, 145, 0), brightness=0.25),
    "red filter, 0.5": effect((1, 0, 0), brightness=0.5),
    "red tint, 0.5": effect(tint=(2, 0, 0), brightness=0.5),
}  # fmt: skip


def colours(axes: Axes) -> None:
    """The test texture under some of the effects, on a screen of 5, 6 and 5 bits."""
    held = compiled().colour_effects
    assert held is not None
    for i, (name, wanted) in enumerate(EFFECTS.items()):
        row = int(np.flatnonzero((np.abs(held.argument - np.array(wanted)) < 1e-6).all(axis=1))[0])
        after = quantise(np.asarray(held.palette[row], np.float64).reshape(256, 3)) / 255
        left, top = i % 5 * 4, -(i // 5) * 5.5
        for y, line in enumerate(REGIONS):
            for x, color in enumerate(line):
                axes.add_patch(Rectangle((left + x, top - y), 1, 1, facecolor=after[nearest(color)]))
        axes.add_patch(Rectangle((left, top - 3), 3, 4, fill=False, edgecolor="0.5", linewidth=0.5))
        axes.text(left + 1.5, top - 3.3, name, ha="center", va="top")
    axes.set_xlim(-0.5, 19.5)
    axes.set_ylim(-10, 1.5)
    axes.set_aspect("equal")
    axes.set_axis_off()


def lights(axes: Axes) -> None:
    """The pixel at the middle of each target of the three tunnels, and what the document read."""
    for value, targets in HANDLE["light_test_bed"]["about"]["tunnels"].items():
        away = 0.1 + 0.2 * np.arange(len(targets))
        axes.plot(away, [_pixel(target, f"lamp {value}") for target in targets], ".-", label=f"light {value}")
    table = GOLDEN["dynamic_light"]["distance"][0]
    axes.plot(table["distance_corrected"], table["pixel"], "kx", label="Table 17, light 1.0")
    axes.set_xlabel("JKU from the light to the target's middle")
    axes.set_ylabel("pixel, 0 to 255")
    axes.legend()
    axes.grid(alpha=0.3)


def _pixel(target: str, lamp: str) -> int:
    c = compiled()
    assert c.lights is not None
    (surface,) = HANDLE["light_test_bed"]["surfaces"][target]
    row = int(np.flatnonzero(c.lights.thing == HANDLE["light_test_bed"]["things"][lamp])[0])
    lit = dict(
        zip(
            c.lights.vertex[slice(*c.lights.vertex_start[row : row + 2])].tolist(),
            c.lights.amount[slice(*c.lights.vertex_start[row : row + 2])].tolist(),
            strict=True,
        )
    )
    corners = c.corner_vertex[slice(*c.surface_corner_start[surface : surface + 2])].tolist()
    drawn = light.surface_brightness(0.0, 0.0, [lit.get(corner, 0.0) for corner in corners], 0.0)
    return int(light.pixel(drawn.mean()))


SHAPES = {
    "wide": "range 0.1", "shell": "minsize 0.09\nrange 0.11", "slice": "and 35 degrees\nto each side",
    "band": "pitch 5, yaw 170:\na gap behind", "pitch_thin": "pitch 0.1,\nall around",
    "expand": "typeflag 0x01: at once,\nand after 0.5 s",
}  # fmt: skip
WIDTH = 0.34
"""JKU from one cloud to the next."""


def shapes(axes: Axes) -> None:
    """Clouds from the front and a little from above, as they are created; the last one half a second later, too."""
    turns = np.radians(np.arange(361))
    for place, (name, said) in enumerate(SHAPES.items()):
        # What has grown takes more room.
        i = place + 0.3 * (name == "expand")
        template = _cloud(name)
        track = particles.simulate(template, seconds=0.5)
        for frame, color in ((0, "tab:blue"), *(((-1, "tab:orange"),) if name == "expand" else ())):
            places = track.positions[frame]
            x, y = places[:, 0], places[:, 2] + 0.3 * places[:, 1]
            axes.scatter(x + WIDTH * i, y, s=3, c=color, linewidths=0)
        for radius in {template.minsize, template.range} - {0.0}:
            axes.plot(radius * np.cos(turns) + WIDTH * i, radius * np.sin(turns), color="0.8", linewidth=0.5, zorder=0)
        axes.text(WIDTH * i, -0.24, name, ha="center", va="top", weight="bold")
        axes.text(WIDTH * i, -0.275, said, ha="center", va="top", fontsize=7, color="0.3")
    axes.plot([-0.15, -0.05], [0.2, 0.2], color="0.2", linewidth=1.5)
    axes.text(-0.1, 0.21, "0.1 JKU", ha="center", va="bottom", fontsize=7)
    axes.set_aspect("equal")
    axes.set_ylim(-0.34, 0.25)
    axes.set_axis_off()


def fades(axes: Axes) -> None:
    """How many particles are left: without 0x08, and with it at three rates."""
    for name in ("lasting", "fading", "fading_rate_0", "fading_rate_128"):
        track = particles.simulate(_cloud(name), seconds=9)
        axes.plot(track.times, track.alive.sum(axis=1), "--" if name == "fading_rate_0" else "-", label=name)
    axes.axvline(1, color="0.6", linewidth=0.6, linestyle=":")
    axes.text(1.05, 131, "the timer ends", fontsize=7, color="0.3", va="bottom")
    axes.set_ylim(-6, 142)
    axes.set_xlabel("seconds")
    axes.set_ylabel("particles")
    axes.legend(title="+partest_...")
    axes.grid(alpha=0.3)


def _cloud(variant: str) -> ParticleTemplate:
    c = compiled()
    assert c.particles is not None and c.templates is not None
    names = {int(s): c.strings[n] for s, n in zip(c.templates.source, c.templates.name, strict=True)}
    wanted = HANDLE["particle_room"]["about"]["variants"][variant]
    row = next(i for i, source in enumerate(c.particles.template) if names[int(source)] == wanted)
    held = c.particles
    shape = {key: float(getattr(held, key)[row]) for key in ("range", "minsize", "maxthrust", "pitchrange", "yawrange")}
    return ParticleTemplate(
        count=int(held.spawned[row]), timer=int(held.timer_ms[row]) / 1000, typeflags=int(held.flags[row]),
        rate=10.0 * int(held.lost_a_step[row]), cels=int(held.cels[row]), **shape,
    )  # fmt: skip


EYES = 0.5
"""JKU: the height at which walls are shown."""
VIEWS = {"visible": ("tab:green", "-"), "not visible": ("tab:red", ":")}


def sight(axes: Axes) -> None:
    """The sight room from above: each lookout's line, by what HasLOS answers in the profile `research`."""
    c, held = compiled(), HANDLE["sight_room"]
    assert c.things is not None
    place = dict(zip(c.things.source.tolist(), c.things.position, strict=True))
    cases = held["about"]["cases"]
    pairs = [(held["things"][ends["looker"]], held["things"][ends["target"]]) for ends in cases.values()]
    origin, ahead = np.array(place[pairs[0][0]][:2]), np.array(place[pairs[0][1]][:2])
    forward = (ahead - origin) / np.linalg.norm(ahead - origin)
    frame = np.array([[forward[1], -forward[0]], forward])
    for sector in held["sectors"].values():
        first = int(c.sector_first_surface[sector])
        for surface in range(first, first + int(c.sector_surface_count[sector])):
            ring = c.vertices[c.corner_vertex[slice(*c.surface_corner_start[surface : surface + 2])]]
            adjoin = c.surface_adjoin[surface]
            seen_through = adjoin >= 0 and c.adjoin_flags[adjoin] & ADJOIN_VISIBLE
            if ring[:, 2].min() < EYES < ring[:, 2].max() and not seen_through:
                flat = (ring[:, :2] - origin) @ frame.T
                axes.plot(flat[:, 0], flat[:, 1], color="0.3" if adjoin < 0 else "tab:purple", linewidth=1)
    for name, (a, b), verdict in zip(cases, pairs, sights(level(), pairs), strict=True):
        ends = (np.array([place[a][:2], place[b][:2]]) - origin) @ frame.T
        color, style = VIEWS[str(verdict)]
        axes.plot(ends[:, 0], ends[:, 1], style, color=color)
        axes.text(ends[1, 0] - 0.08, ends[1, 1] - 0.1, name, rotation=90, ha="right", va="center", fontsize=7)
        between = held["things"].get(f"between {name}")
        if between is not None:
            x, y = (np.array(place[between][:2]) - origin) @ frame.T
            axes.plot(x, y, "s", color="0.4", markersize=5)
    for i in range(held["about"]["lamps"]):
        x, y = (np.array(place[held["things"][f"lamp {i}"]][:2]) - origin) @ frame.T
        axes.plot(x, y, "*", color="tab:orange", markersize=5)
    for answer, (color, style) in VIEWS.items():
        axes.plot([], [], style, color=color, label=answer)
    axes.plot([], [], "*", color="tab:orange", label="swing lamp")
    axes.plot([], [], color="tab:purple", label="adjoin without the visible flag")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4)
    axes.set_aspect("equal")
    axes.set_axis_off()


TITLES = {
    "placed": "placed by the level\nat {}", "ghost at 0": "created on a ghost\nat {}",
    "ghost at 45": "created on a ghost\nat {}", "ghost at 45, NR": "the same\nby CreateThingNR",
}  # fmt: skip
COLUMNS = (("placed", Creation.PLACED), ("ghost at 0", Creation.CREATE_THING), ("ghost at 45", Creation.CREATE_THING),
           ("ghost at 45, NR", Creation.CREATE_THING_NR))  # fmt: skip
BARREL = np.array([[0, -1.0, 0], [0, 1.0, 0]])
SCOPE = np.array([[0, 0, 0], [0, 0, 0.5]])


def triplet(angles: Iterable[float]) -> str:
    """Pitch, yaw and roll as the level's own text has them."""
    return "/".join(f"{angle:g}" for angle in angles)


def strifles(axes: Axes) -> None:
    """The strifles' barrels (with a dot at the muzzle) and what points up, seen from behind and above."""
    c, held = compiled(), HANDLE["orientation_room"]
    assert c.things is not None and c.templates is not None
    angles = dict(zip(c.things.source.tolist(), np.asarray(c.things.angles, np.float64), strict=True))
    for x, (name, how) in enumerate(COLUMNS):
        for y, row in enumerate(ORIENTS):
            own = angles[held["things"][f"{name} {y}"]]
            look = orientation.created(how, ORIENTS[row], placed=own, spawner=orientation.matrix(own))
            for part, color in ((BARREL, "tab:blue"), (SCOPE, "tab:red")):
                points = part @ look.T
                flat = np.stack([points[:, 0] + 3 * x, points[:, 2] + 0.5 * points[:, 1] - 2.2 * y], axis=1)
                axes.plot(flat[:, 0], flat[:, 1], color=color, linewidth=2)
                if color == "tab:blue":
                    axes.plot(*flat[1], "o", color=color, markersize=4)
        axes.text(3 * x, 1.4, TITLES[name].format(triplet(own)), ha="center")
    for y, row in enumerate(ORIENTS):
        axes.text(-1.6, -2.2 * y, f"orient={triplet(ORIENTS[row])}", ha="right", va="center")
    axes.plot([], [], "o-", color="tab:blue", markersize=4, label="barrel and muzzle")
    axes.plot([], [], color="tab:red", label="its up")
    axes.legend(loc="upper center", bbox_to_anchor=(0.55, 0.02), ncols=2, frameon=False)
    axes.set_xlim(-3.6, 10.5)
    axes.set_ylim(-5.6, 2.5)
    axes.set_aspect("equal")
    axes.set_axis_off()


PICTURES: dict[str, tuple[Callable[[Axes], None], tuple[float, float]]] = {
    "strifles.svg": (strifles, (6.5, 4.0)),
    "colours.svg": (colours, (8.0, 4.4)),
    "lights.svg": (lights, (6.5, 3.0)),
    "shapes.svg": (shapes, (8.6, 2.6)),
    "fades.svg": (fades, (6.5, 2.8)),
    "sight.svg": (sight, (8.0, 4.2)),
}


def main(folder: Path = FOLDER) -> None:
    """Draw every picture."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, (draw, size) in PICTURES.items():
        with mpl.rc_context(STYLE):
            figure = Figure(figsize=size, layout="constrained")
            draw(figure.add_subplot())
            FigureCanvasSVG(figure).print_svg(str(folder / name), metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
