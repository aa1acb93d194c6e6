"""JK514: more names than a script can have."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.header import MOST_SYMBOLS, TYPES


@rule("JK514", "too-many-script-symbols", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def too_many_script_symbols(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a script with more than 256 symbols: declared names, other names of its code, and string literals.

    ## Why it matters
    The table of JK 1.0 holds 256. In it and in later engines the numbers from 256 on mean what all scripts share: a
    name past the limit is read as a verb or a message.
    """

    slots = facts.program.slot_of
    past = {s.name.key for s in script.header.dropped if s.type in TYPES and s.name.key and s.name.key not in slots}
    full = len(script.header.symbols) >= MOST_SYMBOLS
    count = len(facts.program.slots) + len(past) * full
    if count > MOST_SYMBOLS:
        words = sum(slot.type == "string" for slot in facts.program.slots)
        yield Finding(
            Label(script.source),
            f"the script has {count} symbols, {words} of them strings, but the engine tells only {MOST_SYMBOLS} apart",
            "split the script in two, or use strings and names again",
        )
