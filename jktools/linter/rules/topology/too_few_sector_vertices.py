"""JK215: a sector with fewer vertices than a solid has."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.topology.too_few_sector_surfaces import LEAST_SURFACES
from jktools.model import Level

LEAST_VERTICES = 4
"""Of a solid: a tetrahedron. JED and SED test the same."""


@rule("JK215", "too-few-sector-vertices", severity=Severity.WARNING, since="0.1.0")
def too_few_sector_vertices(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sector that lists fewer than 4 vertices.

    ## Why it matters
    The engine works with the vertices that a sector lists: it lights no others with moving lights. JED and SED call
    such a sector an error. Sectors with too few surfaces are left to too-few-sector-surfaces.

    ## Bad
        Sector 1
        Vertices 3
        - 3: 9
        - 4: 7
        - 5: 11
        - 6: 10
        - 7: 6

    ## Good
        Sector 1
        Vertices 8
    """
    table = level.document.sectors
    counts = np.diff(table.vertex_start)
    few = (counts < LEAST_VERTICES) & (table.surface_count >= LEAST_SURFACES) & ~table.broken
    for index in np.flatnonzero(few).tolist():
        sector = level.sectors[index]
        yield Finding(
            Label(sector.line_span("vertex_count")),
            f"sector {index} lists {counts[index]} vertices, but a room needs at least {LEAST_VERTICES}",
            "list the vertices of the sector's surfaces",
            sector.subject,
        )
