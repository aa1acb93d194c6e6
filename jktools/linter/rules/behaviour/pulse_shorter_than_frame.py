"""JK601: a pulse that is to come more than once a frame."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog import ranges
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

SHORTEST = 0.02
"""Seconds: the game's step at 50 frames a second."""
PULSES = {"setpulse": 0, "setthingpulse": 1}


def outruns_frames(seconds: float) -> bool:
    """Whether an interval is shorter than a frame, in the engine's float32: one written 0.02 is not."""
    return bool(np.float32(seconds) < np.float32(SHORTEST))


@rule("JK601", "pulse-shorter-than-frame", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def pulse_shorter_than_frame(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a pulse that is always to come more often than the game draws frames.

    ## Why it matters
    A pulse comes once a frame at most, and no more often than 50 times a second in the game as it was played. So the
    interval is not met, and how often the handler runs depends on the player's machine.

    ## Bad
        symbols
        message startup
        message pulse
        end
        code
        startup:
            SetPulse(0.001);
            return;
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
            SetPulse(0.1);
            return;
        pulse:
            Print("tick");
            return;
        end
    """
    for site in facts.rates.sites:
        at = PULSES.get(site.verb.name)
        if at is None:
            continue
        low, high = ranges.as_flex(site.arguments[at])
        if low > 0 and outruns_frames(high):
            asked, frame = told_apart(high, SHORTEST)
            yield Finding(
                facts.label(site.call),
                f"a pulse every {asked} s is set, but a frame takes {frame} s",
                "set a longer interval",
            )
