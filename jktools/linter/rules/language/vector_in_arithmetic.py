"""JK542: vectors or strings in arithmetic."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.values import ARITHMETIC
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary, Unary

VERBS = {"+": "VectorAdd", "-": "VectorSub", "*": "VectorScale"}


@rule("JK542", "vector-in-arithmetic", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def vector_in_arithmetic(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a vector or a string in arithmetic.

    ## Why it matters
    The engine computes with numbers only, and a vector or a string is 0 to it. Verbs compute with vectors.

    ## Bad
        symbols
        message startup
        vector up local
        end
        code
        startup:
            up = '0 0 1' * 2;
            return;
        end

    ## Good
        symbols
        message startup
        vector up local
        end
        code
        startup:
            up = VectorScale('0 0 1', 2);
            return;
        end
    """
    for node, operands in facts.known.operands.items():
        if isinstance(node, Binary) and node.op in ARITHMETIC:
            written = [node.left, node.right]
        elif isinstance(node, Unary) and node.op == "-":
            written = [node.operand]
        else:
            continue
        for side, value in zip(written, operands, strict=True):
            if value.is_vector or value.is_string:
                verb = VERBS.get(node.op) if isinstance(node, Binary) else "VectorScale"
                yield Finding(
                    facts.label(side),
                    f'"{node.op}" takes numbers, but this is a {"vector" if value.is_vector else "string"}, '
                    "which counts as 0",
                    f"use {verb}" if value.is_vector and verb else "use numbers",
                )
                break
