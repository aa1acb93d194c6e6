"""JK417: a thing that no difficulty or no mode of play has."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

NOT_IN_ANY_DIFFICULTY = 0x7000
NOT_IN_ANY_MODE = 0x18000


@rule("JK417", "thing-excluded-everywhere", severity=Severity.WARNING, since="0.1.0")
def thing_excluded_everywhere(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a thing whose flags exclude it from every difficulty, or from single- and multiplayer both.

    ## Why it matters
    The engine frees such a thing as soon as it has read its line (sithThing_Load in the decompiled engine): nobody ever
    meets it, and COGs that name it miss it. The flags of a thing's line replace those of its template.

    ## Bad
        World things 3
        1: ghost ghost .5 1.5 .5 0 90 0 1 thingflags=0x7000

    ## Bad
        World things 3
        1: ghost ghost .5 1.5 .5 0 90 0 1 thingflags=0x18000

    ## Good
        World things 3
        1: ghost ghost .5 1.5 .5 0 90 0 1 thingflags=0x13000
    """
    for thing in level.things:
        held = thing.resolved
        flags = held.flags("thingflags")
        for mask, what in ((NOT_IN_ANY_DIFFICULTY, "every difficulty"), (NOT_IN_ANY_MODE, "both modes of play")):
            if flags & mask == mask and thing.dropped is None:
                yield Finding(
                    Label(held.values["thingflags"].origins[0].span),
                    f"{thing.title} is placed, but its flags 0x{flags:x} exclude it from {what}",
                    f"clear one of the bits of 0x{mask:x}, or delete the thing",
                    thing.subject,
                )
