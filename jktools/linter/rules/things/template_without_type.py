"""JK406: a template that neither has nor inherits a type."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.template_record import FREE


@rule("JK406", "template-without-type", severity=Severity.WARNING, since="0.1.0")
def template_without_type(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template that has no `type`, and whose parents have none either.

    ## Why it matters
    Its type is then `free`, and the engine drops such a template once it has read it: nothing can be placed or created
    from it. Templates with parents that the level does not define are not judged. Modders' advice that a template with
    a 3DO needs a parent comes to this: the parent `none` does no harm, and what a parent brings is the type.

    ## Bad
        World templates 4
        bigcrate none collide=1 size=.2

    ## Good
        World templates 4
        bigcrate crate size=.2
    """
    for template in level.templates:
        held = template.resolved
        first = level.template_by_name[template.name.lower()] == template.index
        if held.type != FREE or held.leaves_level or template.broken or not first:
            continue
        yield Finding(
            Label(template.head_span),
            f"{template.title} neither has nor inherits a type, but the engine drops a template without one"
            if "type" not in held.values
            else f"{template.title} has the type free, but the engine drops such a template",
            "add type= to it, or give it a parent that has one",
            template.subject,
        )
