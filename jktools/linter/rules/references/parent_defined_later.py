"""JK105: a template whose parent comes after it."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK105", "parent-defined-later", severity=Severity.WARNING, since="0.1.0")
def parent_defined_later(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template whose parent is defined behind it, or is the template itself.

    ## Why it matters
    The engine reads templates from the first to the last and knows only those above: the template starts blank and
    lacks all that it should inherit.

    ## Bad
        World templates 5
        bigbox box size=.2
        box none type=cog size=.1

    ## Good
        World templates 5
        box none type=cog size=.1
        bigbox box size=.2
    """
    for template in level.templates:
        at = level.template_by_name.get(template.parent_name.lower(), -1)
        if template.broken or at < template.index or template.parent_name.lower() in level.game_templates:
            continue
        parent = level.templates[at]
        itself = at == template.index
        yield Finding(
            Label(template.field_span("parent")),
            f"{template.title} is its own parent, but a parent must stand above"
            if itself
            else f"{template.title} has the parent {parent.name}, but that stands below, as template {at}",
            "name another parent, or none" if itself else f"move {parent.name} above {template.name}",
            template.subject,
            () if itself else (Label(parent.head_span, f"template {at}"),),
        )
