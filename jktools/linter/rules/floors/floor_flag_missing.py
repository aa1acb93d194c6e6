"""JK706: a surface between floors that bodies do not stick to."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind
from jktools.linter.rule import Finding, rule
from jktools.model import Level

FLUSH = 1e-3
"""JKU between the surface and a floor at its edge."""
LEAST_NORMAL_Z = 0.99
"""Steeper surfaces are slopes that may be left without the flag on purpose."""
SHORTEST = 0.1
"""JKU of each floor's edge along the surface."""


@rule("JK706", "floor-flag-missing", severity=Severity.WARNING, since="0.1.0")
def floor_flag_missing(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an almost level surface without the floor flag 0x1 that lies flush between two floors.

    ## Why it matters
    A body lets go of the floor when it walks onto such a surface: it falls by a hair, slides as on ice, cannot jump,
    and thrust has only 0.3 of its strength.

    ## Bad
        World vertices 16
        12: 0 1.5 0
        13: 1 1.5 0
        14: 0 1.2 0
        15: 1 1.2 0
        World surfaces 14
        6: 0 0x5 0x4 4 3 1 -1 0 4 3,0 2,1 15,2 14,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 14,0 15,1 13,2 12,3 1 1 1 1
        13: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        Normals
        12: 0 0 1
        13: 0 0 1
        Sector 1
        Surfaces 6 8
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f

    ## Good
        World surfaces 12
        6: 0 0x4 0x4 4 3 1 -1 0 4 3,0 2,1 8,2 9,3 1 1 1 1
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f
    """
    reported: set[int] = set()
    for ledges in facts.player_ledges:
        flush = (np.abs(ledges.drop_start) <= FLUSH) & (np.abs(ledges.drop_end) <= FLUSH)
        along: dict[int, dict[int, float]] = defaultdict(lambda: defaultdict(float))
        for row in np.flatnonzero(flush & ledges.of_level & (ledges.kind == Kind.NONE) & (ledges.below >= 0)).tolist():
            along[int(ledges.below[row])][int(ledges.surface[row])] += float(ledges.length[row])
        for index in sorted(set(along) - reported):
            floors = [floor for floor, length in sorted(along[index].items()) if length >= SHORTEST]
            narrow = _width(facts, index) < ledges.walker.body.movesize
            if len(floors) < 2 or narrow or facts.corners.normal[index, 2] < LEAST_NORMAL_Z:
                continue
            reported.add(index)
            surface = level.surfaces[index]
            yield Finding(
                Label(surface.head_span),
                f"{surface.title} lies flush between floors {floors[0]} and {floors[1]}, but it has no floor flag 0x1",
                "add 0x1 to its flags, with 0x1000 if ice is meant",
                surface.subject,
            )


def _width(facts: LevelFacts, surface: int) -> float:
    """A measure of how wide a surface is, JKU: twice its area over its outline, a strip's width."""
    corners = facts.corners
    outline = float(np.linalg.norm(corners.edge[corners.surface == surface], axis=1).sum())
    return float(np.linalg.norm(corners.area[surface])) / max(outline, 1e-9)
