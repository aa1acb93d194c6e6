"""JK226: items in a part of the level that no player comes to."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.islands import islands
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK226", "item-out-of-reach", severity=Severity.WARNING, since="0.1.0")
def item_out_of_reach(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report items in sectors that no player start leads to.

    ## Why it matters
    Nobody can take them. Sectors hang together by adjoins that let things pass (0x2) or that a script can open; what a
    value of a placed COG can name counts as reached, since the script may take the player there.

    ## Bad
        World adjoins 2
        0: 0x5 1 1
        1: 0x5 0 1
        World cogs 0
        - 0: door.cog 3 -1 wind.wav
        World templates 4
        shield none type=item
        World things 4
        2: shield shield .5 1.5 .2 0 0 0 1

    ## Good
        World templates 4
        shield none type=item
        World things 4
        2: shield shield .5 1.5 .2 0 0 0 1
    """
    for island in islands(level, facts.openable_surfaces):
        if island.items:
            first, *rest = island.items
            more = (
                f", with {len(rest)} more beside it" if len(rest) > 1 else ", with one more beside it" if rest else ""
            )
            size = f"{len(island.sectors)} sectors" if len(island.sectors) > 1 else "one sector"
            yield Finding(
                Label(first.head_span),
                f"{first.title} is an item in sector {first.sector_index}{more}, but no player start leads to that "
                f"part of the level ({size})",
                "give an adjoin on the way the movement flag (0x2), or move what lies there",
                first.subject,
                tuple(Label(thing.head_span, thing.title) for thing in rest),
            )
