"""JK806: a COGS heading with too few places."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import counted
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level, Template, Thing


@rule("JK806", "too-few-cog-slots", severity=Severity.WARNING, since="0.1.0")
def too_few_cog_slots(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a COGS heading that announces fewer COGs than the level places and its templates and things have.

    ## Why it matters
    Every `cog=` of a template or thing takes one of the places that the heading announces, behind those that are
    placed (sithCog_LoadCogscript in the decompiled engine). When they run out, the last ones get none: their things
    do nothing. A place is only taken by a COG that is found and can be read, so that a level may just do.

    ## Bad
        World cogs 1
        World templates 4
        lamp none type=cog cog=lamp.cog

    ## Good
        World cogs 2
        World templates 4
        lamp none type=cog cog=lamp.cog
    """
    heading = level.document.cogs.heading
    owners: list[Template | Thing] = [t for t in level.templates if t.dropped is None]
    owners += [t for t in level.things if t.dropped is None]
    carriers = [owner for owner in owners for key, value in owner.parameters if key.lower() == "cog"]
    placed = len(level.cogs)
    if heading is None or placed > heading.count or placed + len(carriers) <= heading.count:
        return
    first = carriers[heading.count - placed]
    yield Finding(
        Label(level.line_span(heading.line)),
        f"the heading announces {counted(heading.count, 'COG')}, but the level places {placed}, and "
        f"{counted(len(carriers), 'template or thing has', 'templates and things have')} one with cog=; "
        f"{first.title} is the first without room",
        f"write {placed + len(carriers)} or more",
        first.subject,
        (Label(first.span, first.title),),
    )
