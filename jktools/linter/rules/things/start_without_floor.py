"""JK420: a player start with no floor below."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.standing import bodies, unsupported
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.things.no_player_start import PLAYER
from jktools.model import Level


@rule("JK420", "start-without-floor", severity=Severity.WARNING, since="0.1.0")
def start_without_floor(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a player start straight below which there is no surface that players stand on.

    ## Why it matters
    The player falls as soon as the level starts, or slides on a surface without the floor flag. Starts in water, in
    thrust or without gravity are left out, and so are those that a thing may carry.

    ## Bad
        World surfaces 12
        0: 0 0x4 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1

    ## Good
        World surfaces 12
        0: 0 0x5 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1
    """
    starts = [thing for thing in bodies(level) if thing.resolved.type == PLAYER]
    for thing, found in zip(starts, unsupported(level, facts.mesh, facts.floors, starts), strict=True):
        if found is None:
            continue
        surface = None if found.surface is None else level.surfaces[found.surface]
        yield Finding(
            Label(thing.field_span("x")),
            f"{thing.title} starts a player, but nothing below holds anybody up"
            if surface is None
            else f"{thing.title} starts a player, but {surface.title} below has no floor flag (0x1)",
            "move the start, or give the floor below its flags (0x5)"
            if surface is None
            else "flag the surface as floor, or move the start",
            thing.subject,
            () if surface is None else (Label(surface.head_span, f"surface {surface.index}"),),
        )
