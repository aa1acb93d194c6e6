"""JK548: a symbol that hides a verb which the code calls."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK548", "shadowed-verb", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def shadowed_verb(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a symbol that has the name of a verb, when the code calls this verb.

    ## Why it matters
    The script's own symbols come before the verbs: the name means the symbol, and the call does nothing.

    ## Bad
        symbols
        message startup
        flex sleep=2.0
        end
        code
        startup:
            Sleep(2.0);
            return;
        end

    ## Good
        symbols
        message startup
        flex pause=2.0
        end
        code
        startup:
            Sleep(pause);
            return;
        end
    """
    program = facts.program
    for name, places in program.called.items():
        slot = program.slot_of.get(name)
        if slot is None or slot.declared is None or name not in facts.vocabulary.verbs:
            continue
        for place in places:
            yield Finding(
                facts.label(place),
                f'"{name}" is called as the verb, but the symbol "{name}" hides it',
                "give the symbol another name",
                related=(facts.label(slot.declared, f"symbol {name}"),),
            )
