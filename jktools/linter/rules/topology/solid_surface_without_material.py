"""JK222: a solid surface without material."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK222", "solid-surface-without-material", severity=Severity.WARNING, since="0.1.0")
def solid_surface_without_material(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface without adjoin that has no material.

    ## Why it matters
    The engine draws no surface without material, whatever its geometry mode (sithSurface_Load in the decompiled
    engine), and nothing lies behind this one: what the screen held before shows, a hall of mirrors.

    ## Bad
        World surfaces 12
        1: -1 0x4 0x4 0 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1

    ## Good
        World surfaces 12
        3: -1 0x0 0x4 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1
    """
    table = level.document.surfaces
    for index in np.flatnonzero((table.material < 0) & (table.adjoin == -1) & ~table.broken).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("material")),
            f"{surface.title} is solid, but has material {surface.material}, that is none, and is not drawn",
            "name a material",
            surface.subject,
        )
