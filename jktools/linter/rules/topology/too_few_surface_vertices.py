"""JK206: a surface with fewer vertices than a polygon has."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

LEAST_VERTICES = 3
"""Corners of one surface (sithSurface_Load in the decompiled engine)."""


@rule("JK206", "too-few-surface-vertices", severity=Severity.ERROR, since="0.1.0")
def too_few_surface_vertices(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface with fewer than 3 vertices.

    ## Why it matters
    The engine refuses a level with such a surface.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 2 4,0 5,1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 7,3 1 1 1 1
    """
    table = level.document.surfaces
    corners = np.diff(table.corner_start)
    for index in np.flatnonzero((corners < LEAST_VERTICES) & ~table.broken).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("vertex count")),
            f"{surface.title} has {corners[index]} vertices, but a surface needs at least {LEAST_VERTICES}",
            "delete the surface or give it an area; the engine refuses the level",
            surface.subject,
        )
