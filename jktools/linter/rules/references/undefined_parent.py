"""JK104: a template whose parent the level does not define."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model import Level

NO_PARENT = "none"


@rule("JK104", "undefined-parent", severity=Severity.WARNING, since="0.1.0")
def undefined_parent(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template whose parent the level does not define.

    ## Why it matters
    The engine looks the parent up in the level and then in the game's static.jkl. Where neither has it, the template
    starts blank and lacks all that it should inherit, often its type, without which it is dropped.

    ## Bad
        World templates 4
        bigcrate crat size=.2

    ## Good
        World templates 4
        bigcrate crate size=.2
    """
    known = {*level.template_by_name, *level.game_templates}
    missing = level.nobody_defines or "the level defines no such template"
    for template in level.templates:
        parent = template.parent_name.lower()
        if template.broken or parent == NO_PARENT or parent in known:
            continue
        yield Finding(
            Label(template.field_span("parent")),
            f'{template.title} has the parent "{template.parent_name}", but {missing}',
            did_you_mean(parent, known) or "define the parent, unless the game's static.jkl has it",
            template.subject,
        )
