"""JK555: a symbol that the code never names."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Index


@rule("JK555", "unused-symbol", severity=Severity.INFO, since="0.1.0", on=False, looks_at=Script)
def unused_symbol(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a symbol that the code never names.

    ## Why it matters
    It does nothing, unless the engine links it: a thing, surface or sector that is linked sends its messages all the
    same, and is not reported; nor is anything in a script that walks its symbols as an array. It is off by default,
    since old scripts carry many.

    ## Bad
        symbols
        message startup
        int spare local
        end
        code
        startup:
            return;
        end

    ## Good
        symbols
        message startup
        int count local
        end
        code
        startup:
            count = count + 1;
            return;
        end
    """
    program = facts.program
    if not facts.is_whole or program.of_kind(Index):
        return
    for slot in program.slots:
        if slot.declared is None or slot.type == "message" or program.slot_of[slot.name] is not slot:
            continue
        linked = slot.type in ("thing", "surface", "sector") and slot.declared.link >= 0
        if not linked and slot.name not in program.read and slot.name not in program.assigned:
            yield Finding(facts.label(slot.declared), f'nothing uses symbol "{slot.name}"', "remove it")
