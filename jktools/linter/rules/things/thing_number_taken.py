"""JK404: a thing number that another thing has."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK404", "thing-number-taken", severity=Severity.ERROR, since="0.1.0")
def thing_number_taken(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a thing with the number of a thing above it.

    ## Why it matters
    The number before the colon is the thing's place in the engine's array: the later thing is built over the earlier
    one and enters its sector's list a second time, which ties the list into a knot (sithThing_Load and
    sithThing_EnterSector in the decompiled engine). Things that the engine skips are not counted.

    ## Bad
        World things 3
        1: ghost ghost .5 1.5 .5 0 90 0 1
        01: ghost ghost .5 1.5 .6 0 90 0 1

    ## Good
        World things 3
        1: ghost ghost .5 1.5 .5 0 90 0 1
        2: ghost ghost .5 1.5 .6 0 90 0 1
    """
    holder: dict[int, int] = {}
    for thing in level.things:
        if thing.dropped is not None:
            continue
        first = holder.setdefault(thing.number, thing.index)
        if first == thing.index:
            continue
        other = level.things[first]
        yield Finding(
            Label(thing.field_span("label")),
            f"{thing.title} has number {thing.number}, but {other.title} has it already",
            "give each thing a number of its own",
            thing.subject,
            (Label(other.head_span, "the first"),),
        )
