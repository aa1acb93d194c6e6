"""JK101: a surface whose material does not exist."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK101", "material-out-of-range", severity=Severity.ERROR, since="0.1.0")
def material_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface whose material is not in the MATERIALS list.

    ## Why it matters
    The engine compares the number with that of the materials and refuses the level (sithSurface_Load in the
    decompiled engine). A number below 0 means no material.

    ## Bad
        World surfaces 12
        1: 1 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1
    """
    table, count = level.document.surfaces, len(level.materials)
    for index in np.flatnonzero((table.material >= count) & ~table.broken).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("material")),
            f"{surface.title} has material {surface.material}, but the level has {numbered(count, 'material')}",
            "name a material of the list, or -1 for none; the engine refuses the level",
            surface.subject,
        )
