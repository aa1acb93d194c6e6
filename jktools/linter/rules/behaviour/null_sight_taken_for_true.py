"""JK606: HasLOS taken for a truth value with a thing that may not exist."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.ranges import INT_MIN, Range
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Binary, Call, Expression, Unary


@rule("JK606", "null-sight-taken-for-true", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def null_sight_taken_for_true(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `HasLOS` as a truth value, when one of its things can be none.

    ## Why it matters
    With a thing that does not exist `HasLOS` gives -1, and -1 is true: the script sees what is not there. Reported is
    a thing that a verb may have answered with -1, or that is never set, when no test against -1 stands in between.

    ## Bad
        symbols
        message pulse
        thing turret
        thing target local
        end
        code
        pulse:
            target = FirstThingInView(turret, 90, 10, 0x404);
            if (HasLOS(turret, target)) Print("seen");
            return;
        end

    ## Good
        symbols
        message pulse
        thing turret
        thing target local
        end
        code
        pulse:
            target = FirstThingInView(turret, 90, 10, 0x404);
            if (target != -1)
            {
                if (HasLOS(turret, target) == 1) Print("seen");
            }
            return;
        end
    """
    truths = _truths(facts)
    for site in facts.rates.sites:
        if site.verb.name != "haslos" or site.call not in truths or len(site.call.arguments) != len(site.verb.args):
            continue
        for written, value in zip(site.call.arguments, site.arguments, strict=True):
            if _may_be_none(value):
                yield Finding(
                    facts.label(site.call),
                    "the answer of haslos is taken for true or false, but it is -1, which is true, when "
                    f'"{facts.span(written).text}" is no thing',
                    "compare with 1, or test the thing against -1 first",
                )
                break


def _may_be_none(value: Range) -> bool:
    """Whether -1 is among the values and not only because nothing at all is known."""
    return value.low <= -1 <= value.high and value.low > INT_MIN


def _truths(facts: ScriptFacts) -> set[Expression]:
    """Calls whose value decides as it is: conditions and the sides of `!`, `&&` and `||`."""
    found: set[Expression] = {b.condition for b in facts.analysis.flow.blocks if b.condition is not None}
    for part in facts.program.of_kind(Binary):
        if part.op in ("&&", "||"):
            found |= {part.left, part.right}
    found.update(part.operand for part in facts.program.of_kind(Unary) if part.op == "!")
    return {part for part in found if isinstance(part, Call)}
