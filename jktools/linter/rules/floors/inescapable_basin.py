"""JK701: a basin that nobody gets out of."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.basins import Basin
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level

REST = 0.75
"""Of all floors: what holds more of them is where the level goes on, not a hole in it."""


@rule("JK701", "inescapable-basin", severity=Severity.WARNING, since="0.1.0")
def inescapable_basin(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report floors that a player can come down to, and from which no step, jump, lift, water or script leads out.

    ## Why it matters
    A player who slips in has to load a saved game. Looked at are the player's own jump from the edge of each floor,
    things that can be stood on, sectors that lift, and all that a placed script names; where any of them may help,
    nothing is reported, nor where the fall in kills. Powers that jump higher are not counted. A part that holds more
    than three quarters of the level's floor is where the level goes on, and is left out.

    ## Bad
        World vertices 14
        8: 1 2 -.6
        9: 0 2 -.6
        12: 0 1 -.6
        13: 1 1 -.6
        World surfaces 13
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        Normals
        12: 0 1 0
        Sector 1
        Surfaces 6 7
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5

    ## Good
        World vertices 14
        8: 1 2 -.3
        9: 0 2 -.3
        12: 0 1 -.3
        13: 1 1 -.3
        World surfaces 13
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        Normals
        12: 0 1 0
        Sector 1
        Surfaces 6 7
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5
    """
    for ledges in facts.player_ledges:
        jump = ledges.walker.jump(ledges.engine)
        for basin in facts.basins(ledges.walker, ledges.engine):
            if not basin.is_inescapable or basin.share > REST:
                continue
            first = level.surfaces[basin.surfaces[0]]
            more = f" and {len(basin.surfaces) - 1} more floors" if len(basin.surfaces) > 1 else ""
            depths, up = _figures(basin, jump)
            rims = dict.fromkeys(int(ledges.surface[row]) for row in basin.rows if ledges.of_level[row])
            yield Finding(
                Label(first.head_span),
                f"{first.title}{more} {'lie' if more else 'lies'} {depths} JKU below the floors that lead in, "
                f"but a jump takes {ledges.walker.title} up {up} JKU",
                "add steps or a lift, or make it deadly",
                first.subject,
                tuple(Label(level.surfaces[rim].head_span, f"surface {rim} leads in") for rim in list(rims)[:4]),
            )


def _figures(basin: Basin, jump: float) -> tuple[str, str]:
    """The least and the greatest depth, or one where they read the same; and the jump."""
    least, up = told_apart(basin.shallowest, jump, 4)
    greatest = f"{basin.deepest:.4g}"
    return least if f"{basin.shallowest:.4g}" == greatest else f"{least} to {greatest}", up
