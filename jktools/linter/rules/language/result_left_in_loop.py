"""JK547: results that pile up on the stack."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

STACK = 64
"""Entries of the stack of Jedi Knight and of Mysteries of the Sith (the layout of the decompiled structures)."""


@rule("JK547", "result-left-in-loop", severity=Severity.INFO, since="0.1.0", on=False, looks_at=Script)
def result_left_in_loop(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a verb in a loop whose result nobody takes, when the loop can run often enough to fill the stack.

    ## Why it matters
    A result that nobody takes stays on the stack until the handler ends. The stack has 64 entries; from then on each
    new entry pushes out the oldest, which a suspended handler below may still need. It is off by default, since most
    scripts do no harm with it.

    ## Bad
        symbols
        message startup
        sound alarm=alarm.wav local
        end
        code
        startup:
            while (1)
            {
                PlaySoundLocal(alarm, 1.0, 0, 0);
                Sleep(2.0);
            }
        end

    ## Good
        symbols
        message startup
        sound alarm=alarm.wav local
        int channel local
        end
        code
        startup:
            while (1)
            {
                channel = PlaySoundLocal(alarm, 1.0, 0, 0);
                Sleep(2.0);
            }
        end
    """
    dropped = facts.program.dropped
    for site in facts.rates.sites:
        if not site.verb.gives or site.call not in dropped:
            continue
        for label in facts.rates.senders_of(site):
            repeats = facts.rates.repeats_of(label, site)
            if repeats.per_run > STACK or repeats.per_second:
                yield Finding(
                    facts.label(site.call),
                    f"{site.verb.name} leaves a value on the stack in each turn of a loop, but the stack holds {STACK}",
                    "assign the value to a variable",
                )
                break
