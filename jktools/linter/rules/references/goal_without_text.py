"""JK115: a goal that is shown to the player and has no text."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resources import Kind
from jktools.syntax.assets.strings import Strings

TABLE = "cogstrings.uni"
BASE_BIN = 99
"""The bin of the player that holds the number of the level's first text."""
MOST_GOALS = 50
"""Goals that the game lists, from 0."""
SHOWN = 1
"""The flag of a goal that is listed."""


@rule("JK115", "goal-without-text", severity=Severity.WARNING, since="0.1.0")
def goal_without_text(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a goal that a placed script shows and that misc/cogStrings.uni has no text for.

    ## Why it matters
    The list of objectives leaves out a goal without text. The text of goal n has the key `GOAL_` and five digits: n
    plus what bin 99 of the player holds, which a script of the level sets (jkGuiObjectives_Show in the decompiled
    engine). The list has 50 goals, from 0. Judged is a level with a string table at hand, whose placed scripts call
    `SetGoalFlags` with a known goal and put known numbers into bin 99; where none of them does, nothing is told.

    ## Bad
        World cogs 1
        0: goals.cog
        == cog/goals.cog
        symbols
        message startup
        thing player local
        end
        code
        startup:
            player = GetLocalPlayerThing();
            SetInv(player, 99, 1000);
            SetGoalFlags(player, 1, 1);
            return;
        end
        == misc/cogStrings.uni
        MSGS 1
        "GOAL_01000" 0 "Find the door"
        END

    ## Good
        World cogs 1
        0: goals.cog
        == cog/goals.cog
        symbols
        message startup
        thing player local
        end
        code
        startup:
            player = GetLocalPlayerThing();
            SetInv(player, 99, 1000);
            SetGoalFlags(player, 0, 1);
            return;
        end
        == misc/cogStrings.uni
        MSGS 1
        "GOAL_01000" 0 "Find the door"
        END
    """
    table = level.resources.asset(Kind.STRINGS, TABLE)
    if not isinstance(table, Strings):
        return
    sites = [
        (instance, site)
        for instance in facts.instances
        if instance.analysis is not None
        and instance.script is not None
        and _may_show(instance.script.script.source.data)
        for site in instance.analysis.rates.sites
        if len(site.call.arguments) == len(site.verb.args)
    ]
    bases: set[int] = set()
    for _, site in sites:
        if site.verb.name in ("setinv", "changeinv") and site.arguments[1].number in (BASE_BIN, None):
            number = site.arguments[2].number
            if site.verb.name == "changeinv" or site.arguments[1].number is None or number is None:
                return
            bases.add(int(number))
    told: set[int] = set()
    for instance, site in sites:
        if site.verb.name != "setgoalflags":
            continue
        goal, flags = site.arguments[1].number, site.arguments[2].number
        if goal is None or flags is None or not int(flags) & SHOWN or int(goal) in told:
            continue
        keys = [f"GOAL_{base + int(goal):05d}" for base in sorted(bases)]
        listed = 0 <= goal < MOST_GOALS
        if not keys or (listed and any(key.lower() in table.texts for key in keys)):
            continue
        told.add(int(goal))
        assert instance.script is not None
        yield Finding(
            Label(instance.cog.head_span),
            f"{instance.cog.title} shows goal {int(goal)}, but "
            + (
                f"{table.source.path} has no {' or '.join(keys)}" if listed else f"the game lists 0 to {MOST_GOALS - 1}"
            ),
            "add the text; the list of objectives leaves the goal out" if listed else "choose a number that it lists",
            instance.cog.subject,
            (instance.script.label(site.call, "the call"),),
        )


def _may_show(code: bytes | memoryview) -> bool:
    """Whether a script is worth following: it has to name one of the verbs."""
    lower = bytes(code).lower()
    return b"goalflags" in lower or b"inv" in lower
