"""JK566: a label that nothing names."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Labeled


@rule("JK566", "unused-label", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def unused_label(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a label that no message, `goto` or `call` names, and that no code runs into.

    ## Why it matters
    What stands below it never runs. Mostly the message is misspelt, or the `message` line is missing. Labels with the
    name of a message have a rule of their own.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            return;
        open_it:
            Print("open");
            return;
        end

    ## Good
        symbols
        message startup
        end
        code
        startup:
            call open_it;
            return;
        open_it:
            Print("open");
            return;
        end
    """
    program = facts.program
    if not facts.is_whole:
        return
    named = {jump.label.name for jump in program.jumps}
    named.update(symbol.name.key for symbol, _ in program.declared_messages)
    named.update(program.called, program.vocabulary.messages)
    live = set(facts.reach.live)
    for labeled in program.of_kind(Labeled):
        name = labeled.label.name
        if name in named or program.labels[name] is not labeled or facts.reach.flow.label_block[name] in live:
            continue
        undefined = [jump.label.name for jump in program.jumps if jump.label.name not in program.labels]
        yield Finding(
            facts.label(labeled.label),
            f'no message, goto or call names the label "{name}", so that its code never runs',
            did_you_mean(name, [*program.vocabulary.messages, *undefined]) or "declare a message, or remove the code",
        )
