"""JK312: a bound box that is not that of the sector's vertices."""

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

    # No box that any tool wrote exceeds it.
    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a coordinate may be off")] = 2e-3


@rule("JK312", "boundbox-mismatch", severity=Severity.INFO, since="0.1.0", options=Tolerances)
def boundbox_mismatch(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a bound box that differs by more than 0.002 JKU from the box of the sector's vertices.

    ## Why it matters
    Tools and newer engines look there first when they search for the sector of a point. The line is written by the
    editor: a wrong one tells that the file was changed by hand or by a tool with a fault. Corners of surfaces count,
    whether the sector lists them or not.

    ## Bad
        Sector 0
        BoundBox 0 0 0 1 1.5 1

    ## Good
        Sector 0
        BoundBox 0 0 0 1 1.001 1
    """
    off = facts.sector_extent.box
    for index in np.flatnonzero(off > options.distance).tolist():
        sector = level.sectors[index]
        yield Finding(
            Label(sector.line_span("bound_box")),
            f"the bound box of sector {index} is {off[index]:.6g} JKU off the box of its vertices",
            "save the level in an editor, which writes the box anew",
            sector.subject,
        )
