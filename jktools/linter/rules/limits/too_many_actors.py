"""JK802: more actors than the engine can move."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST_ACTORS = 256
"""Things with an AI (sithAI.h in the decompiled engine)."""


@rule("JK802", "too-many-actors", severity=Severity.WARNING, since="0.1.0")
def too_many_actors(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level that places more than 256 things of type actor.

    ## Why it matters
    The engine has room for the thoughts of 256. The others stand where they were placed.
    """
    actors = [i for i, thing in enumerate(level.resolved_things) if thing.type == "actor"]
    if len(actors) <= MOST_ACTORS:
        return
    first = level.things[actors[MOST_ACTORS]]
    yield Finding(
        Label(first.head_span),
        f"the level places {len(actors)} actors, but the engine has room for {MOST_ACTORS}; {first.title} is the first "
        "without",
        "place fewer, or let a COG create some when they are needed",
        first.subject,
    )
