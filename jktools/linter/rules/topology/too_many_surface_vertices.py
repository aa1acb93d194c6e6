"""JK205: a surface with more vertices than the engine takes."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.level import MOST_CORNERS

MOST_VERTICES = MOST_CORNERS
"""Corners of one surface (sithSurface_Load in the decompiled engine)."""


@rule("JK205", "too-many-surface-vertices", severity=Severity.ERROR, since="0.1.0")
def too_many_surface_vertices(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface with more than 24 vertices.

    ## Why it matters
    The engine refuses a level with such a surface. Cleave the surface; a round one rarely needs more than 16 sides.

    ## Bad
        World surfaces 12
        1: -1 0x4 0x4 0 3 1 -1 0 25 4,-1 5,-1 6,-1 7,-1 4,-1 5,-1 6,-1 7,-1 4,-1 5,-1 6,-1 7,-1 4,-1 5,-1 6,-1 7,-1 \
4,-1 5,-1 6,-1 7,-1 4,-1 5,-1 6,-1 7,-1 4,-1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 7,3 1 1 1 1
    """
    corners = np.diff(level.document.surfaces.corner_start)
    for index in np.flatnonzero(corners > MOST_VERTICES).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("vertex count")),
            f"{surface.title} has {corners[index]} vertices, but the engine takes at most {MOST_VERTICES}",
            "cleave the surface; the engine refuses the level",
            surface.subject,
        )
