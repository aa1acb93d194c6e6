"""JK602: a pulse that nothing handles."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.rates import PULSE
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK602", "pulse-without-handler", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def pulse_without_handler(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `SetPulse` in a script that has no handler for `pulse`.

    ## Why it matters
    The pulses come and nothing happens: the message is not declared, or its label is missing. A call that ends the
    pulse is not reported.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            SetPulse(1.0);
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
    yield from unhandled(facts, frozenset({"setpulse"}), PULSE, "pulse")


def unhandled(facts: ScriptFacts, verbs: frozenset[str], message: int, name: str) -> Iterator[Finding]:
    """A finding at the first call of one of the verbs, when the script does not handle what it brings."""
    if not facts.is_whole or facts.program.handles(message):
        return
    for site in facts.rates.sites:
        value = site.arguments[0] if site.arguments else None
        if site.verb.name in verbs and value is not None and value.high > 0:
            yield Finding(
                facts.label(site.call),
                f"{site.verb.name} sends {name}, but the script has no handler for {name}",
                f'declare "message {name}" and write its label',
            )
            return
