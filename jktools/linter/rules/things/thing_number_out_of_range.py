"""JK403: a thing whose number is beyond what the heading announces."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK403", "thing-number-out-of-range", severity=Severity.ERROR, since="0.1.0")
def thing_number_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a thing whose number is negative, or not below the number of things that the heading announces.

    ## Why it matters
    The number before the colon is the thing's place in the engine's array, whose size is what the heading says. The
    engine does not compare the two (sithThing_Load in the decompiled engine) and writes beyond the array.

    ## Bad
        World things 3
        3: ghost ghost .5 1.5 .5 0 0 0 1

    ## Good
        World things 4
        3: ghost ghost .5 1.5 .5 0 0 0 1
    """
    table = level.document.things
    if table.heading is None:
        return
    count = table.heading.count
    outside = ((table.number < 0) | (table.number >= count)) & ~table.broken
    for index in np.flatnonzero(outside).tolist():
        thing = level.things[index]
        yield Finding(
            Label(thing.field_span("label")),
            f"{thing.title} has number {thing.number}, but the heading announces {count} things, from 0",
            "raise the number in the heading, with room for what is created in play; the engine overwrites memory",
            thing.subject,
            (Label(level.line_span(table.heading.line), "the heading"),),
        )
