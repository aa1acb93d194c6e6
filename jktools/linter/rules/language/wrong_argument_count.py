"""JK533: a verb called with too few or too many arguments."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK533", "wrong-argument-count", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def wrong_argument_count(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a verb that is called with too few or too many arguments.

    ## Why it matters
    A verb takes its arguments from the stack, the last first, and does not count them. With too few, the first ones
    are whatever lay there before, or nothing: 0, -1 or no object. With too many, the first ones stay on the stack,
    and the verb reads the last ones as if they were all.

    ## Bad
        symbols
        message startup
        thing door
        end
        code
        startup:
            MoveToFrame(door, 1);
            return;
        end

    ## Good
        symbols
        message startup
        thing door
        end
        code
        startup:
            MoveToFrame(door, 1, 8.0);
            return;
        end
    """
    for call, verb in facts.program.calls:
        given, wanted = len(call.arguments), len(verb.args)
        if given == wanted:
            continue
        if verb.name == "modifycoloreffect" and given > wanted:
            help = "the game binds this name to FreeColorEffect: free the effect and make a new one"
        else:
            help = f"call {verb.signature}"
        are = "is" if given == 1 else "are"
        yield Finding(
            facts.label(call.callee),
            f"{verb.name} takes {wanted} argument{'s' * (wanted != 1)}, but {given} {are} given",
            help,
        )
