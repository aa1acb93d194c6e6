"""JK541: vectors or strings compared as if they were numbers."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary

COMPARISONS = frozenset({"==", "!=", "<", ">", "<=", ">="})


@rule("JK541", "vector-compared", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def vector_compared(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a comparison of a vector or a string.

    ## Why it matters
    The engine compares numbers only. To it a vector is 0 in `==` and -1 in `!=`, so that two vectors are always equal
    and never different.

    ## Bad
        symbols
        message startup
        vector here local
        end
        code
        startup:
            here = GetThingPos(GetLocalPlayerThing());
            if (here == '0 0 0') Print("origin");
            return;
        end

    ## Good
        symbols
        message startup
        vector here local
        end
        code
        startup:
            here = GetThingPos(GetLocalPlayerThing());
            if (VectorDist(here, '0 0 0') < 0.001) Print("origin");
            return;
        end
    """
    for node, operands in facts.known.operands.items():
        if not isinstance(node, Binary) or node.op not in COMPARISONS:
            continue
        for written, value in zip((node.left, node.right), operands, strict=True):
            if value.is_vector or value.is_string:
                kind = "vector" if value.is_vector else "string"
                taken = -1 if node.op == "!=" else 0
                yield Finding(
                    facts.label(written),
                    f'"{node.op}" compares numbers, but this is a {kind}, which counts as {taken}',
                    "compare VectorDist of the two, or their parts" if value.is_vector else "compare numbers",
                )
                break
