"""Plan views of findings on floors, to be judged by eye: `python -m tools.ledge_pictures OUT [--kind fall] [--most N]`.

One PNG a finding: the floors around it by height, the floor, its ledge in red and what lies below in blue, and beside
it the section straight through the ledge. Findings are chosen evenly over the levels of the corpus.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from benchmarks.sight_queries import levels
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind, Ledges
from jktools.geometry.drop import ABSENT, ground_of
from jktools.model import Level

AROUND = 1.5
"""JKU shown around the middle of a ledge."""
SHORTEST = 0.1


def draw(level: Level, ledges: Ledges, row: int, name: str, out: Path) -> None:
    """Draw one ledge from above and from the side."""
    figure, (plan, section) = plt.subplots(1, 2, figsize=(12, 6))
    here, there = (ends[0] for ends in ledges.edges.ends([ledges.edge[row]]))
    first, last = (here + (there - here) * part for part in (ledges.start[row], ledges.end[row]))
    middle = (first + last) / 2
    _plan(plan, level, ledges, row, middle)
    plan.plot(*np.array([first, last])[:, :2].T, "r-", linewidth=4)
    _section(section, level, middle, there - here)
    kind, other = Kind(ledges.kind[row]).name, Kind(ledges.other[row]).name
    figure.suptitle(
        f"{name}: surface {ledges.surface[row]} edge {ledges.corner[row]} to {ledges.below[row]}: {kind} ({other}), "
        f"drop {ledges.drop_start[row]:.3f} .. {ledges.drop_end[row]:.3f}, {ledges.length[row]:.2f} long at "
        f"{middle.round(2)}"
    )
    figure.savefig(out, dpi=60)
    plt.close(figure)


def _plan(axes: Axes, level: Level, ledges: Ledges, row: int, middle: np.ndarray) -> None:
    floors = np.flatnonzero(ledges.edges.floors).tolist()
    shapes = [level.surfaces[i].positions.astype(float) for i in floors]
    near = [
        i for i, s in enumerate(shapes)
        if (s[:, :2].min(0) < middle[:2] + AROUND).all() and (s[:, :2].max(0) > middle[:2] - AROUND).all()
        and abs(s[:, 2].mean() - middle[2]) < 2 * AROUND
    ]  # fmt: skip
    near.sort(key=lambda i: shapes[i][:, 2].max())
    heights = np.array([shapes[i][:, 2].mean() - middle[2] for i in near])
    colours = mpl.colormaps["terrain"](np.clip(heights / AROUND / 2 + 0.5, 0, 1))
    axes.add_collection(PolyCollection([shapes[i][:, :2] for i in near], facecolors=colours, edgecolors="k", alpha=0.8))
    for index, colour in ((int(ledges.surface[row]), "r"), (int(ledges.below[row]), "b")):
        if index >= 0:
            ring = level.surfaces[index].positions[:, :2]
            axes.plot(*np.vstack([ring, ring[:1]]).T, colour + "--", linewidth=2)
    axes.set(xlim=middle[0] + [-AROUND, AROUND], ylim=middle[1] + [-AROUND, AROUND], aspect="equal", title="from above")


def _section(axes: Axes, level: Level, middle: np.ndarray, along: np.ndarray) -> None:
    """All surfaces cut by the upright plane through the ledge's middle, out of the floor to the right."""
    out = np.array([along[1], -along[0], 0]) / np.hypot(*along[:2])
    side = np.array([-out[1], out[0], 0])
    passes = ground_of(level).passes_to
    for i in range(len(level.surfaces)):
        ring = level.surfaces[i].positions.astype(float) - middle
        off = ring @ side
        ahead = np.roll(off, -1)
        cut = np.flatnonzero((off < 0) != (ahead < 0))
        if len(cut) < 2:
            continue
        part = off[cut] / (off[cut] - ahead[cut])
        points = ring[cut] + (np.roll(ring, -1, axis=0)[cut] - ring[cut]) * part[:, None]
        flat = np.stack([points @ out, points[:, 2]], axis=1)
        style = "c:" if passes[i] >= 0 else "m-" if passes[i] == ABSENT else "k-"
        if level.surfaces[i].flags & 1 and passes[i] < 0:
            style = "g-"
        axes.plot(*flat.T, style)
    axes.plot([0], [0], "ro")
    axes.set(xlim=(-AROUND, AROUND), ylim=(-AROUND, AROUND), aspect="equal", title="section; green floors, dotted ways")


def main() -> None:
    """Draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--kind", default="fall", choices=[kind.name.lower() for kind in Kind])
    parser.add_argument("--most", type=int, default=50)
    arguments = parser.parse_args()
    mpl.use("Agg")
    arguments.out.mkdir(parents=True, exist_ok=True)
    found = []
    for name, level in levels():
        for ledges in LevelFacts(level).player_ledges:
            wanted = ledges.of_level & (ledges.kind == Kind[arguments.kind.upper()])
            wanted &= (ledges.length >= SHORTEST) & ~ledges.narrow
            found += [(name, level, ledges, row) for row in np.flatnonzero(wanted).tolist()]
    chosen = np.unique(np.linspace(0, len(found) - 1, min(arguments.most, len(found))).astype(int))
    for number, at in enumerate(chosen.tolist()):
        name, level, ledges, row = found[at]
        draw(level, ledges, row, name, arguments.out / f"{number:03}.png")
    print(f"{len(chosen)} of {len(found)} drawn in {arguments.out}")


if __name__ == "__main__":
    main()
