"""JK314: a centre that does not lie in its sector."""

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

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a centre may lie outside")] = 1e-3
    convexity: Annotated[float, msgspec.Meta(ge=0, description="JKU off convex up to which a sector is judged")] = 1e-3


@rule("JK314", "center-outside-sector", severity=Severity.INFO, since="0.1.0", options=Tolerances)
def center_outside_sector(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a sector whose centre lies more than 0.001 JKU behind one of its surfaces.

    ## Why it matters
    The engine measures light and sound from there. LucasArts' tools took the middle of the bound box, which can lie
    outside a sector shaped like a wedge; editors take the mean of the vertices, which cannot. Sectors that are not
    convex are left to sector-not-convex.

    ## Bad
        Sector 0
        Center .5 1.5 .5

    ## Good
        Sector 0
        Center .5 1 .5
    """
    sectors, outside = geometry.centers_outside(level)
    convex = facts.convexity.distance[sectors] <= options.convexity
    for row in np.flatnonzero((outside.distance > options.distance) & convex).tolist():
        sector, surface = level.sectors[int(sectors[row])], level.surfaces[int(outside.surface[row])]
        yield Finding(
            Label(sector.line_span("center")),
            f"the centre of sector {sector.index} lies {outside.distance[row]:.6g} JKU behind its surface "
            f"{surface.index}, but should lie inside",
            "write the mean of the sector's vertices, and the radius from there",
            sector.subject,
            (Label(surface.head_span, f"surface {surface.index}"),),
        )
