"""JK226: items in a part of the level that no player comes to."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK226", "item-out-of-reach", severity=Severity.WARNING, since="0.1.0")
def item_out_of_reach(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report items in sectors that no player start leads to.

    ## Why it matters
    Nobody can take them. Players come through adjoins that let things pass (flag 0x2 on the near side; the far side has
    flags of its own) and do not hold players (0x10), or that a script can open; on lifts; and where a script sends them
    by `TeleportThing` or `JumpToFrame`. Of a script that is not at hand each number may be a sector, surface or thing
    that it takes them to. Steps and falls are not looked at, and an item that a script names is left out. Nothing is
    told where a script may set a player anywhere, as by `SetThingPos`.

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
    for island in facts.islands:
        if island.items:
            first, *rest = island.items
            more = (
                f", with {len(rest)} more beside it" if len(rest) > 1 else ", with one more beside it" if rest else ""
            )
            yield Finding(
                Label(first.head_span),
                f"{first.title} is an item in sector {first.sector_index}{more}, but no player start leads to that "
                f"part of the level ({island.size})",
                "give an adjoin on the way the movement flag (0x2), or move what lies there",
                first.subject,
                tuple(Label(thing.head_span, thing.title) for thing in rest),
            )
