"""JK512: more messages than a script can have."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.header import MOST_MESSAGES


@rule("JK512", "too-many-messages", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def too_many_messages(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report the messages of a script past the 32nd.

    ## Why it matters
    The engine keeps 32 and drops the others in silence: their labels are never run.
    """

    messages = sum(symbol.type == "message" for symbol in script.header.symbols)
    dropped = [s for s in script.header.dropped if s.type == "message" and s.name.key]
    if dropped and messages >= MOST_MESSAGES:  # else the table of symbols is full, which is JK514
        yield Finding(
            facts.label(dropped[0]),
            f"the script declares {messages + len(dropped)} messages, but the engine keeps {MOST_MESSAGES}: it drops "
            f"{', '.join(s.name.key for s in dropped[:5])}{', ...' * (len(dropped) > 5)}",
            "split the script in two",
        )
