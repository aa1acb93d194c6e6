"""JK803: more player starts than the engine has players."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.things.no_player_start import PLAYER
from jktools.model import Level

MOST_PLAYERS = 32
"""Players of one game (jkPlayer.h in the decompiled engine)."""


@rule("JK803", "too-many-player-starts", severity=Severity.WARNING, since="0.1.0")
def too_many_player_starts(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level that places more than 32 things of type player.

    ## Why it matters
    The engine knows 32 players and gives no start beyond that to anybody.
    """
    starts = [i for i, thing in enumerate(level.resolved_things) if thing.type == PLAYER]
    if len(starts) <= MOST_PLAYERS:
        return
    first = level.things[starts[MOST_PLAYERS]]
    yield Finding(
        Label(first.head_span),
        f"the level places {len(starts)} player starts, but the engine knows {MOST_PLAYERS} players; {first.title} is "
        "the first without",
        "delete the starts that are too many",
        first.subject,
    )
