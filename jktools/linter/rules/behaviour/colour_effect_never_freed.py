"""JK604: a colour effect that is never freed."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

FREEING = frozenset({"freecoloreffect", "modifycoloreffect"})


@rule("JK604", "colour-effect-never-freed", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def colour_effect_never_freed(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `NewColorEffect` whose effect the script never frees, or whose handle it does not keep.

    ## Why it matters
    An effect lasts until it is freed, and the game has 32: then no more can be made, by any script. Only the handle
    that `NewColorEffect` gives can free it.

    ## Bad
        symbols
        message activate
        int effect local
        end
        code
        activate:
            effect = NewColorEffect(0, 0, 0, 1.0, 0, 0, 0, 0, 0, 1.0);
            return;
        end

    ## Good
        symbols
        message activate
        int effect local
        end
        code
        activate:
            effect = NewColorEffect(0, 0, 0, 1.0, 0, 0, 0, 0, 0, 1.0);
            Sleep(2.0);
            FreeColorEffect(effect);
            return;
        end
    """
    program = facts.program
    made = [call for call, verb in program.calls if verb.name == "newcoloreffect"]
    if not facts.is_whole or not made:
        return
    frees = any(verb.name in FREEING for _, verb in program.calls)
    for call in made:
        if call in program.dropped:
            yield Finding(
                facts.label(call),
                "a colour effect is made, but nothing keeps its handle, so that it cannot be freed",
                "assign the handle, and free it with FreeColorEffect",
            )
        elif not frees:
            yield Finding(
                facts.label(call),
                "a colour effect is made, but the script never frees one",
                "free it with FreeColorEffect when it is over",
            )
