"""JK106: a parameter that names a template which comes later."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.syntax.template.parameters import TEMPLATE_KEYS


@rule("JK106", "template-reference-defined-later", severity=Severity.WARNING, since="0.1.0")
def template_reference_defined_later(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template with a parameter that names a template below it, or itself.

    ## Why it matters
    The engine resolves `creatething`, `explode`, `weapon`, `debris` and the like while it reads the template and
    knows only those above: the parameter stays empty, so that nothing explodes, is shot or is created. For the same
    reason no template creates itself, alone or by way of others, whatever its lines say.

    ## Bad
        World templates 5
        barrel none type=actor explode=+boom
        +boom none type=explosion

    ## Good
        World templates 5
        +boom none type=explosion
        barrel none type=actor explode=+boom
    """
    for template in level.templates:
        for key, value in template.parameters:
            at = level.template_by_name.get(value.lower(), -1)
            if key.lower() not in TEMPLATE_KEYS or at < template.index or value.lower() in level.game_templates:
                continue
            yield Finding(
                Label(template.span),
                f"{template.title} has {key}={value}, but is that itself, and knows only what stands above"
                if at == template.index
                else f"{template.title} has {key}={value}, but {value} stands below, as template {at}",
                "remove it, or let a COG create it" if at == template.index else f"move {value} above {template.name}",
                template.subject,
                () if at == template.index else (Label(level.templates[at].head_span, f"template {at}"),),
            )
