"""JK544: numbers of two different kinds of objects compared."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.language.wrong_argument_kind import object_kind
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary


@rule("JK544", "different-objects-compared", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def different_objects_compared(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `==` or `!=` between two different kinds of objects, such as a thing and a surface.

    ## Why it matters
    Each kind counts its objects from 0: thing 12 has nothing to do with surface 12.

    ## Bad
        symbols
        message startup
        thing switch
        surface panel
        end
        code
        startup:
            if (switch == panel) Print("same");
            return;
        end

    ## Good
        symbols
        message startup
        thing switch
        thing panel
        end
        code
        startup:
            if (switch == panel) Print("same");
            return;
        end
    """
    for part in facts.program.of_kind(Binary):
        if part.op in ("==", "!="):
            left, right = object_kind(facts.program, part.left), object_kind(facts.program, part.right)
            if left is not None and right is not None and left != right:
                yield Finding(
                    facts.label(part),
                    f"a {left} is compared with a {right}, but their numbers have nothing to do with each other",
                    "compare two of a kind",
                )
