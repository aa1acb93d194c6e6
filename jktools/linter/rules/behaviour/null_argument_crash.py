"""JK607: a null argument where the game crashes on one."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK607", "null-argument-crash", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def null_argument_crash(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an argument that never names anything, where the verb does not look and the game crashes.

    ## Why it matters
    A few verbs use their thing, cog or text without looking whether there is one. Reported is only what is none
    whenever the code runs.

    ## Bad
        symbols
        message startup
        thing player=-1 local
        end
        code
        startup:
            jkSetInvis(player, 5);
            return;
        end

    ## Good
        symbols
        message startup
        thing player local
        end
        code
        startup:
            player = GetLocalPlayerThing();
            jkSetInvis(player, 5);
            return;
        end
    """
    for site in facts.rates.sites:
        if not site.verb.crashes or not site.call.arguments or len(site.call.arguments) != len(site.verb.args):
            continue
        argument, value = site.verb.args[0], site.arguments[0]
        if not value.kinds & ranges.STRING if argument.kind == "string" else ranges.as_int(value)[1] < 0:
            yield Finding(
                facts.label(site.call.arguments[0]),
                f"{site.verb.name} crashes the game without a {argument.kind}, but this is none",
                f"give it a {argument.kind} that exists",
            )
