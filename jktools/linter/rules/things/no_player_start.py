"""JK408: a level in which no player can start."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import counted
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

PLAYER = "player"


@rule("JK408", "no-player-start", severity=Severity.ERROR, since="0.1.0")
def no_player_start(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level without a thing of type player.

    ## Why it matters
    The game has nobody to start the level with and does not load it. In multiplayer each player needs a start of his
    own. A level with things whose template it does not define is not judged.

    ## Bad
        World things 3
        0: ghost ghost .5 .5 .2 0 0 0 0

    ## Good
        World things 3
        0: walkplayer walkplayer .5 .5 .2 0 0 0 0
    """
    if not level.has_geometry or level.document.things.broken.any():
        return
    if any(thing.type == PLAYER or not thing.knows_type for thing in level.resolved_things):
        return
    things = level.document.sections.get("things")
    yield Finding(
        Label(level.source if things is None else level.line_span(things)),
        f"the level has {counted(len(level.things), 'thing')}, but none of type player"
        if len(level.things)
        else "the level has no things, but needs one of type player",
        "place a walkplayer where the player starts",
    )
