"""JK302: a sector that is not convex."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools import geometry
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

    A vertex counts when it lies so far behind both the plane of the surface's vertices and that of the written
    normal: far from the origin, the rounding of either alone bends sectors that their author made convex. That the
    sector is not convex at all is decided exactly. Per sector the worst vertex is told, and how many more there are.

    ## Bad
        World vertices 12
        2: 1.1 .5 -.2

    ## Good
        World vertices 12
        2: 1 1 0
    """
    found = geometry.vertices_behind(level, facts.corners, options.distance)
    bent, first, pairs = np.unique(found.sector, return_index=True, return_counts=True)
    for index, start, count in zip(bent.tolist(), first.tolist(), pairs.tolist(), strict=True):
        if not facts.convexity.behind[index]:
            continue
        worst = start + int(found.distance[start : start + count].argmax())
        sector, surface = level.sectors[index], level.surfaces[int(found.surface[worst])]
        vertex = int(found.vertex[worst])
        more = f"; {count - 1} more such pairs" if count > 1 else ""
        yield Finding(
            Label(sector.span),
            f"sector {index} should be convex, but its vertex {vertex} lies {found.distance[worst]:.6g} JKU behind "
            f"surface {surface.index} (sector {index}, surface {surface.index - sector.first_surface}){more}",
            "cleave the sector along that surface",
            sector.subject,
            (
                Label(surface.head_span, f"surface {surface.index}"),
                Label(level.line_span(int(level.document.vertices.lines[vertex])), f"vertex {vertex}"),
            ),
        )
