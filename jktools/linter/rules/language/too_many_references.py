"""JK513: more symbols than a level can set."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.header import MOST_REFERENCES, NUMBER_TYPES, TYPES


@rule("JK513", "too-many-references", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def too_many_references(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report the symbols past the 128th that a level can set.

    ## Why it matters
    All symbols but messages and local numbers count. The engine keeps 128 and drops the others in silence: the code
    then finds a variable of its own, a flex 0, under their names.
    """

    dropped = [s for s in script.header.dropped if s.type in TYPES and s.type != "message" and s.name.key]
    kept = sum(s.type != "message" and not (s.local and s.type in NUMBER_TYPES) for s in script.header.symbols)
    if dropped and kept >= MOST_REFERENCES:  # else the table of symbols is full, which is JK514
        yield Finding(
            facts.label(dropped[0]),
            f"the script declares {kept + len(dropped)} symbols that a level can set, but the engine keeps "
            f"{MOST_REFERENCES}: it drops {', '.join(s.name.key for s in dropped[:5])}{', ...' * (len(dropped) > 5)}",
            "split the script in two, or make numbers local",
        )
