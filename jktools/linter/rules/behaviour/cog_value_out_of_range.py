"""JK653: a placed script that names an object which the level does not have."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK653", "cog-value-out-of-range", severity=Severity.WARNING, since="0.1.0")
def cog_value_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a value of a placed script that names a thing, surface, sector or cog which the level does not have.

    ## Why it matters
    What the script does to it does nothing; verbs that do not look can crash the game. -1 means none, and is not
    reported.

    ## Bad
        World cogs 1
        0: door.cog 4000
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
    things = {thing.number for thing in level.things if thing.dropped is None}
    counts = {"surface": len(level.surfaces), "sector": len(level.sectors), "cog": len(level.cogs)}
    for instance in facts.instances:
        for each in instance.values:
            number = each.value
            if each.slot.type not in (*counts, "thing") or not isinstance(number, int) or number == -1:
                continue
            if each.slot.type == "thing":
                exists, held = number in things, f"has no thing {number}"
            else:
                count = counts[each.slot.type]
                exists, held = 0 <= number < count, f"has {numbered(count, each.slot.type)}"
            if not exists:
                yield Finding(
                    Label(instance.value_span(each.position)),
                    f"{instance.cog.title} gives {each.slot.name} {each.slot.type} {number}, but the level {held}",
                    "name one that exists, or -1 for none",
                    instance.cog.subject,
                )
