"""JK608: a message that a script sends itself and does not handle."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Call, Name


@rule("JK608", "message-to-self-unhandled", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def message_to_self_unhandled(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a message that a script sends itself, when it has no handler for it.

    ## Why it matters
    Nothing happens, and `SendMessageEx` answers about -9999.987.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            SendMessage(GetSelfCog(), user0);
            return;
        end

    ## Good
        symbols
        message startup
        message user0
        end
        code
        startup:
            SendMessage(GetSelfCog(), user0);
            return;
        user0:
            Print("came");
            return;
        end
    """
    if not facts.is_whole:
        return
    for site in facts.rates.sites:
        if site.verb.name not in ("sendmessage", "sendmessageex") or len(site.call.arguments) != len(site.verb.args):
            continue
        target = site.call.arguments[0]
        to_self = isinstance(target, Call) and isinstance(target.callee, Name) and target.callee.name == "getselfcog"
        low, high = ranges.as_int(site.arguments[1])
        if to_self and low == high and not facts.program.handles(low):
            name = next((m.name for m in facts.vocabulary.messages.values() if m.id == low), str(low))
            yield Finding(
                facts.label(site.call),
                f'the script sends itself "{name}", but has no handler for it',
                f'declare "message {name}" and write its label',
            )
