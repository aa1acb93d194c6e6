"""JK203: a surface whose adjoin does not exist."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK203", "surface-adjoin-out-of-range", severity=Severity.ERROR, since="0.1.0")
def surface_adjoin_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface whose adjoin is neither -1 nor one that exists.

    ## Why it matters
    The engine only compares the number with -1 and then reads whatever lies beyond its list of adjoins.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 4 0 4 4,0 5,1 6,2 7,3 1 1 1 1

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -2 0 4 4,0 5,1 6,2 7,3 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 7,3 1 1 1 1
    """
    count = len(level.adjoins)
    used = level.document.surfaces.adjoin
    for index in np.flatnonzero((used < -1) | (used >= count)).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.field_span("adjoin")),
            f"{surface.title} has adjoin {surface.adjoin_index}, but the level has {numbered(count, 'adjoin')}",
            "write -1 for a solid surface, or name its adjoin",
            surface.subject,
        )
