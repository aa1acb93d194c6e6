"""JK657: a verb on adjoins, used on a surface without one."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

VERBS = {
    "setadjoinflags": "does nothing",
    "clearadjoinflags": "does nothing",
    "getadjoinflags": "gives no flags",
    "getsurfaceadjoin": "crashes the game",
}


@rule("JK657", "adjoin-verb-without-adjoin", severity=Severity.WARNING, since="0.1.0")
def adjoin_verb_without_adjoin(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a placed script that uses a verb on adjoins on a surface which has none.

    ## Why it matters
    Such a surface is solid: there is nothing to open or shut. `GetSurfaceAdjoin` does not look and crashes the game
    (the decompiled engine). Judged is the surface that the level's `cogs` line names.

    ## Bad
        World cogs 1
        0: field.cog 1
        == cog/field.cog
        symbols
        message startup
        surface panel
        end
        code
        startup: ClearAdjoinFlags(panel, 2); return;
        end

    ## Good
        World cogs 1
        0: field.cog 3
        == cog/field.cog
        symbols
        message startup
        surface panel
        end
        code
        startup: ClearAdjoinFlags(panel, 2); return;
        end
    """
    for instance in facts.instances:
        if instance.analysis is None or instance.script is None:
            continue
        for site in instance.analysis.rates.sites:
            effect = VERBS.get(site.verb.name)
            if effect is None or len(site.call.arguments) != len(site.verb.args):
                continue
            number = site.arguments[0].number
            if number is None or not 0 <= number < len(level.surfaces) or number != int(number):
                continue
            surface = level.surfaces[int(number)]
            if surface.adjoin_index < 0:
                yield Finding(
                    Label(instance.cog.head_span),
                    f"{instance.cog.title} uses {site.verb.name} on surface {surface.index}, but it has no adjoin: the "
                    f"call {effect}",
                    "name a surface with an adjoin",
                    instance.cog.subject,
                    (instance.script.label(site.call, "the call"), Label(surface.head_span, surface.title)),
                )
