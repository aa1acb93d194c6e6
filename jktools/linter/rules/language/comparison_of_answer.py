"""JK564: the answer of a comparison compared."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.language.bits_of_comparison import COMPARISONS
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary, Expression, Number, Unary


@rule("JK564", "comparison-of-answer", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def comparison_of_answer(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a comparison, or `!`, whose answer is compared in turn.

    ## Why it matters
    `1 < x < 5` compares the answer of `1 < x`, which is 0 or 1, with 5, and always holds. `!x == 3` is `(!x) == 3`,
    which never does. Parentheses say that it is meant.

    ## Bad
        startup:
            if (1 < x < 5) Print("between");

    ## Bad
        startup:
            if (!x == 3) Print("other");

    ## Good
        startup:
            if (1 < x && x < 5) Print("between");
            if (x != 3) Print("other");
            if ((x > 1) == (y > 1)) Print("alike");
    """
    for part in facts.program.of_kind(Binary):
        if part.op not in COMPARISONS or part.start != part.left.start:
            continue
        if isinstance(part.left, Binary) and part.left.op in COMPARISONS:
            yield Finding(
                facts.label(part),
                f'the answer of "{part.left.op}" is compared by "{part.op}", but it is only 0 or 1',
                f"write two comparisons: a {part.left.op} b && b {part.op} c",
            )
        elif isinstance(part.left, Unary) and part.left.op == "!" and not _is_truth(part.right):
            yield Finding(
                facts.label(part),
                f'"!" comes before "{part.op}": what is compared is only 0 or 1',
                f"write !(a {part.op} b)",
            )


def _is_truth(part: Expression) -> bool:
    """Whether a value is 0 or 1 itself."""
    if isinstance(part, Number):
        return part.value in (0, 1)
    return (isinstance(part, Unary) and part.op == "!") or (isinstance(part, Binary) and part.op in COMPARISONS)
