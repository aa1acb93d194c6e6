"""JK536: a label named as a message that the script does not declare."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK536", "label-without-message", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def label_without_message(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a label that is named as a message, when the symbols do not declare this message.

    ## Why it matters
    Only a declared message runs its label. Without `message` in the symbols the code below the label never runs,
    unless code above falls into it, or a `goto` or `call` names it: such a label is not reported. The label of a
    message that is declared, but one too many, is left to too-many-messages.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            SetPulse(1.0);
            return;
        pulse:
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
    dropped = {symbol.name.key for symbol in script.header.dropped if symbol.type == "message"}  # JK512 and JK514
    declared = {symbol.name.key for symbol, _ in program.declared_messages} | dropped
    live = frozenset(facts.reach.live)
    for name, label in program.labels.items():
        if name in declared or name not in facts.vocabulary.messages:
            continue
        if facts.analysis.flow.label_block[name] not in live:
            yield Finding(
                facts.label(label.label),
                f'label "{name}" is named as a message, but the symbols do not declare it',
                f'declare "message {name}" in the symbols',
            )
