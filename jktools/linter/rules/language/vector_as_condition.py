"""JK543: a vector or a string where a truth value belongs."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary, Unary


@rule("JK543", "vector-as-condition", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def vector_as_condition(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a vector or a string as a condition, or in `!`, `&&` or `||`.

    ## Why it matters
    Both count as -1 there, which is true, whatever they hold.

    ## Bad
        symbols
        message startup
        vector speed local
        end
        code
        startup:
            speed = GetThingVel(GetLocalPlayerThing());
            if (speed) Print("moving");
            return;
        end

    ## Good
        symbols
        message startup
        vector speed local
        end
        code
        startup:
            speed = GetThingVel(GetLocalPlayerThing());
            if (VectorLen(speed) > 0.01) Print("moving");
            return;
        end
    """
    conditions = [
        (block.condition, facts.known.conditions[block.index])
        for block in facts.analysis.flow.blocks
        if block.condition is not None and block.index in facts.known.conditions
    ]
    for node, operands in facts.known.operands.items():
        if isinstance(node, Binary) and node.op in ("&&", "||"):
            conditions += zip((node.left, node.right), operands, strict=True)
        elif isinstance(node, Unary) and node.op == "!":
            conditions.append((node.operand, operands[0]))
    for written, value in conditions:
        if value.is_vector or value.is_string:
            yield Finding(
                facts.label(written),
                f"a {'vector' if value.is_vector else 'string'} is taken for a truth value here, but is always true",
                "compare a number, such as VectorLen of it" if value.is_vector else "compare a number",
            )
