"""JK305: a sector with a hole between its surfaces."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools import geometry
from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.linter.rules.geometry.normal_off_surface import RIGHT_ANGLE
from jktools.linter.rules.topology.too_few_sector_surfaces import LEAST_SURFACES
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    distance: Annotated[
        float, msgspec.Meta(gt=0, description="JKU that edges may lie apart, and that a gap may be long")
    ] = 1e-3


@rule("JK305", "sector-not-closed", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def sector_not_closed(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a sector with an edge that no other of its surfaces runs back along.

    ## Why it matters
    There the sector has a hole, or a surface too many: bodies and sight leave it without a surface to stop them, and
    what the screen held before shows.

    An edge may run back along several others, and extra vertices on one side do no harm. Edges may lie 0.001 JKU
    apart. Sectors with fewer than 4 surfaces are left to too-few-sector-surfaces, those with a surface that is turned
    over to normal-off-surface.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 3 4,0 7,1 6,2 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1
    """
    found = geometry.open_edges(level, facts.corners, options.distance)
    judged = level.document.sectors.surface_count >= LEAST_SURFACES
    turned = level.surface_sector[facts.normal_fit.angle > RIGHT_ANGLE]
    judged[turned[turned >= 0]] = False
    for index in np.flatnonzero((found.length > options.distance) & judged).tolist():
        sector, corner = level.sectors[index], int(found.corner[index])
        surface, place = level.surfaces[int(facts.corners.surface[corner])], int(facts.corners.place[corner])
        start, end = facts.corners.vertex[corner], facts.corners.vertex[facts.corners.following[corner]]
        more = f"; {found.edges[index] - 1} more edges are open" if found.edges[index] > 1 else ""
        yield Finding(
            Label(surface.corner_span(place)),
            f"sector {index} is open along the edge from vertex {start} to {end} of {surface.title}, over "
            f"{found.length[index]:.6g} JKU{more}",
            "close the sector there, or remove the surface that is too many",
            sector.subject,
            (Label(sector.span, f"sector {index}"),),
        )
