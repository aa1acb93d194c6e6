"""JK411: a parameter that does nothing for things of its type."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.things.parameter_before_type import later_enabler
from jktools.model import Level
from jktools.model.resolved import Ignored, Reason
from jktools.syntax.template.parameters import PARAMETERS


@rule("JK411", "parameter-without-effect", severity=Severity.WARNING, since="0.1.0")
def parameter_without_effect(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a parameter that the engine passes over for things of that type or way to move.

    ## Why it matters
    `health` is for actors and players, `damage` for weapons and explosions, `mass` for what moves by physics. On other
    things the engine passes over them without a word. One that comes before the `type` or `move` that it needs is left
    to parameter-before-type. Templates whose parents the level does not define are not judged.

    ## Bad
        World templates 4
        +bolt none type=weapon health=25

    ## Bad
        World things 3
        1: crate crate .5 1.5 .5 0 0 0 1 mass=5

    ## Good
        World templates 4
        +bolt none type=weapon damage=25
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        for ignored in held.ignored:
            told = _told(ignored)
            if told is None or (held.leaves_level and ignored.reason is Reason.NOT_FOR_THIS):
                continue
            if ignored.reason is Reason.OTHER_GAME and not level.has_geometry:
                continue  # a template library does not say for which game it is
            yield Finding(
                Label(ignored.origin.span),
                f"{held.owner.title} has {ignored.origin.span.text}, but {told}",
                "remove it, or write the parameter that you mean",
                held.owner.subject,
            )


def _told(ignored: Ignored) -> str | None:
    match ignored.reason:
        case Reason.NOT_FOR_THIS if later_enabler(ignored) is None:
            scopes = dict.fromkeys(use.scope.value for use in PARAMETERS[ignored.key].uses)
            return f"that is for {' or '.join(scopes)}, and this is of type {ignored.type} with move {ignored.move}"
        case Reason.NO_HANDLER | Reason.OTHER_GAME:
            return str(ignored.reason.value)
        case _:
            return None
