"""JK563: bits of an answer."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary

BITS = ("&", "|", "^")
COMPARISONS = frozenset({"==", "!=", "<", ">", "<=", ">="})


@rule("JK563", "bits-of-comparison", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def bits_of_comparison(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a comparison without parentheses beside `&`, `|` or `^`.

    ## Why it matters
    These operators bind looser than `==`, as in C: `flags & 4 == 4` is `flags & (4 == 4)`, which tests bit 1.

    ## Bad
        startup:
            if (GetThingFlags(x) & 4 == 4) Print("set");

    ## Good
        startup:
            if ((GetThingFlags(x) & 4) == 4) Print("set");
            if (x & (y == 4)) Print("meant so");
    """
    for part in facts.program.of_kind(Binary):
        if part.op not in BITS:
            continue
        # Parentheses belong to the whole, and not to the side in them.
        for side, bare in ((part.left, part.start == part.left.start), (part.right, part.end == part.right.end)):
            if bare and isinstance(side, Binary) and side.op in COMPARISONS:
                yield Finding(
                    facts.label(side),
                    f'"{side.op}" binds tighter than "{part.op}": the comparison comes first, but has no parentheses',
                    f"write parentheses around what is meant: (a {part.op} b) {side.op} c",
                )
                break
