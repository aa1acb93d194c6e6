"""JK414: a value that the engine reads as something else than is written."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Origin, Resolved, Setting
from jktools.syntax.template.values import ValueKind, scan, well_formed


@rule("JK414", "loosely-written-value", severity=Severity.WARNING, since="0.1.0")
def loosely_written_value(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a number, flags or vector of a parameter with text that the engine does not read.

    ## Why it matters
    The engine takes the longest piece from the left that is a number, and 0 where there is none: `0,5` loses what is
    behind the comma, `0x10` in a decimal field is 0, `1.2.3` is 1.2.

    ## Bad
        World templates 4
        ball crate size=big

    ## Bad
        World templates 4
        ball crate collide=0x1

    ## Good
        World templates 4
        ball crate size=.5 collide=1
    """
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        for key, setting, text, origin in _own(held):
            if setting.use.kind is ValueKind.WORD or well_formed(setting.use.kind, text):
                continue
            read = scan(setting.use.kind, text)
            yield Finding(
                Label(origin.span),
                f"{held.owner.title} has {origin.span.text}, but the engine reads {key} as {_shown(read)}",
                f"write {setting.use.kind.form}",
                held.owner.subject,
            )


def _own(held: Resolved) -> Iterator[tuple[str, Setting, str, Origin]]:
    """What the own line sets, with each text as written."""
    words = held.owner.parameters
    for key, setting in held.values.items():
        for origin in setting.origins:
            if origin.owner is held.owner and origin.place >= 0 and words[origin.place][0].lower() == key:
                yield key, setting, words[origin.place][1], origin


def _shown(value: object) -> str:
    return "/".join(f"{part:g}" for part in value) if isinstance(value, tuple) else f"{value:g}"
