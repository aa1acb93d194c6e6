"""JK413: a parameter that comes before the `type` or `move` which it needs."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Ignored, Reason
from jktools.syntax.template.parameters import MOVE_SCOPE, PARAMETERS, TYPE_SCOPE


@rule("JK413", "parameter-before-type", severity=Severity.WARNING, since="0.1.0")
def parameter_before_type(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a parameter that only the `type` or `move` behind it on the line would let take effect.

    ## Why it matters
    The engine reads a line from left to right and asks, for each parameter, what the thing is at that point. A `damage`
    before `type=weapon` is passed over without a word, unless the parent is a weapon already.

    ## Bad
        World templates 4
        +bolt none damage=25 type=weapon

    ## Bad
        World templates 4
        ball crate mass=5 move=physics

    ## Good
        World templates 4
        +bolt none type=weapon damage=25
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        if held.leaves_level:
            continue
        for ignored in held.ignored:
            later = later_enabler(ignored) if ignored.reason is Reason.NOT_FOR_THIS else None
            if later is None:
                continue
            enabler = held.owner.parameter_span(later)
            yield Finding(
                Label(ignored.origin.span),
                f"{held.owner.title} has {ignored.origin.span.text} before {enabler.text}, but only things like that "
                "take it",
                f"move it behind {enabler.text}",
                held.owner.subject,
                (Label(enabler, "stands behind"),),
            )


def later_enabler(ignored: Ignored) -> int | None:
    """The place of a `type` or `move` further right that serves the parameter; None when there is none."""
    scopes = {use.scope for use in PARAMETERS[ignored.key].uses}
    for place, (key, value) in enumerate(ignored.origin.owner.parameters):
        if place > ignored.origin.place:
            served = {"type": TYPE_SCOPE, "move": MOVE_SCOPE}.get(key.lower(), {}).get(value.lower())
            if served in scopes:
                return place
    return None
