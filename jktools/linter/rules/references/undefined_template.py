"""JK103: a thing whose template the level does not define."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model import Level


@rule("JK103", "undefined-template", severity=Severity.WARNING, since="0.1.0")
def undefined_template(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a thing whose template the level does not define.

    ## Why it matters
    The engine looks the name up in the level and then in the game's static.jkl. Where neither has it, it places a
    blank thing that does nothing; JED and SED leave such a thing out when they save.

    ## Bad
        World things 3
        1: gohst ghost .5 1.5 .5 0 0 0 1

    ## Good
        World things 3
        1: Ghost ghost .5 1.5 .5 0 0 0 1
    """
    known = {*level.template_by_name, *level.game_templates}
    missing = level.nobody_defines or "the level defines none of that name"
    for index, name in enumerate(level.document.things.templates):
        thing = level.things[index]
        if name.lower() in known or thing.broken:
            continue
        yield Finding(
            Label(thing.field_span("template")),
            f'{thing.title} names template "{name}", but {missing}',
            did_you_mean(name, known) or "define the template, unless the game's static.jkl has it",
            thing.subject,
        )
