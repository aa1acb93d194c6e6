"""JK562: a message that is bound twice."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Symbol


@rule("JK562", "message-handled-twice", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def message_handled_twice(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a message that an earlier declaration has already bound to another label.

    ## Why it matters
    The engine takes the first declaration of a message, and `activate` and `activated` are one message. The later label
    never runs for it.

    ## Bad
        symbols
        message activate
        message activated
        end
        code
        activate:
            Print("first");
            return;
        activated:
            Print("second");
            return;
        end

    ## Good
        symbols
        message activate
        end
        code
        activate:
            Print("both");
            return;
        end
    """
    owner: dict[int, Symbol] = {}
    for symbol, message in facts.program.declared_messages:
        if message is None:
            continue
        first = owner.setdefault(message.id, symbol)
        if first.name.key != symbol.name.key:
            yield Finding(
                facts.label(symbol),
                f'"{symbol.name.key}" is the same message as "{first.name.key}", but the first declaration takes it',
                "keep one of the two, with the code of both",
                related=(facts.label(first, "the first"),),
            )
