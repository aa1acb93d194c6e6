"""JK551: an array index that leaves the script's symbols."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Assign, Index, Name


@rule("JK551", "index-past-table", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def index_past_table(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `name[i]` whose index always leaves the symbols of the script.

    ## Why it matters
    `name[i]` is the i-th symbol behind `name`, and the engine does not check it. Behind the last symbol reading gives 0
    and writing crashes the game; before the first, both touch memory that is none of the script's.

    ## Bad
        symbols
        message startup
        thing first
        thing second
        end
        code
        startup:
            DestroyThing(first[20]);
            return;
        end

    ## Good
        symbols
        message startup
        thing first
        thing second
        end
        code
        startup:
            DestroyThing(first[1]);
            return;
        end
    """
    slots = facts.program.slots
    for node, index in facts.known.indices.items():
        written = node.target if isinstance(node, Assign) else node
        if not isinstance(written, Index) or not isinstance(written.base, Name) or index == ranges.ANY:
            continue
        base = facts.program.slot_of[written.base.name].index
        low, high = ranges.as_int(index)
        if base + low >= len(slots) or base + high < 0:
            side = "behind the last" if base + low >= len(slots) else "before the first"
            shown = str(low) if low == high else f"{low} to {high}"
            yield Finding(
                facts.label(written),
                f"index {shown} of {written.base.name} leads {side} symbol, but the script has {len(slots)} symbols "
                f"and {written.base.name} is number {base}",
                "declare what the index is to reach right behind the name",
            )
