"""JK214: a sector with fewer surfaces than a solid has."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

LEAST_SURFACES = 4
"""Of a solid: a tetrahedron. JED and SED test the same."""


@rule("JK214", "too-few-sector-surfaces", severity=Severity.WARNING, since="0.1.0")
def too_few_sector_surfaces(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sector with fewer than 4 surfaces.

    ## Why it matters
    It encloses nothing. The engine takes it, but bodies fall out of it; JED and SED call it an error.

    ## Bad
        Sector 1
        Surfaces 6 3

    ## Good
        Sector 1
        Surfaces 6 6
    """
    table = level.document.sectors
    few = (table.surface_count >= 0) & (table.surface_count < LEAST_SURFACES) & ~table.broken
    for index in np.flatnonzero(few).tolist():
        sector = level.sectors[index]
        yield Finding(
            Label(sector.line_span("surface_range")),
            f"sector {index} has {sector.surface_count} surfaces, but a room needs at least {LEAST_SURFACES}",
            "delete the sector, or restore its surfaces",
            sector.subject,
        )
