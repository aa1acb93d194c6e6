"""JK227: a part of the level that no player comes to."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK227", "sector-out-of-reach", severity=Severity.INFO, since="0.1.0", on=False)
def sector_out_of_reach(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report sectors that no player start leads to and that hold no item.

    ## Why it matters
    They may be left over from building. Many are meant: skies, rooms for cameras, niches behind glass that lets nobody
    in. So this rule is off; parts with items in them are JK226, which tells what counts as a way.

    ## Bad
        World adjoins 2
        0: 0x5 1 1
        1: 0x5 0 1
        World cogs 0
        - 0: door.cog 3 -1 wind.wav

    ## Good
        World adjoins 2
        0: 0x7 1 1
        1: 0x7 0 1
        World cogs 0
        - 0: door.cog 3 -1 wind.wav
    """
    for island in facts.islands:
        if not island.items:
            first = level.sectors[island.sectors[0]]
            yield Finding(
                Label(first.head_span),
                f"sector {first.index} belongs to a part of the level ({island.size}), but no player start leads there",
                "give an adjoin on the way the movement flag (0x2), or delete the part",
                first.subject,
            )
