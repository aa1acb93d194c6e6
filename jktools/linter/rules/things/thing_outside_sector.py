"""JK401: a thing that does not lie in the sector it names."""

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

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a thing may lie outside its sector")] = 1e-5
    convexity: Annotated[float, msgspec.Meta(ge=0, description="JKU off convex up to which a sector is judged")] = 1e-3


@rule("JK401", "thing-outside-sector", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def thing_outside_sector(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a thing whose position lies more than 0.00001 JKU outside the sector that it names.

    ## Why it matters
    The engine trusts the number: the thing is drawn, lit and collided with in the wrong sector, falls out of the
    level or is stuck in a wall. Things in sectors that are not convex are left to sector-not-convex.

    ## Bad
        World things 3
        1: ghost ghost .5 1.5 .5 0 0 0 0

    ## Good
        World things 3
        1: ghost ghost .5 1.5 .5 0 0 0 1
    """
    table = level.document.things
    sound = level.sound_sectors & (facts.convexity.distance <= options.convexity)
    known = (table.sector >= 0) & (table.sector < len(sound)) & np.isfinite(table.position).all(axis=1)
    known[known] &= sound[table.sector[known]]
    things = np.flatnonzero(known)
    outside = geometry.points_outside(level, table.position[things], table.sector[things])
    for i in np.flatnonzero(outside.distance > options.distance).tolist():
        thing = level.things[int(things[i])]
        surface = level.surfaces[int(outside.surface[i])]
        yield Finding(
            Label(thing.field_span("sector")),
            f"{thing.title} names sector {thing.sector_index}, but lies {outside.distance[i]:.6g} JKU behind its "
            f"surface {surface.index}",
            "move the thing, or name the sector that it lies in",
            thing.subject,
            (Label(surface.head_span, f"surface {surface.index}"),),
        )
