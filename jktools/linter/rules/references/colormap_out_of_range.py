"""JK102: a sector whose colormap does not exist."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK102", "colormap-out-of-range", severity=Severity.ERROR, since="0.1.0")
def colormap_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sector whose colormap is not among those of GEORESOURCE.

    ## Why it matters
    The engine does not check the number and draws the sector with whatever lies beyond its list. JED and SED call a
    sector without colormap an error.

    ## Bad
        Sector 1
        Colormap 1

    ## Bad
        Sector 1
        Colormap -1

    ## Good
        Sector 1
        Colormap 0
    """
    table, count = level.document.sectors, len(level.colormaps)
    wrong = (table.colormap < 0) | (table.colormap >= count)
    for index in np.flatnonzero(wrong & ~table.broken).tolist():
        sector = level.sectors[index]
        yield Finding(
            Label(sector.line_span("colormap", 0)),
            f"sector {index} has colormap {table.colormap[index]}, but the level has {numbered(count, 'colormap')}",
            "name a colormap of GEORESOURCE; the engine reads past its list",
            sector.subject,
        )
