"""The picture of docs/floors.md: what a height between two floors is to the player. `python -m tools.floor_plot`."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt

from jktools.engine.body import WALKPLAYER
from jktools.engine.profile import Engine
from jktools.facts.bodies import Walker
from jktools.facts.ledges import Limits

TARGET = Path(__file__).resolve().parent.parent / "docs/floors.svg"
COLOURS = {"fall": "#d95f5f", "seamless": "#8fc98f", "step": "#c8e6c8", "lip": "#f2d98d", "jump": "#8fb7e0", "wall": "#777777"}  # noqa: E501  # fmt: skip


def main() -> None:
    """Draw a row of floors beside the one at 0, each at the middle of a band."""
    limits = Limits.of(Walker(WALKPLAYER, hovers=True, gravity=4.0, names=("walkplayer",)), Engine.RESEARCH)
    bands = {
        "fall": (-0.32, -limits.reattach), "seamless": (-limits.reattach, 0.0), "step": (0.0, limits.clearance),
        "lip": (limits.clearance, limits.hover), "jump": (limits.hover, limits.jump), "wall": (limits.jump, 0.45),
    }  # fmt: skip
    mpl.use("svg")
    mpl.rcParams["svg.hashsalt"] = "jktools"
    figure, axes = plt.subplots(figsize=(8, 4))
    for i, (name, (low, high)) in enumerate(bands.items()):
        axes.axhspan(low, high, color=COLOURS[name], alpha=0.35)
        height = (low + high) / 2
        axes.plot([i + 0.6, i + 1.4], [height, height], "k", linewidth=2)
        axes.text(i + 1, height + 0.008, name, ha="center")
    axes.plot([-1.4, 0.4], [0, 0], "k", linewidth=2)
    middle, radius, turn = -0.6, WALKPLAYER.movesize, np.linspace(0, 2 * np.pi, 60)
    axes.plot(middle + 3 * radius * np.cos(turn), limits.hover + radius * np.sin(turn), "k", linewidth=1)
    axes.plot([middle, middle], [0, limits.hover], "k:", linewidth=1)
    axes.text(middle + 0.05, limits.hover / 3, f"{limits.hover:.6g}", fontsize=8)
    for value in (-limits.reattach, limits.clearance, limits.hover, limits.jump):
        axes.text(6.6, value, f"{value:.6g}", va="center", fontsize=8)
    axes.set(xlim=(-1.5, 6.5), ylim=(-0.32, 0.45), xticks=[], ylabel="JKU over the floor", title="walkplayer, research")
    figure.savefig(TARGET, metadata={"Date": None})


if __name__ == "__main__":
    main()
