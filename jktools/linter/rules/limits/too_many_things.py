"""JK801: more things than the engine has numbers for."""

from collections.abc import Iterator
from typing import Annotated

import msgspec

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Limits(Options, frozen=True):
    """What the engine holds."""

    things: Annotated[int, msgspec.Meta(ge=1, description="things that a level may announce")] = 641


@rule("JK801", "too-many-things", severity=Severity.ERROR, since="0.1.0", options=Limits)
def too_many_things(level: Level, facts: LevelFacts, options: Limits) -> Iterator[Finding]:
    """Report a level that announces more than 641 things.

    ## Why it matters
    The number in the heading is what the level places and what is created in play, together. The original engine
    takes a thing numbered 640 or more for none at all (sithThing_GetIdxFromThing in the decompiled engine); editors
    and players speak of 640. OpenJKDF2 takes 32000: set the option if your level is for it alone.

    ## Bad
        World things 653

    ## Good
        World things 641
    """
    heading = level.document.things.heading
    if heading is None or heading.count <= options.things:
        return
    yield Finding(
        Label(level.line_span(heading.line)),
        f"the heading announces {heading.count} things, but the original engine takes {options.things}",
        f"announce fewer: the level places {len(level.things)}",
    )
