"""JK658: a placed script whose values make its pulse shorter than a frame."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.cog import ranges
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.behaviour.pulse_shorter_than_frame import PULSES, SHORTEST, outruns_frames
from jktools.model import Level


@rule("JK658", "placed-pulse-shorter-than-frame", severity=Severity.WARNING, since="0.1.0")
def placed_pulse_shorter_than_frame(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a placed script whose values make it pulse more often than the game draws frames.

    ## Why it matters
    A pulse comes once a frame at most: the interval is not met, and how often the handler runs depends on the player's
    machine. A script that does so whatever its values is reported by itself (JK601).

    ## Bad
        World cogs 1
        0: rain.cog 0.001
        == cog/rain.cog
        symbols
        message startup
        message pulse
        flex interval=1.0
        end
        code
        startup: SetPulse(interval); return;
        pulse: Print("drop"); return;
        end

    ## Good
        World cogs 1
        0: rain.cog 0.1
        == cog/rain.cog
        symbols
        message startup
        message pulse
        flex interval=1.0
        end
        code
        startup: SetPulse(interval); return;
        pulse: Print("drop"); return;
        end
    """
    for instance in facts.instances:
        if instance.analysis is None or instance.script is None:
            continue
        anyhow = {site.call: site for site in instance.script.rates.sites}
        for site in instance.analysis.rates.sites:
            at = PULSES.get(site.verb.name)
            if at is None:
                continue
            low, high = ranges.as_flex(site.arguments[at])
            anyway = ranges.as_flex(anyhow[site.call].arguments[at])[1]
            if low > 0 and outruns_frames(high) and not outruns_frames(anyway):
                asked, frame = told_apart(high, SHORTEST)
                yield Finding(
                    Label(instance.cog.head_span),
                    f"{instance.cog.title} sets a pulse every {asked} s, but a frame takes {frame} s",
                    "give it a longer interval",
                    instance.cog.subject,
                    (instance.script.label(site.call, "the call"),),
                )
