"""JK310: two adjoined surfaces that are not one polygon."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.linter.rules.geometry.normal_off_surface import RIGHT_ANGLE
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a corner may lie off the other outline")] = 1e-4


@rule("JK310", "adjoined-surfaces-differ", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def adjoined_surfaces_differ(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report two adjoined surfaces of which one has a corner more than 0.0001 JKU off the outline of the other.

    ## Why it matters
    Who goes through where the two do not overlap arrives outside the sector that the engine puts him in, and looks
    past the edge of the other surface into nothing. Surfaces that face the same way are reported too.

    Extra vertices within an edge do no harm: JED writes them, and they lie on the outline. Adjoins that lead into
    their own sector are left to adjoin-into-own-sector, surfaces that are turned over to normal-off-surface.

    ## Bad
        World vertices 13
        12: .5 1 1
        World surfaces 12
        8: 0 0x0 0x4 4 3 1 1 0 4 3,0 7,1 12,2 2,3 1 1 1 1

    ## Good
        World vertices 13
        12: .5 1 1
        World surfaces 12
        8: 0 0x0 0x4 4 3 1 1 0 5 3,0 7,1 12,1 6,2 2,3 1 1 1 1 1
    """
    found = facts.adjoin_alignment
    here, there = level.adjoin_surface[found.adjoin], level.mirror_surface[found.adjoin]
    turned = facts.normal_fit.angle > RIGHT_ANGLE
    same_way = (found.facing > 0) & ~turned[here] & ~turned[there]
    differ = ((found.distance > options.distance) | same_way) & (
        level.surface_sector[here] != level.surface_sector[there]
    )
    for row in np.flatnonzero(differ).tolist():
        adjoin = level.adjoins[int(found.adjoin[row])]
        surface, other = level.surfaces[int(here[row])], level.surfaces[int(there[row])]
        apart = found.distance[row]
        how = (
            f"their outlines lie {apart:.6g} JKU apart"
            if apart > options.distance
            else "they face the same way instead of each other"
        )
        yield Finding(
            Label(surface.field_span("adjoin")),
            f"{surface.title} is adjoined to {other.title}, but {how}",
            "cleave the two surfaces alike, or remove the adjoin",
            adjoin.subject,
            (Label(other.head_span, f"surface {other.index}"),),
        )
