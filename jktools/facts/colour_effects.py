"""What the colour effects of a level's scripts make of its colours.

Each call of NewColorEffect whose ten arguments are known, on each colormap of the level that is at hand: the palette
that the screen then shows, one effect at a time.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from jktools.engine.arrays import UInt8
from jktools.engine.colour import lookup_table
from jktools.engine.colour_effect import ColourEffect
from jktools.engine.framebuffer import Depth
from jktools.engine.palette import under_effect
from jktools.engine.profile import Engine
from jktools.facts.cog.rates import Site
from jktools.facts.hotspots import Runner
from jktools.model import Level
from jktools.model.resources import Kind
from jktools.source import InputError
from jktools.syntax.assets.colormap import read_colormap

VERB = "newcoloreffect"
WHITE = 255


class ConstantEffect(NamedTuple):
    """One call whose arguments are known."""

    runner: Runner
    site: Site
    effect: ColourEffect


class Shown(NamedTuple):
    """An effect on a palette."""

    colormap: int
    """In the level's list; -1 for the ramp of all levels, where no colormap is at hand."""
    before: UInt8
    """(256, 3)."""
    after: UInt8
    """(256, 3)."""

    @property
    def is_black(self) -> bool:
        """Whether nothing is left to see."""
        return not self.after.any()

    @property
    def is_white(self) -> bool:
        """Whether every colour becomes white."""
        return bool((self.after == WHITE).all())

    @property
    def is_one_colour(self) -> bool:
        """Whether every colour becomes the same."""
        return bool((self.after == self.after[0]).all())


def constant_effects(runners: Iterable[Runner]) -> list[ConstantEffect]:
    """The calls that can run and whose arguments are all known."""
    found = []
    for runner in runners:
        for site in runner.analysis.rates.sites:
            if site.verb.name != VERB or len(site.call.arguments) != len(site.verb.args):
                continue
            numbers = [argument.number for argument in site.arguments]
            known = [number for number in numbers if number is not None]
            if len(known) == len(site.verb.args):
                found.append(ConstantEffect(runner, site, ColourEffect.from_call(known)))
    return found


def palettes(level: Level) -> list[tuple[int, UInt8]]:
    """The palettes of the level's colormaps that are at hand, by their place in the list."""
    found = []
    for index, name in enumerate(level.colormaps):
        file = level.resources.find(Kind.COLORMAP, name)
        if file is None:
            continue
        try:
            colormap = read_colormap(level.resources.read(file))
        except InputError:
            continue
        if not colormap.diagnostics:
            found.append((index, colormap.palette))
    return found


def shown(effect: ColourEffect, known: list[tuple[int, UInt8]], engine: Engine = Engine.RESEARCH) -> list[Shown]:
    """An effect on each palette; on the ramp of all levels of all channels where there is none."""
    if not known:
        ramp = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
        return [Shown(-1, ramp, lookup_table(effect, engine, depth=Depth.RGB888))]
    return [Shown(index, palette, under_effect(palette, effect, engine)) for index, palette in known]
