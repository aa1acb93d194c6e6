"""JK405: a template with the name of one above it."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK405", "template-defined-twice", severity=Severity.WARNING, since="0.1.0")
def template_defined_twice(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template with the name of one above it, in any case.

    ## Why it matters
    The engine keeps the first and ignores the second: what the second says differently never happens.

    ## Bad
        World templates 4
        Crate,none,type=cog,collide=1,size=.2

    ## Good
        World templates 4
        crate2 none type=cog collide=1 size=.2
    """
    for index, name in enumerate(level.document.templates.names):
        first = level.template_by_name[name.lower()]
        template = level.templates[index]
        if first == index or template.broken:
            continue
        other = level.templates[first]
        same = template.parameters == other.parameters and template.parent_name.lower() == other.parent_name.lower()
        yield Finding(
            Label(template.head_span),
            f"{template.title} has the name of template {first} above, but only the first of a name counts",
            "delete the line: it says the same" if same else "rename one of the two, or join them",
            template.subject,
            (Label(other.head_span, f"template {first}"),),
        )
