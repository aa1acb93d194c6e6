"""JK220: a floor that one falls through."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

FLOOR, COLLISION = 0x1, 0x4
"""Surface flags (sithSurface.h in the decompiled engine)."""


@rule("JK220", "floor-without-collision", severity=Severity.WARNING, since="0.1.0")
def floor_without_collision(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface without adjoin that is flagged as floor (0x1), but not as solid (0x4).

    ## Why it matters
    The engine passes over such a surface when it moves bodies: one falls through the floor and out of the level.
    Adjoined surfaces are not meant: the flags of their adjoin decide, and water is commonly flagged so. JED and SED
    report those as well.

    ## Bad
        World surfaces 12
        0: 0 0x1 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1

    ## Good
        World surfaces 12
        0: 0 0x5 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1
    """
    table = level.document.surfaces
    hollow = (table.adjoin == -1) & (table.flags & (FLOOR | COLLISION) == FLOOR) & ~table.broken
    for index in np.flatnonzero(hollow).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("surface flags")),
            f"{surface.title} is a floor (flag 0x{FLOOR:x}), but not solid (flag 0x{COLLISION:x})",
            f"set flags 0x{surface.flags | COLLISION:x}, or clear the floor flag",
            surface.subject,
        )
