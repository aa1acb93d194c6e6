"""JK224: a sky surface with a light mode."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

SKY = 0x600
"""Surface flags of horizon and ceiling sky (sithSurface.h in the decompiled engine)."""

FULLY_LIT = 0


@rule("JK224", "lit-sky-surface", severity=Severity.INFO, since="0.1.0", on=False)
def lit_sky_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sky surface with a light mode other than 0 (fully lit).

    ## Why it matters
    It does not: the engine sets the mode to 0 itself, and JED writes 3 on nearly every sky. The rule is off, for those
    who look for what a level says in vain.

    ## Bad
        World surfaces 12
        1: 0 0x204 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x204 0x4 4 0 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1
    """
    table = level.document.surfaces
    lit = (table.flags & SKY != 0) & (table.light_mode != FULLY_LIT) & ~table.broken
    for index in np.flatnonzero(lit).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("light mode")),
            f"{surface.title} is sky with light mode {table.light_mode[index]}, but the engine draws sky in mode 0",
            "write 0",
            surface.subject,
        )
