"""JK120: a template whose name the game's static.jkl has already."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK120", "template-shadowed", severity=Severity.WARNING, since="0.1.0")
def template_shadowed(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template that the game's static.jkl defines otherwise; only where a base holds one.

    ## Why it matters
    The engine reads static.jkl when it starts and keeps the first template of a name (sithTemplate_Parse in the
    decompiled engine): what the level says differently never happens. Lines that say the same are not reported.
    """
    base = level.resolved_templates.base
    if base is None:
        return
    for template in level.templates:
        first = base.by_name.get(template.name.lower())
        if first is None or template.broken:
            continue
        own = template.resolved
        same = {k: s.value for k, s in own.values.items()} == {k: s.value for k, s in first.values.items()}
        if not same:
            yield Finding(
                Label(template.head_span),
                f"{template.title} differs from the template of that name in {first.owner.level.path}, but that is "
                "read first and stays",
                "give it a name of its own",
                template.subject,
                (Label(first.owner.head_span, "stays"),),
            )
