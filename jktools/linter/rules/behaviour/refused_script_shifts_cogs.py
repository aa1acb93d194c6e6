"""JK654: a script that the engine refuses, and that moves the numbers of the cogs behind it."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.cog.instance import InstanceFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST_NAMED = 5


@rule("JK654", "refused-script-shifts-cogs", severity=Severity.ERROR, since="0.1.0")
def refused_script_shifts_cogs(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a placed script that the engine refuses, with the scripts that now name the wrong cog.

    ## Why it matters
    Such a script makes no cog, and the next one takes its number: every later cog has a number one lower than its
    line. Other scripts that name a cog by number then talk to the wrong one.

    ## Bad
        World cogs 2
        0: broken.cog
        1: door.cog 1
        == cog/broken.cog
        symbols
        end
        code
        end
        == cog/door.cog
        symbols
        message startup
        cog partner
        end
        code
        startup: SendMessage(partner, user0); return;
        end

    ## Good
        World cogs 2
        0: whole.cog
        1: door.cog 1
        == cog/whole.cog
        symbols
        end
        code
        ;
        end
        == cog/door.cog
        symbols
        message startup
        cog partner
        end
        code
        startup: SendMessage(partner, user0); return;
        end
    """
    instances = facts.instances
    for index, instance in enumerate(instances):
        if instance.number >= 0 or instance.script is None:
            continue
        wrong = _misled(instances, index)
        later = len(instances) - index - 1
        message = f"the engine refuses the script of {instance.cog.title}, so that the {later} cogs behind it get "
        message += "numbers one lower" if later != 1 else ""
        if later <= 1:
            message = f"the engine refuses the script of {instance.cog.title}"
            message += ", so that the cog behind it gets its number" if later else ", so that it makes no cog"
        related = [Label(each.cog.span, f"{each.cog.title} now names the wrong cog") for each in wrong[:MOST_NAMED]]
        if len(wrong) > MOST_NAMED:
            message += f"; {len(wrong)} scripts now name the wrong cog"
        yield Finding(
            Label(instance.cog.head_span),
            message,
            "mend the script, or remove the line",
            instance.cog.subject,
            tuple(related),
        )


def _misled(instances: tuple[InstanceFacts, ...], refused: int) -> list[InstanceFacts]:
    """The placed scripts that name a cog at or behind a line."""
    return [
        each
        for each in instances
        if any(
            bound.slot.type == "cog" and isinstance(bound.value, int) and refused <= bound.value < len(instances)
            for bound in each.values
        )
    ]
