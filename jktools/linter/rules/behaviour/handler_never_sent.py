"""JK609: a pulse or timer handler that the script never sets off."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.rates import PULSE, TIMER
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

SETTING = {
    PULSE: frozenset({"setpulse", "setthingpulse"}),
    TIMER: frozenset({"settimer", "settimerex", "setthingtimer"}),
}


@rule("JK609", "handler-never-sent", severity=Severity.INFO, since="0.1.0", on=False, looks_at=Script)
def handler_never_sent(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a handler for `pulse` or `timer`, when the script sets no pulse or no timer.

    ## Why it matters
    It runs only if another script gives a pulse or timer to a thing that belongs to this one. Mostly the call was
    forgotten. It is off by default, since a script by itself does not show it.

    ## Bad
        symbols
        message pulse
        end
        code
        pulse:
            Print("tick");
            return;
        end

    ## Good
        symbols
        message startup
        message pulse
        end
        code
        startup:
            SetPulse(1.0);
            return;
        pulse:
            Print("tick");
            return;
        end
    """
    if not facts.is_whole:
        return
    called = {verb.name for _, verb in facts.program.calls}
    for handler in facts.program.handlers:
        setting = SETTING.get(handler.message.id)
        if setting is not None and not called & setting:
            yield Finding(
                facts.label(handler.declared),
                f'"{handler.label}" has a handler, but the script never sets a {handler.message.name}',
                f"call Set{handler.message.name.capitalize()}, or remove the handler",
            )
