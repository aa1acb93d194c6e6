"""JK535: a declared message that the code has no label for."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.syntax.cog import Script


@rule("JK535", "message-without-label", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def message_without_label(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a message that is declared, but that the code has no label for.

    ## Why it matters
    The engine looks for a label of the message's name and ignores the message when there is none. Often the label is
    misspelt, or stands in a comment together with its code.

    ## Bad
        symbols
        message startup
        message pulse
        end
        code
        startup:
            SetPulse(1.0);
            return;
        plse:
            Print("pulse");
            return;
        end

    ## Good
        symbols
        message startup
        message pulse
        end
        code
        startup:
            SetPulse(1.0);
            return;
        pulse:
            Print("pulse");
            return;
        end
    """
    program = facts.program
    if not facts.is_whole:
        return
    declared = {symbol.name.key for symbol, _ in program.declared_messages}
    for symbol, message in program.declared_messages:
        label = symbol.name.key
        if message is None or label in program.labels:
            continue
        spare = [name for name in program.labels if name not in declared]
        yield Finding(
            facts.label(symbol),
            f'message "{label}" is declared, but the code has no label "{label}"',
            did_you_mean(label, spare) or "add the label, or remove the message",
        )
