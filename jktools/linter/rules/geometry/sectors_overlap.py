"""JK315: two sectors in the same place."""

from collections.abc import Iterator
from typing import Annotated

import msgspec

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    distance: Annotated[
        float, msgspec.Meta(ge=0, description="JKU that one sector must be moved to be clear of the other")
    ] = 0.01


@rule("JK315", "sectors-overlap", severity=Severity.INFO, since="0.1.0", options=Tolerances, on=False)
def sectors_overlap(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report two sectors that overlap by more than 0.01 JKU.

    ## Why it matters
    The engine goes from sector to sector through adjoins, so that overlapping rooms work and are used on purpose; one
    that is an accident swallows things, lights and the camera. JED and SED offer the check and leave it off, as here.

    Sectors are taken for convex. A pair is apart when the plane of a surface parts it exactly; of the others the
    least way by which one is clear of the other is measured. JED looks at the planes of surfaces alone, and so calls
    some pairs overlapping that are apart.

    ## Bad
        Sector 1
        Surfaces 0 6

    ## Good
        Sector 1
        Surfaces 6 6
    """
    overlaps = facts.overlaps
    for first, second, depth in zip(
        overlaps.first.tolist(), overlaps.second.tolist(), overlaps.depth.tolist(), strict=True
    ):
        if depth <= options.distance:
            continue
        sector, other = level.sectors[first], level.sectors[second]
        yield Finding(
            Label(sector.span),
            f"sectors {first} and {second} should lie apart, but overlap by {depth:.6g} JKU",
            "move one of them, or cleave them along a common face",
            sector.subject,
            (Label(other.span, f"sector {second}"),),
        )
