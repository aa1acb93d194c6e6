"""JK655: a thing moved to a frame that it does not have."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.cog.frames import frame_count
from jktools.linter.rule import Finding, rule
from jktools.model import Level

FRAMES = {"movetoframe": 1, "jumptoframe": 1, "skiptoframe": 1, "rotatepivot": 1}
"""Which argument of a verb is the frame."""


@rule("JK655", "frame-out-of-range", severity=Severity.WARNING, since="0.1.0")
def frame_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a placed script that moves a thing to a frame which the thing does not have.

    ## Why it matters
    The engine ignores the call, and a door stays shut or a lift where it is. Judged is the thing that the level's
    `cogs` line names, with the frames of its own line and its templates; a call that can be meant for several things
    or frames is not.

    ## Bad
        World things 3
        1: crate crate .5 1.5 .5 0 0 0 1 move=path numframes=2 frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)
        World cogs 1
        0: lift.cog 1
        == cog/lift.cog
        symbols
        message startup
        thing lift
        end
        code
        startup: MoveToFrame(lift, 2, 4.0); return;
        end

    ## Good
        World things 3
        1: crate crate .5 1.5 .5 0 0 0 1 move=path numframes=2 frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)
        World cogs 1
        0: lift.cog 1
        == cog/lift.cog
        symbols
        message startup
        thing lift
        end
        code
        startup: MoveToFrame(lift, 1, 4.0); return;
        end
    """
    things = {thing.number: thing for thing in level.things if thing.dropped is None}
    for instance in facts.instances:
        if instance.analysis is None or instance.script is None:
            continue
        for site in instance.analysis.rates.sites:
            at = FRAMES.get(site.verb.name)
            if at is None or len(site.call.arguments) != len(site.verb.args):
                continue
            number, low = site.arguments[0].number, site.arguments[at].low
            thing = things.get(int(number)) if number is not None else None
            count = frame_count(thing) if thing is not None else None
            if thing is not None and count is not None and low >= count and site.arguments[at].high < 32768:
                held = f"has {count} frame{'s' * (count != 1)}, from 0" if count else "has no frames"
                yield Finding(
                    Label(instance.cog.head_span),
                    f"{instance.cog.title} moves {thing.title} to frame {low:g} with {site.verb.name}, but it {held}",
                    "give the thing the frame, or name another",
                    instance.cog.subject,
                    (instance.script.label(site.call, "the call"), Label(thing.head_span, thing.title)),
                )
