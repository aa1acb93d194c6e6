"""JK313: a radius that is not that of the sector's vertices."""

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

    # No radius that any tool wrote exceeds it.
    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that the radius may be off")] = 2e-3


@rule("JK313", "radius-mismatch", severity=Severity.INFO, since="0.1.0", options=Tolerances)
def radius_mismatch(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a radius that differs by more than 0.002 JKU from the distance of the vertex farthest from the centre.

    ## Why it matters
    The engine decides by centre and radius which moving lights reach a sector (sithRender_RenderDynamicLights in the
    decompiled engine): with one too small, a light goes out at the sector's edge. Corners of surfaces count, whether
    the sector lists them or not.

    ## Bad
        Sector 0
        Radius .5

    ## Good
        Sector 0
        Radius .867
    """
    farthest, written = facts.sector_extent.radius, level.document.sectors.radius
    for index in np.flatnonzero(np.abs(farthest - written) > options.distance).tolist():
        sector = level.sectors[index]
        yield Finding(
            Label(sector.line_span("radius", 0)),
            f"sector {index} has radius {written[index]:.6g}, but its farthest vertex lies {farthest[index]:.6g} JKU "
            "from its centre",
            f"write {farthest[index]:.6f}",
            sector.subject,
            (Label(sector.line_span("center"), "its centre"),),
        )
