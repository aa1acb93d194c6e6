"""JK221: a solid surface that is not drawn."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

FILLED = (3, 4, 5)
"""Geometry modes that fill the polygon: solid colour, textured and full (rdroid.h in the decompiled engine)."""


@rule("JK221", "undrawn-solid-surface", severity=Severity.INFO, since="0.1.0")
def undrawn_solid_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface without adjoin that has a material, but a geometry mode that does not fill it.

    ## Why it matters
    Nothing is drawn there, sky neither (sithRender_RenderLevelGeometry in the decompiled engine), and nothing lies
    behind: what the screen held before shows, a hall of mirrors. Real levels do it on purpose to hulls that nobody
    should see, so that it is an info only. JED and SED warn of every mode other than 4; here 3 (a solid colour) and 5
    count as drawn too. Surfaces without material are left to solid-surface-without-material.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 0 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 3 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1
    """
    table = level.document.surfaces
    hidden = (table.adjoin == -1) & (table.material >= 0) & ~np.isin(table.geometry_mode, FILLED) & ~table.broken
    for index in np.flatnonzero(hidden).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("geometry mode")),
            f"{surface.title} is solid, but its geometry mode {table.geometry_mode[index]} leaves it undrawn",
            "write 4 (textured), or 3 for a material of one colour",
            surface.subject,
        )
