"""JK301: a collide box that sticks out of its sector."""

from collections.abc import Iterator
from typing import Annotated

import msgspec

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    # Boxes are written with few decimals, and no tool but the buggy one exceeds this.
    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a corner may lie outside")] = 1e-3


@rule("JK301", "collidebox-outside-sector", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def collidebox_outside_sector(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a collide box with a corner more than 0.001 JKU outside its sector.

    ## Why it matters
    While the end point of a movement lies in the collide box, the engine tests none of the sector's surfaces, so
    a body can pass through the walls that the box sticks out of (read in the decompiled engine, not played).
    JED and SED write such boxes: when growing the box towards +Y fails, they take back the step in X. Boxes that
    LucasArts' own tools wrote never stick out. A box that is inverted as well holds nothing and is left to
    collidebox-inverted.

    ## Bad
        Sector 0
        CollideBox .1 .1 .1 .9 1.2 .9

    ## Good
        Sector 0
        CollideBox .1 .1 .1 .9 .9 .9
    """
    sectors, outside = facts.collide_boxes
    for index, surface, distance in zip(
        sectors.tolist(), outside.surface.tolist(), outside.distance.tolist(), strict=True
    ):
        sector, wall = level.sectors[index], level.surfaces[surface]
        box = sector.collide_box
        if distance <= options.distance or box is None or (box[0] > box[1]).any():
            continue
        yield Finding(
            Label(sector.line_span("collide_box")),
            f"the collide box of sector {index} lies {distance:.6g} JKU behind surface {wall.index} "
            f"(sector {index}, surface {wall.index - sector.first_surface}), but should lie inside the sector",
            "shrink the box, or remove the line: without it the engine tests every surface",
            sector.subject,
            (Label(wall.head_span, f"surface {wall.index}"),),
        )
