"""What the colour effects of a level's scripts make of its colours.

Each call of NewColorEffect whose ten arguments are known, on each colormap of the level that is at hand: the palette
that the screen then shows, one effect at a time.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from jktools.engine.arrays import UInt8
from jktools.engine.colour import Renderer, lookup_table
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
SCREEN_STEP = WHITE / 31
"""Of the 0 to 255 of a channel: one level of red or blue on the game's screen, RGB565. What lies closer is one to the
eye: black holds nothing above one step, white nothing below the last but one."""


class View(NamedTuple):
    """Whose word counts on what is seen."""

    engine: Engine
    renderer: Renderer
    title: str


VIEWS = (
    View(Engine.RESEARCH, Renderer.HARDWARE, "the research document"),
    View(Engine.OPENJKDF2, Renderer.HARDWARE, "the decompiled engine in hardware"),
    View(Engine.OPENJKDF2, Renderer.SOFTWARE, "the decompiled engine in software"),
)


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
    def hides(self) -> str | None:
        """What all colours become, to within one step of the screen: black, white or one colour.

        None where some can be told apart, and where none could be before.
        """
        return None if _as_one(self.before) else _as_one(self.after)


def _as_one(colours: UInt8) -> str | None:
    if colours.max() <= SCREEN_STEP:
        return "black"
    if colours.min() >= WHITE - SCREEN_STEP:
        return "white"
    spread = colours.max(axis=0).astype(np.float64) - colours.min(axis=0)
    return "one colour" if spread.max() <= SCREEN_STEP else None


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


def shown(
    effect: ColourEffect,
    known: list[tuple[int, UInt8]],
    engine: Engine = Engine.RESEARCH,
    renderer: Renderer = Renderer.SOFTWARE,
) -> list[Shown]:
    """An effect on each palette; on the ramp of all levels of all channels where there is none.

    In 8 bits a channel, as the palette is stored; the renderer matters to `openjkdf2` only.
    """
    if not known:
        ramp = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
        return [Shown(-1, ramp, lookup_table(effect, engine, renderer, Depth.RGB888))]
    return [Shown(index, palette, under_effect(palette, effect, engine, renderer)) for index, palette in known]


def hidden(effect: ColourEffect, known: list[tuple[int, UInt8]]) -> dict[View, str | None]:
    """What an effect makes of all that is seen, by who says so; None where something is left to tell apart.

    Of several palettes it has to hide all, and then the first tells the colour.
    """
    found: dict[View, str | None] = {}
    for view in VIEWS:
        hides = [each.hides for each in shown(effect, known, view.engine, view.renderer)]
        found[view] = hides[0] if all(hides) else None
    return found
