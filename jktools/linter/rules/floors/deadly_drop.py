"""JK707: an edge from which the fall kills."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.engine.flags import SurfaceFlag
from jktools.facts import LevelFacts
from jktools.facts.bodies import FULL_HEALTH
from jktools.facts.ledges import Kind
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level

SHORTEST = 0.05
"""JKU: shorter pieces of an edge are not what bodies fall from."""


@rule("JK707", "deadly-drop", severity=Severity.INFO, since="0.1.0", on=False)
def deadly_drop(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a floor from whose edge a player falls so deep that the landing costs all of 100 points of health.

    ## Why it matters
    Most such drops are meant; one that is not shows here. What counts is the speed at the floor below: (speed - 2.5)
    squared times 45, unless that floor is flagged against it (0x80).

    ## Bad
        World vertices 14
        8: 1 2 -5
        9: 0 2 -5
        12: 0 1 -5
        13: 1 1 -5
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
        8: 1 2 -5
        9: 0 2 -5
        12: 0 1 -5
        13: 1 1 -5
        World surfaces 13
        6: 0 0x85 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
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
        deadly = ledges.walker.deadly_drop()
        flags = np.append(level.document.surfaces.flags, 0)[ledges.below]
        hard = (flags & SurfaceFlag.NO_FALL_DAMAGE) == 0
        wide = ~ledges.narrow & (ledges.length >= SHORTEST)
        kills = ledges.of_level & wide & (ledges.kind == Kind.FALL) & hard & (ledges.deepest >= deadly)
        for index in sorted(set(ledges.surface[kills].tolist())):
            rows = np.flatnonzero(kills & (ledges.surface == index))
            surface = level.surfaces[index]
            drop, least = told_apart(float(ledges.deepest[rows].max()), deadly, 4)
            yield Finding(
                Label(surface.head_span),
                f"{surface.title} ends {drop} JKU above the floor below, but a fall of "
                f"{least} JKU costs {ledges.walker.title} {FULL_HEALTH:g} points of health",
                "where it is not meant, make it lower, or flag the floor below against such damage (0x80)",
                surface.subject,
            )
