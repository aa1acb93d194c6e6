"""Draw the pictures of docs/smithdev.md: `python -m tools.smithdev_pictures [FOLDER]`. Same matplotlib, same bytes.

What is drawn is what the compiled level holds, and what `jktools trace` does in it.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

import jktools
from fixtures.smithdev.pack import GOB, HANDLES
from jktools.engine.simulation import History
from jktools.facts.ledges import Kind
from jktools.trace.in_level import body_named, start_at, trace_in_level

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "smithdev"
STYLE = {"svg.hashsalt": "jktools", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 8}
HANDLE: dict[str, Any] = json.loads(HANDLES.read_text("ascii"))
MOVEMENT = 0x2
CUT = 21
"""JKU along y at which the plan ends: the hallway is longer."""
SHOWN = {Kind.SEAMLESS: "tab:green", Kind.FALL: "tab:red"}


@cache
def level() -> jktools.Level:
    """The level."""
    return jktools.load(f"{GOB}!jkl/smithdev.jkl")


@cache
def compiled() -> jktools.CompiledLevel:
    """The same, compiled."""
    return jktools.CompiledLevel(jktools.build(level()))


def plan(axes: Axes) -> None:
    """The level from above: floors by height, solid walls, a name over each chamber."""
    c = compiled()
    up = c.surface_normal[:, 2] > 0.5
    rings = [_ring(i) for i in np.flatnonzero(up)]
    heights = [float(ring[:, 2].mean()) for ring in rings]
    order = np.argsort(heights)
    faces = PolyCollection([rings[i][:, :2] for i in order], cmap="Blues_r", edgecolors="none")
    faces.set_clim(-6, 1)
    faces.set_array(np.array(heights)[order])
    axes.add_collection(faces)
    axes.add_collection(LineCollection(_walls(), colors="0.2", linewidths=0.4))
    for name, held in HANDLE.items():
        sectors = list(held["sectors"].values())
        if name in ("east", "west"):
            continue
        box = c.sector_bound_box[sectors]
        x, low, high = box[:, [0, 3]].mean(), box[:, 1].min(), box[:, 4].max()
        if name == "hub":
            axes.text(x, 1.5, name, ha="center", va="center")
            axes.plot(x, 0, "o", color="tab:red", markersize=3)
            axes.text(x, -0.5, "start", ha="center", va="top", fontsize=6)
        elif high > CUT:
            axes.text(
                x, CUT - 0.5, f"{name.replace('_', ' ')} (goes on to {high:g})", ha="center", va="top", rotation=90
            )
        else:
            north = low >= 0
            y, align = (high + 0.5, "bottom") if north else (low - 0.5, "top")
            axes.text(x, y, name.replace("_", " "), ha="center", va=align, rotation=90)
    axes.set_xlim(c.sector_bound_box[:, 0].min() - 1, c.sector_bound_box[:, 3].max() + 1)
    axes.set_ylim(c.sector_bound_box[:, 1].min() - 6, CUT)
    axes.set_aspect("equal")
    axes.set_xlabel("x, JKU")
    axes.set_ylabel("y, JKU")
    bar = axes.figure.colorbar(faces, ax=axes, fraction=0.02, pad=0.02)
    bar.set_label("floor height, JKU")


def pits(axes: Axes) -> None:
    """The pit rows from above: each rim as the ledge pass judges it for the actor of its row, depth in the pit."""
    c = compiled()
    for name, (surface, *_) in HANDLE["pit_rows"]["surfaces"].items():
        if name.endswith(".floor"):
            ring = _ring(surface)
            axes.fill(ring[:, 0], ring[:, 1], facecolor="0.93", edgecolor="0.6", linewidth=0.5)
    for row in HANDLE["pit_rows"]["about"]["rows"]:
        ring = _ring(HANDLE["pit_rows"]["surfaces"][f"walk {row['insert_offset']}.floor"][0])
        axes.text(
            ring[:, 0].mean(), ring[:, 1].mean(), f"insert offset {row['insert_offset']}", ha="center", va="center"
        )
    for name, (surface, *_) in HANDLE["pit_rows"]["surfaces"].items():
        if name.endswith(".floor") and name.startswith(("door", "trap", "stair")):
            middle = _ring(surface).mean(axis=0)
            axes.text(
                middle[0],
                middle[1],
                name.split(".")[0].split(" ")[0],
                ha="center",
                va="center",
                fontsize=6,
                color="0.4",
            )
    for pit in HANDLE["pit_rows"]["about"]["pits"]:
        walk, bottom = (HANDLE["pit_rows"]["surfaces"][f"{pit[key]}.floor"][0] for key in ("walk", "pit"))
        assert c.ledges is not None
        first, last = c.ledges.body_ledge_start[_body(pit["template"]) :][:2]
        rows = np.arange(first, last)
        (found,) = rows[(c.ledges.surface[rows] == walk) & (c.ledges.below[rows] == bottom)]
        ring, corner = _ring(walk), int(c.ledges.corner[found])
        edge = ring[[corner, (corner + 1) % len(ring)]]
        axes.plot(edge[:, 0], edge[:, 1], color=SHOWN[Kind(c.ledges.kind[found])], linewidth=3)
        middle = _ring(bottom).mean(axis=0)
        axes.text(middle[0], middle[1], pit["depth"], ha="center", va="center", fontsize=6)
    for kind, color in SHOWN.items():
        axes.plot([], [], color=color, linewidth=3, label=kind.name.lower())
    axes.legend(
        loc="lower right", bbox_to_anchor=(1, 1), ncols=2, title="the rim, by the ledge pass; numbers are depths in JKU"
    )
    axes.set_aspect("equal")
    axes.set_axis_off()


def changeover(axes: Axes) -> None:
    """Two walks, over pits of 0.1851 and 0.1852, and a slow one over 0.11 that shows the bump."""
    for depth, maxthrust, style in (("0.1851", None, "-"), ("0.1852", None, "-"), ("0.11", 0.6, "--")):
        walk = _walk(f"pit_rows/before 0.120114 {depth}", "0 walk forward\n5 end", "pit_kyle", maxthrust)
        ahead = np.abs(walk.position[:, 1] - walk.position[0, 1]) - 0.5
        shown = (ahead > -0.05) & (ahead < 0.35)
        name = f"pit {depth}" + (" at 0.2 JKU/s" if maxthrust else "")
        (line,) = axes.plot(ahead[shown], walk.position[shown, 2], style, label=name)
        flies = shown & ~walk.attached
        axes.plot(ahead[flies], walk.position[flies, 2], ".", color="tab:red", markersize=3)
        if maxthrust:
            turn = int(np.argmin(np.abs(ahead - 0.026)))
            axes.annotate(
                "the bump", (ahead[turn], walk.position[turn, 2]), (-0.02, 0.02), fontsize=7,
                arrowprops={"arrowstyle": "-", "color": line.get_color()},
            )  # fmt: skip
    axes.plot([], [], ".", color="tab:red", label="in the air")
    axes.axvline(0, color="0.5", linewidth=0.6)
    axes.set_xlabel("JKU past the rim")
    axes.set_ylabel("height over the walkway, JKU")
    axes.legend()
    axes.grid(alpha=0.3)


def hallway(axes: Axes) -> None:
    """Drawings 1 and 3, and a lane of ice: the player walks for 7 s in four lanes, and lets go of the key."""
    for lane in ("floor", "no floor", "icy", "shallow water"):
        walk = _walk(f"velocity_hallway/start of {lane}", "0 walk forward\n7 release\n12 end", "walkplayer", None)
        style = "--" if lane == "shallow water" else "-"
        axes.plot(walk.time, np.linalg.norm(walk.velocity, axis=1), style, label=lane)
    for speed, said in ((0.65, "Drawing 1: 0.65"), (1.2, "Drawing 3: 1.2"), (0.3, "static drag 0.3")):
        axes.axhline(speed, color="0.5", linewidth=0.6, linestyle=":")
        axes.text(12.1, speed, said, fontsize=7, color="0.3", ha="right", va="bottom")
    axes.set_xlabel("seconds")
    axes.set_ylabel("velocity, JKU/s")
    axes.set_ylim(-0.05, 1.3)
    axes.legend(loc="lower center", bbox_to_anchor=(0.36, 0.08))
    axes.grid(alpha=0.3)


def stairs(axes: Axes) -> None:
    """The steep flight at a walk and at a run: the body sinks at 0.5 JKU/s, so at a run it lets go."""
    c = compiled()
    for name, (surface, *_) in HANDLE["walkway"]["surfaces"].items():
        if name.endswith(".floor") and (name.startswith("steep") or name in ("rest.floor", "end.floor")):
            ring = _ring(surface)
            axes.fill_between([ring[:, 0].min(), ring[:, 0].max()], ring[0, 2], -4.75, color="0.85", linewidth=0)
            axes.plot([ring[:, 0].max(), ring[:, 0].min()], [ring[0, 2]] * 2, color="0.4", linewidth=1.5)
    assert c.ledges is not None
    for gait in ("walk", "run"):
        walk = _walk("walkway/walks the steep flight", f"0 {gait} forward\n5 end", "walkplayer", None)
        held = walk.attached
        axes.plot(walk.position[:, 0], walk.position[:, 2], label=gait, linewidth=1.2)
        axes.plot(walk.position[~held, 0], walk.position[~held, 2], ".", color="tab:red", markersize=2)
    axes.plot([], [], ".", color="tab:red", label="in the air")
    axes.set_ylim(-4.75, -3.2)
    axes.set_xlabel("x, JKU")
    axes.set_ylabel("height of the body, JKU")
    axes.invert_xaxis()
    axes.legend()
    axes.grid(alpha=0.3)


PICTURES: dict[str, tuple[Callable[[Axes], None], tuple[float, float]]] = {
    "plan.svg": (plan, (11.0, 5.6)),
    "pits.svg": (pits, (6.0, 6.5)),
    "changeover.svg": (changeover, (7.0, 2.8)),
    "hallway.svg": (hallway, (7.0, 2.8)),
    "stairs.svg": (stairs, (7.0, 2.8)),
}


def _ring(surface: int) -> Any:
    """The corners of a surface, (n, 3)."""
    c = compiled()
    return c.vertices[c.corner_vertex[c.surface_corner_start[surface] : c.surface_corner_start[surface + 1]]]


def _walls() -> list[Any]:
    """The edges of solid upright surfaces, seen from above."""
    c = compiled()
    open_ = (c.surface_adjoin >= 0) & (c.adjoin_flags[np.maximum(c.surface_adjoin, 0)] & MOVEMENT > 0)
    upright = np.flatnonzero((np.abs(c.surface_normal[:, 2]) < 0.5) & ~open_)
    lines = []
    for surface in upright:
        flat = _ring(surface)[:, :2]
        far = np.linalg.norm(flat - flat[0], axis=1).argmax()
        lines.append(flat[[0, far]])
    return lines


def _body(template: str) -> int:
    ledges, strings = compiled().ledges, compiled().strings
    assert ledges is not None
    for body in range(len(ledges.body_movesize)):
        names = ledges.body_name[ledges.body_name_start[body] : ledges.body_name_start[body + 1]]
        if template in {strings[name] for name in names}:
            return body
    raise KeyError(template)


def _walk(start: str, script: str, template: str, maxthrust: float | None) -> History:
    chamber, _, thing = start.partition("/")
    body = body_named(level(), template)
    if maxthrust is not None:
        body = replace(body, maxthrust=maxthrust)
    return trace_in_level(script, level(), start_at(level(), str(HANDLE[chamber]["things"][thing])), body=body, fps=100)


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
