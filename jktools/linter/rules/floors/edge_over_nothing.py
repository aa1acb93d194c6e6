"""JK705: the edge of a floor with nothing below."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind
from jktools.linter.rule import Finding, rule
from jktools.model import Level

SHORTEST = 0.05
"""JKU: narrower openings let no body through."""


@rule("JK705", "edge-over-nothing", severity=Severity.WARNING, since="0.1.0")
def edge_over_nothing(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a floor from which a player walks to where nothing lies below, down to the end of the level.

    ## Why it matters
    The way down ends in no surface at all: a sector is open, or a surface there has neither an adjoin nor the collision
    flag 0x4. Who goes there falls out of the level.

    ## Bad
        World surfaces 12
        6: 0 0x1 0x4 4 3 1 -1 0 4 3,0 2,1 8,2 9,3 1 1 1 1
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f

    ## Good
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f
    """
    for ledges in facts.player_ledges:
        open_below = ledges.of_level & (ledges.kind == Kind.NONE) & (ledges.below < 0) & ~ledges.narrow
        lengths: dict[int, float] = defaultdict(float)
        for row in np.flatnonzero(open_below).tolist():
            lengths[int(ledges.surface[row])] += float(ledges.length[row])
        for index, length in lengths.items():
            if length < SHORTEST:
                continue
            surface = level.surfaces[index]
            yield Finding(
                Label(surface.head_span),
                f"{surface.title} is a floor, but nothing lies below along {length:.4g} JKU of its edges",
                "close the sector beyond it, or give the surface there collision (0x4)",
                surface.subject,
            )
