"""JK402: a thing that names no sector."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK402", "thing-without-sector", severity=Severity.WARNING, since="0.1.0")
def thing_without_sector(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a thing whose sector does not exist.

    ## Why it matters
    The engine skips the line without a word: the thing is not in the level, and COGs that name it miss it.

    ## Bad
        World things 3
        1: ghost ghost .5 1.5 .5 0 0 0 -1

    ## Bad
        World things 3
        1: ghost ghost .5 1.5 .5 0 0 0 2

    ## Good
        World things 3
        1: ghost ghost .5 1.5 .5 0 0 0 1
    """
    table, count = level.document.things, len(level.sectors)
    lost = ((table.sector < 0) | (table.sector >= count)) & ~table.broken
    for index in np.flatnonzero(lost).tolist():
        thing = level.things[index]
        yield Finding(
            Label(thing.field_span("sector")),
            f"{thing.title} names sector {thing.sector_index}, but the level has {numbered(count, 'sector')}",
            "name the sector that the thing lies in; the engine skips the line",
            thing.subject,
        )
