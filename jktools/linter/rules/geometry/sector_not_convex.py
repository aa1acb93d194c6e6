"""JK302: a sector that is not convex."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a vertex may lie behind a surface")] = 1e-3


@rule("JK302", "sector-not-convex", severity=Severity.ERROR, since="0.1.0", options=Tolerances)
def sector_not_convex(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a sector with a vertex more than 0.001 JKU behind one of its surfaces.

    ## Why it matters
    The engine's collision, its search for the sector of a point and its drawing order all take a sector for convex.
    In one that is not, bodies pass through walls and surfaces vanish.

    The side of each vertex is decided exactly; the distance is from the plane of the surface's widest triangle.
    Per sector the worst vertex is told, and how many more there are.

    ## Bad
        World vertices 12
        2: 1.1 .5 -.2

    ## Good
        World vertices 12
        2: 1 1 0
    """
    convexity = facts.convexity
    for index in np.flatnonzero(convexity.distance > options.distance).tolist():
        sector = level.sectors[index]
        surface = level.surfaces[int(convexity.surface[index])]
        vertex, distance = int(convexity.vertex[index]), float(convexity.distance[index])
        more = int(convexity.behind[index]) - 1
        yield Finding(
            Label(sector.span),
            f"sector {index} should be convex, but its vertex {vertex} lies {distance:.6g} JKU behind surface "
            f"{surface.index} (sector {index}, surface {surface.index - sector.first_surface})"
            + (f"; {more} more such pairs" if more > 0 else ""),
            "cleave the sector along that surface",
            sector.subject,
            (
                Label(surface.head_span, f"surface {surface.index}"),
                Label(level.line_span(int(level.document.vertices.lines[vertex])), f"vertex {vertex}"),
            ),
        )
