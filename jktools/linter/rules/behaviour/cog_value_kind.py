"""JK652: a value that its symbol cannot read."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK652", "cog-value-kind", severity=Severity.WARNING, since="0.1.0")
def cog_value_kind(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a value of a placed script that its symbol cannot read in full.

    ## Why it matters
    The engine reads as much of the text as is a number of the symbol's type, and 0 when that is nothing: `0x10` for an
    int is 0, `0.5` is 0 too, and a vector that is not written `(x/y/z)` is the zero vector.

    ## Bad
        World cogs 1
        0: door.cog 0x1
        == cog/door.cog
        symbols
        message startup
        surface panel
        end
        code
        startup: return;
        end

    ## Good
        World cogs 1
        0: door.cog 1
        == cog/door.cog
        symbols
        message startup
        surface panel
        end
        code
        startup: return;
        end
    """
    for instance in facts.instances:
        for each in instance.values:
            if not each.is_read_whole:
                form = {"vector": "(x/y/z)", "flex": "a number", "float": "a number"}.get(
                    each.slot.type, "a whole number"
                )
                yield Finding(
                    Label(instance.value_span(each.position)),
                    f'{instance.cog.title} gives {each.slot.type} {each.slot.name} "{each.text}", but it reads {form}',
                    f"write {form}",
                    instance.cog.subject,
                )
