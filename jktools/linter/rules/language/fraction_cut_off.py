"""JK540: a fraction in an operator that cuts it off."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.linter.rule import Finding, rule
from jktools.model.cog.values import ON_INT
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary, Unary


@rule("JK540", "fraction-cut-off", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def fraction_cut_off(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a fraction in an operator that computes with whole numbers.

    ## Why it matters
    `!=`, `&&`, `||`, `!`, `&`, `|`, `^` and every condition cut fractions off, while `==` compares them: `0.2 != 0.7`
    does not hold, and `if (0.5)` is never taken. Only what is a fraction whenever the code runs is reported.

    ## Bad
        symbols
        message startup
        flex fade=0.5 local
        end
        code
        startup:
            if (fade != 0.75) Print("fading");
            return;
        end

    ## Good
        symbols
        message startup
        flex fade=0.5 local
        end
        code
        startup:
            if (!(fade == 0.75)) Print("fading");
            return;
        end
    """
    for node, operands in facts.known.operands.items():
        if isinstance(node, Binary) and node.op in ON_INT:
            sides = list(zip((node.left, node.right), operands, strict=True))
        elif isinstance(node, Unary) and node.op == "!":
            sides = [(node.operand, operands[0])]
        else:
            continue
        for written, value in sides:
            if _is_fraction(value):
                yield Finding(
                    facts.label(written),
                    f'this is {_shown(value)}, but "{node.op}" takes it as {ranges.as_int(value)[0]}',
                    "compare with ==, < or >, which do not cut off",
                )
    for index, value in facts.known.conditions.items():
        condition = facts.analysis.flow.blocks[index].condition
        if condition is not None and _is_fraction(value):
            yield Finding(
                facts.label(condition),
                f"this is {_shown(value)}, but a condition takes it as {ranges.as_int(value)[0]}",
                "compare with ==, < or >, which do not cut off",
            )


def _is_fraction(value: ranges.Range) -> bool:
    """Whether every number that it can be is cut off to one and the same, and is another."""
    if value.kinds & ~ranges.NUMBER or not value.is_known:
        return False
    low, high = ranges.as_int(value)
    return low == high and (value.low > low or value.high < low)


def _shown(value: ranges.Range) -> str:
    return f"{value.low:.6g}" if value.low == value.high else f"between {value.low:.6g} and {value.high:.6g}"
