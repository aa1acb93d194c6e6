"""JK107: a parameter that names a template which the level does not define."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model import Level, Template, Thing
from jktools.syntax.template.parameters import TEMPLATE_KEYS

NO_TEMPLATE = "none"


@rule("JK107", "undefined-template-reference", severity=Severity.WARNING, since="0.1.0")
def undefined_template_reference(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a parameter of a template or thing that names a template which the level does not define.

    ## Why it matters
    The engine looks the name up in the level and then in the game's static.jkl. Where neither has it, the parameter
    stays empty, so that nothing explodes, is shot or is created.

    ## Bad
        World templates 4
        barrel none type=actor explode=+bom

    ## Good
        World templates 4
        barrel none type=actor explode=none
    """
    known = {*level.template_by_name, *level.game_templates}
    missing = level.nobody_defines or "the level defines no template of that name"
    owners: list[Template | Thing] = [*level.templates, *level.things]
    for owner in owners:
        for key, value in owner.parameters:
            name = value.lower()
            if key.lower() not in TEMPLATE_KEYS or name in known or name == NO_TEMPLATE:
                continue
            yield Finding(
                Label(owner.span),
                f"{owner.title} has {key}={value}, but {missing}",
                did_you_mean(name, known) or "define it, unless the game's static.jkl has it",
                owner.subject,
            )
