"""JK565: a division by 0."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary


@rule("JK565", "division-by-zero", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def division_by_zero(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a division by what is always 0.

    ## Why it matters
    `/` gives 0 then, and `%` gives what is no number, so that no comparison of flexes holds. Often the divisor is a
    symbol that nothing assigns. The values are those of the decompiled engine.

    ## Bad
        symbols
        message startup
        flex part local
        flex all local
        end
        code
        startup:
            part = 3 / all;
            return;
        end

    ## Good
        symbols
        message startup
        flex part local
        flex all=4.0 local
        end
        code
        startup:
            part = 3 / all;
            return;
        end
    """
    for node, operands in facts.known.operands.items():
        if isinstance(node, Binary) and node.op in ("/", "%") and ranges.as_flex(operands[1]) == (0, 0):
            yield Finding(
                facts.label(node.right),
                f'the right side of "{node.op}" is always 0, but nothing can be divided by it',
                "give it another value first",
            )
