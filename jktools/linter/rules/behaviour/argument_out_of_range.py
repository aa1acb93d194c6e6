"""JK605: an argument outside the values that a verb knows."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.facts.cog.ranges import Range
from jktools.linter.rule import Finding, rule
from jktools.model.cog.messages import LAST_SENDABLE
from jktools.model.cog.verbs import Argument
from jktools.syntax.cog import Script


@rule("JK605", "argument-out-of-range", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def argument_out_of_range(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an argument that always lies outside the values that the verb knows.

    ## Why it matters
    The engine clamps such a value, ignores the call, or answers with nonsense: `GetParam(4)` is -9999, there is no
    camera 7, a message beyond 40 is not sent. The values are those of the decompiled engine and, for colour effects, of
    measurements in the game.

    ## Bad
        symbols
        message damaged
        flex damage local
        end
        code
        damaged:
            damage = GetParam(4);
            ReturnEx(damage);
            return;
        end

    ## Good
        symbols
        message damaged
        flex damage local
        end
        code
        damaged:
            damage = GetParam(0);
            ReturnEx(damage);
            return;
        end
    """
    for site in facts.rates.sites:
        if len(site.call.arguments) != len(site.verb.args):
            continue
        for written, argument, value in zip(site.call.arguments, site.verb.args, site.arguments, strict=True):
            if argument.least is None and argument.greatest is None:
                continue
            least, greatest = _bounds(argument, facts.vocabulary.game)
            low, high = _number(argument, value)
            if (greatest is not None and low > greatest) or (least is not None and high < least):
                shown = f"{low:.6g}" if low == high else f"between {low:.6g} and {high:.6g}"
                yield Finding(
                    facts.label(written),
                    f"{argument.name} of {site.verb.name} is {shown}, but can be {_shown(least, greatest)}",
                    f"give it such a value: {site.verb.signature}",
                )


def _number(argument: Argument, value: Range) -> tuple[float, float]:
    if value.kinds & ~ranges.NUMBER:
        return -ranges.INF, ranges.INF  # a rule of its own tells
    return ranges.as_flex(value) if argument.kind == "flex" else ranges.as_int(value)


def _bounds(argument: Argument, game: str) -> tuple[float | None, float | None]:
    if argument.name == "message" and argument.greatest is not None:
        return argument.least, LAST_SENDABLE.get(game, argument.greatest)
    return argument.least, argument.greatest


def _shown(least: float | None, greatest: float | None) -> str:
    if greatest is None:
        return f"{least:g} or more"
    return f"{least:g} to {greatest:g}" if least is not None else f"{greatest:g} or less"
