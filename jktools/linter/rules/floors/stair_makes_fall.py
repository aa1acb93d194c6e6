"""JK702: a flight of stairs on which the player falls."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.stairs import falling_flights
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK702", "stair-makes-fall", severity=Severity.INFO, since="0.1.0")
def stair_makes_fall(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a flight of stairs on which a player lets go, although each of its steps alone is low enough.

    ## Why it matters
    A body sinks to its height over a lower floor at 0.5 JKU/s. On stairs steeper than that it lags behind, step by
    step, until the next floor is out of reach: the falling animation plays, and control is lost for a moment.

    ## Bad
        World vertices 18
        8: 1 2 -.3
        9: 0 2 -.3
        12: 0 1 -.15
        13: 1 1 -.15
        14: 0 1.1 -.15
        15: 1 1.1 -.15
        16: 0 1.1 -.3
        17: 1 1.1 -.3
        World surfaces 15
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 15,2 14,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        13: 0 0x5 0x4 4 3 1 -1 0 4 16,0 17,1 8,2 9,3 1 1 1 1
        14: 0 0x4 0x4 4 3 1 -1 0 4 16,0 14,1 15,2 17,3 1 1 1 1
        Normals
        12: 0 1 0
        13: 0 0 1
        14: 0 1 0
        Sector 1
        Surfaces 6 9
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f maxthrust=2 surfdrag=3

    ## Good
        World vertices 14
        8: 1 2 -.15
        9: 0 2 -.15
        12: 0 1 -.15
        13: 1 1 -.15
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
        for flight in falling_flights(ledges):
            row = flight.rows[flight.gives_way]
            surface = level.surfaces[int(ledges.surface[row])]
            top = int(ledges.surface[flight.rows[0]])
            yield Finding(
                Label(surface.head_span),
                f"step {flight.gives_way + 1} down from surface {top} is {flight.drops[flight.gives_way]:.4g} JKU high "
                f"and comes {flight.treads[flight.gives_way - 1]:.4g} JKU after the one before, but "
                f"{ledges.walker.title} sinks 0.5 JKU/s and falls there at a {flight.gait} ({flight.speed:.4g} JKU/s)",
                "make the treads longer or the steps lower, or lay a ramp under them",
                surface.subject,
            )
