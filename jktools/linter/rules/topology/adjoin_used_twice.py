"""JK211: an adjoin that several surfaces carry."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK211", "adjoin-used-twice", severity=Severity.ERROR, since="0.1.0")
def adjoin_used_twice(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an adjoin that more than one surface carries.

    ## Why it matters
    An adjoin knows one surface: the last that names it (sithSurface_Load in the decompiled engine). Whoever comes
    back through its mirror arrives at that one, in that one's sector, whichever surface was meant.

    ## Bad
        World surfaces 12
        4: 0 0x4 0x4 4 3 1 0 0 4 0,0 3,1 7,2 4,3 1 1 1 1

    ## Good
        World surfaces 12
        4: 0 0x4 0x4 4 3 1 -1 0 4 0,0 3,1 7,2 4,3 1 1 1 1
    """
    table = level.document.surfaces
    used = np.where(table.broken, -1, table.adjoin)
    carried = (used >= 0) & (used < len(level.adjoins))
    times = np.bincount(used[carried], minlength=len(level.adjoins))
    for index in np.flatnonzero(times > 1).tolist():
        first, *others = [level.surfaces[i] for i in np.flatnonzero(used == index).tolist()]
        last = others[-1]
        yield Finding(
            Label(last.field_span("adjoin"), f"surface {last.index}"),
            f"adjoin {index} is carried by {times[index]} surfaces, but belongs to the last alone, {last.title}",
            "give each surface an adjoin of its own",
            level.adjoins[index].subject,
            tuple(Label(s.field_span("adjoin"), f"surface {s.index}") for s in (first, *others[:-1])),
        )
