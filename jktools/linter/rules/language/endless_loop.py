"""JK554: a loop that never ends and never sleeps."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.lowering import Flow, Op
from jktools.facts.cog.repeats import components
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
    flow, known = facts.analysis.flow, facts.known
    for part in components(flow.blocks, frozenset(known.visited)):
        if not _can_end(flow, known, frozenset(part)):
            statements = [s for i in part for s in flow.blocks[i].statements]
            conditions = [flow.blocks[i].condition for i in part if flow.blocks[i].condition is not None]
            place = min((n for n in (*statements, *conditions) if n is not None), key=lambda n: n.start, default=None)
            if place is not None:
                yield Finding(
                    facts.label(place),
                    "nothing ends this loop, and it never sleeps: the game hangs",
                    "sleep in each turn",
                )


def _can_end(flow: Flow, known: Known, part: frozenset[int]) -> bool:
    for index in part:
        block = flow.blocks[index]
        if block.returns or block.callee >= 0:
            return True
        if any(s not in part and s in known.visited for s in block.successors):
            return True
        for op, verb, _ in block.code:
            if op is Op.CALL and (verb.sleeps or verb.game == "user" or verb.name == "jkendlevel"):
                return True
    return False
