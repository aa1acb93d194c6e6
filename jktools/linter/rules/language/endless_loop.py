"""JK554: a loop that never ends and never sleeps."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.loops import endless_parts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK554", "endless-loop", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def endless_loop(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a loop that nothing ends and that never sleeps.

    ## Why it matters
    The engine runs a script until it ends or sleeps: the game hangs. Only a loop that cannot be left is reported, not
    one whose end depends on something.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            while (1)
            {
                Print("round and round");
            }
        end

    ## Good
        symbols
        message startup
        end
        code
        startup:
            while (1)
            {
                Print("round and round");
                Sleep(1.0);
            }
        end
    """
    blocks = facts.analysis.flow.blocks
    for part in endless_parts(facts.analysis.flow, facts.known, facts.reach):
        statements = [s for i in part for s in blocks[i].statements]
        conditions = [c for i in part if (c := blocks[i].condition) is not None]
        place = min((*statements, *conditions), key=lambda node: node.start, default=None)
        if place is not None:
            yield Finding(
                facts.label(place),
                "nothing ends this loop, and it never sleeps: the game hangs",
                "sleep in each turn",
            )
