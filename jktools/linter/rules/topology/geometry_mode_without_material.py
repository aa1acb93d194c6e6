"""JK225: an adjoined surface that should be drawn, but has no material."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK225", "geometry-mode-without-material", severity=Severity.INFO, since="0.1.0")
def geometry_mode_without_material(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an adjoined surface without material that has a geometry mode other than 0.

    ## Why it matters
    The engine sets the mode to 0 where there is no material (sithSurface_Load in the decompiled engine): the surface
    is not drawn, though the level says it should be. Solid surfaces are left to solid-surface-without-material.

    ## Bad
        World surfaces 12
        3: -1 0x0 0x4 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1

    ## Good
        World surfaces 12
        3: -1 0x0 0x4 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1
    """
    table = level.document.surfaces
    blank = (table.material < 0) & (table.geometry_mode != 0) & (table.adjoin != -1) & ~table.broken
    for index in np.flatnonzero(blank).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("geometry mode")),
            f"{surface.title} has geometry mode {table.geometry_mode[index]}, but no material to draw it with",
            "name a material, or write geometry mode 0",
            surface.subject,
        )
