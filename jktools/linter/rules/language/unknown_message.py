"""JK558: a message that the game does not have."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model.cog.messages import ALL_MESSAGES
from jktools.syntax.cog import Script


@rule("JK558", "unknown-message", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def unknown_message(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a declared message that the game does not have.

    ## Why it matters
    Nothing ever sends it, and the engine says nothing. Some belong to Mysteries of the Sith only.

    ## Bad
        symbols
        message actvate
        end
        code
        actvate:
            Print("used");
            return;
        end

    ## Good
        symbols
        message activate
        end
        code
        activate:
            Print("used");
            return;
        end
    """
    elsewhere = {m.name for m in ALL_MESSAGES}
    for symbol, message in facts.program.declared_messages:
        name = symbol.default or symbol.name.key
        if message is None:
            yield Finding(
                facts.label(symbol),
                f'message "{name}" is declared, but '
                + ("only Mysteries of the Sith sends it" if name in elsewhere else "the game has no such message"),
                did_you_mean(name, facts.vocabulary.messages) or "name a message of the game",
            )
