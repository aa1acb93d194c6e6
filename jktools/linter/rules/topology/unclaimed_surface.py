"""JK209: a surface that no sector claims."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK209", "unclaimed-surface", severity=Severity.ERROR, since="0.1.0")
def unclaimed_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a run of surfaces that no sector claims.

    ## Why it matters
    Each surface must belong to a sector; the engine refuses the level otherwise (sithSurface_Verify in the decompiled
    engine). Levels with a sector that could not be read are not judged.

    ## Bad
        Sector 1
        Surfaces 6 5

    ## Good
        Sector 1
        Surfaces 6 6
    """
    if level.document.sectors.broken.any() or not len(level.sectors):
        return
    free = np.flatnonzero(level.surface_sector < 0)
    for run in np.split(free, np.flatnonzero(np.diff(free) > 1) + 1) if len(free) else ():
        first = level.surfaces[int(run[0])]
        which = f"surface {first.index} is" if len(run) == 1 else f"surfaces {first.index} to {run[-1]} are"
        yield Finding(
            Label(first.head_span),
            f"{which} claimed by no sector, but each surface must belong to one",
            "widen the range of a sector, or delete the surface; the engine refuses the level",
            first.subject,
        )
