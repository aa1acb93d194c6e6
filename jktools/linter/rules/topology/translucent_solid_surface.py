"""JK219: a see-through surface with nothing behind it."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

TRANSLUCENT = 0x2
"""Face flag (rdFace.h in the decompiled engine)."""


@rule("JK219", "translucent-solid-surface", severity=Severity.WARNING, since="0.1.0")
def translucent_solid_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface without adjoin that has the translucent face flag 0x2.

    ## Why it matters
    One looks through it at nothing: what the screen held before shows there, a hall of mirrors. JED and SED warn of
    it too.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x6 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1

    ## Good
        World surfaces 12
        3: 0 0x0 0x6 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1
    """
    table = level.document.surfaces
    clear = (table.adjoin == -1) & (table.face_flags & TRANSLUCENT != 0) & ~table.broken
    for index in np.flatnonzero(clear).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("face flags")),
            f"{surface.title} is translucent (face flag 0x{TRANSLUCENT:x}), but has no adjoin to look through",
            "clear the flag, or adjoin the surface to the sector behind it",
            surface.subject,
        )
