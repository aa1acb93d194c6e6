"""JK603: a timer that nothing handles."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.rates import TIMER
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.behaviour.pulse_without_handler import unhandled
from jktools.syntax.cog import Script


@rule("JK603", "timer-without-handler", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def timer_without_handler(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `SetTimer` or `SetTimerEx` in a script that has no handler for `timer`.

    ## Why it matters
    The timer runs out and nothing happens: the message is not declared, or its label is missing.

    ## Bad
        symbols
        message startup
        end
        code
        startup:
            SetTimer(5.0);
            return;
        end

    ## Good
        symbols
        message startup
        message timer
        end
        code
        startup:
            SetTimer(5.0);
            return;
        timer:
            Print("time is up");
            return;
        end
    """
    yield from unhandled(facts, frozenset({"settimer", "settimerex"}), TIMER, "timer")
