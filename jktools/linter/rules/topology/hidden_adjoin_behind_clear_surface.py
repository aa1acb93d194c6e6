"""JK223: a surface that one sees through, over an adjoin that is not visible."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.topology.translucent_solid_surface import TRANSLUCENT
from jktools.model import Level

VISIBLE = 0x1
"""Adjoin flag: what lies behind is drawn (sithAdjoin.h in the decompiled engine)."""

NOT_DRAWN = 0


@rule("JK223", "hidden-adjoin-behind-clear-surface", severity=Severity.WARNING, since="0.1.0")
def hidden_adjoin_behind_clear_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface that is translucent or not drawn, with an adjoin that lacks the visible flag 0x1.

    ## Why it matters
    One looks through the surface, but the sector behind is not drawn: what the screen held before shows, a hall of
    mirrors. JED and SED warn of it too.

    ## Bad
        World adjoins 2
        0: 0x6 1 1
        World surfaces 12
        3: 0 0x0 0x4 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1

    ## Bad
        World adjoins 2
        0: 0x6 1 1
        World surfaces 12
        3: 0 0x0 0x6 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1

    ## Good
        World adjoins 2
        0: 0x6 1 1
        World surfaces 12
        3: 0 0x0 0x4 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1
    """
    table, adjoins = level.document.surfaces, level.document.adjoins
    translucent = table.face_flags & TRANSLUCENT != 0
    clear = (translucent | (table.geometry_mode == NOT_DRAWN)) & ~table.broken
    clear &= (table.adjoin >= 0) & (table.adjoin < len(adjoins))
    for index in np.flatnonzero(clear).tolist():
        surface = level.surfaces[index]
        adjoin = level.adjoins[surface.adjoin_index]
        if adjoin.broken or adjoin.flags & VISIBLE:
            continue
        yield Finding(
            Label(surface.field_span("adjoin")),
            f"{surface.title} is {'translucent' if translucent[index] else 'not drawn'}, but its adjoin {adjoin.index} "
            f"is not visible (flags 0x{adjoin.flags:x})",
            f"set flags 0x{adjoin.flags | VISIBLE:x} on the adjoin, or draw the surface opaque",
            surface.subject,
            (Label(adjoin.field_span("flags"), f"adjoin {adjoin.index}"),),
        )
