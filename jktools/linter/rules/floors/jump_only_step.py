"""JK704: a step that only a jump climbs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level

EVEN = 1e-3
WIDTH = 0.2
"""JKU: shorter edges are not what bodies go up by."""


@rule("JK704", "jump-only-step", severity=Severity.INFO, since="0.1.0", on=False)
def jump_only_step(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a step up that is too high to walk, and low enough to jump.

    ## Why it matters
    Players expect stairs to be walked, and actors do not jump: they stay below. On a crate or a ledge it is meant. How
    high a step is walked up at any frame rate is simulated: some 0.07 JKU for the player, higher ones on slow machines.

    ## Bad
        World vertices 14
        8: 1 2 -.2
        9: 0 2 -.2
        12: 0 1 -.2
        13: 1 1 -.2
        World surfaces 13
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        Normals
        12: 0 1 0
        Sector 1
        Surfaces 6 7
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5

    ## Good
        World vertices 14
        8: 1 2 -.05
        9: 0 2 -.05
        12: 0 1 -.05
        13: 1 1 -.05
        World surfaces 13
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        Normals
        12: 0 1 0
        Sector 1
        Surfaces 6 7
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5
    """
    for ledges in facts.player_ledges:
        even = ledges.spread() <= EVEN
        between = ledges.of_level & (ledges.below >= 0)
        rises = between & (ledges.kind == Kind.JUMP) & even & (ledges.deepest < 0) & (ledges.length >= WIDTH)
        for row in np.flatnonzero(rises).tolist():
            rise, lip = told_apart(-float(ledges.deepest[row]), ledges.walker.lip(ledges.engine), 4)
            surface = level.surfaces[int(ledges.surface[row])]
            yield Finding(
                Label(surface.head_span),
                f"surface {ledges.below[row]} is {rise} JKU above {surface.title}, but "
                f"{ledges.walker.title} surely walks up no more than {lip} JKU",
                "make it lower where it should be walked",
                surface.subject,
            )
