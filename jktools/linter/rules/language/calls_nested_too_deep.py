"""JK557: calls of labels inside each other, deeper than the engine goes."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.reach import MOST_FRAMES
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK557", "calls-nested-too-deep", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def calls_nested_too_deep(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `call`s inside each other that can go deeper than the engine remembers, or round in a circle.

    ## Why it matters
    The engine remembers 4 places to come back to, for calls and interrupted handlers together. A fifth `call` is
    skipped, and the machine then takes the call's operand for an instruction.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            call again;
            return;
        again:
            Print("once more");
            call again;
            return;
        end

    ## Good
        symbols
        message startup
        end
        code
        startup:
            call again;
            return;
        again:
            Print("once more");
            return;
        end
    """
    flow, reach = facts.analysis.flow, facts.reach
    for handler in facts.program.handlers:
        level = {flow.label_block[handler.label]}
        for _ in range(MOST_FRAMES):
            inside = {i for start in level for i in reach.blocks_from([start], into_calls=False)}
            level = {flow.blocks[i].callee for i in inside if flow.blocks[i].callee >= 0}
        deeper = sorted(
            i for start in level for i in reach.blocks_from([start], into_calls=False) if flow.blocks[i].callee >= 0
        )
        if deeper:
            jump = flow.blocks[deeper[0]].statements[-1]
            yield Finding(
                facts.label(jump),
                f'handler "{handler.label}" can come to this call with {MOST_FRAMES} calls open, but the engine '
                f"remembers {MOST_FRAMES}",
                "call less deep, and never in a circle",
            )
