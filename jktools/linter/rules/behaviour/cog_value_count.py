"""JK651: a cogs line with more values than its script takes, or fewer."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK651", "cog-value-count", severity=Severity.WARNING, since="0.1.0")
def cog_value_count(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a placed script that gets more values than it has symbols for, or fewer.

    ## Why it matters
    Values go to the symbols in their order, without their names: to all but messages and those marked `local`. A
    script that was changed after it was placed gets every value behind the change in the wrong symbol. What is missing
    at the end falls back on the defaults of the script; what is too much is ignored.

    ## Bad
        World cogs 1
        0: door.cog 0 1 2.5
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
        0: door.cog 0
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
        if instance.script is None or instance.cog.broken:
            continue
        given, wanted = len(instance.cog.values), len(instance.script.program.valued)
        if given == wanted:
            continue
        if given < wanted:
            effect = f"{instance.script.program.valued[given].name} and what follows keep their defaults"
            if wanted - given == 1:
                effect = f"{instance.script.program.valued[given].name} keeps its default"
        else:
            effect = "the last ones are ignored"
        yield Finding(
            Label(instance.cog.head_span if given < wanted else instance.value_span(wanted)),
            f"{instance.cog.title} has {given} values, but its script takes {wanted}: {effect}",
            "give each symbol that is neither local nor a message its value",
            instance.cog.subject,
        )
