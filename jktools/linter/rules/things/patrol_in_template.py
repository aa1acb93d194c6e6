"""JK425: a template with places of a patrol."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Reason


@rule("JK425", "patrol-in-template", severity=Severity.ERROR, since="0.1.0")
def patrol_in_template(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template of an actor that does not move on a path, with `frame` or `numframes`.

    ## Why it matters
    An actor keeps the places of its patrol in its AI, which only a placed thing has. The decompiled engine writes them
    there without looking (sithAI_LoadThingActorParams) and crashes on a template.

    ## Bad
        World templates 4
        guard none type=actor numframes=1 frame=(.5/.5/.5)

    ## Good
        World templates 4
        guard none type=actor
        World things 4
        2: guard guard .5 .5 .5 0 0 0 0 numframes=1 frame=(.5/.5/.5)
    """
    for held in level.resolved_templates.entries:
        ignored = next((i for i in held.ignored if i.reason is Reason.BEFORE_BIRTH), None)
        if ignored is not None:
            yield Finding(
                Label(ignored.origin.span),
                f"{held.owner.title} has {ignored.origin.span.text}, but only a placed actor has room for a patrol",
                "write it into the lines of the things; the engine crashes",
                held.owner.subject,
            )
