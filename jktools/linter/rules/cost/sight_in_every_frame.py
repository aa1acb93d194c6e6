"""JK660: a test of sight in a pulse or timer that is shorter than a frame."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.linter.hotspots import call_label, ours, place_of, subject_of
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.behaviour.pulse_shorter_than_frame import SHORTEST, outruns_frames
from jktools.model import Level


@rule("JK660", "sight-in-every-frame", severity=Severity.WARNING, since="0.1.0", on=False)
def sight_in_every_frame(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a test of sight in a pulse or timer that is to come more often than the game draws frames.

    ## Why it matters
    The test then runs in every frame, 50 times a second and more on a fast machine: what it costs grows with the
    player's frame rate. Eyes are slower: twice a second is enough for most of what a script does with the answer.

    The rule is off: a pulse that turns itself off counts as lasting.

    ## Bad
        World templates 4
        lamp none type=cog cog=lamp.cog
        World things 4
        0: walkplayer walkplayer .5 .5 .2 0 0 0 0
        2: lamp lamp .5 .5 .5 0 0 0 0
        == cog/lamp.cog
        symbols
        message created
        message timer
        flex rate=0.01 local
        end
        code
        created:
            SetThingTimer(GetSenderRef(), rate);
            return;
        timer:
            if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) SetThingLight(GetSenderRef(), 1.0, 0.1);
            SetThingTimer(GetSenderRef(), rate);
            return;
        end

    ## Good
        World templates 4
        lamp none type=cog cog=lamp.cog
        World things 4
        0: walkplayer walkplayer .5 .5 .2 0 0 0 0
        2: lamp lamp .5 .5 .5 0 0 0 0
        == cog/lamp.cog
        symbols
        message created
        message timer
        flex rate=0.5 local
        end
        code
        created:
            SetThingTimer(GetSenderRef(), rate);
            return;
        timer:
            if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) SetThingLight(GetSenderRef(), 1.0, 0.1);
            SetThingTimer(GetSenderRef(), rate);
            return;
        end
    """
    for spot in ours(facts):
        if spot.pulse > 0 and outruns_frames(spot.pulse) and spot.lasts:
            yield Finding(
                place_of(spot.runner),
                f"{spot.runner.title} tests sight every {spot.pulse:.6g} s, but a frame takes {SHORTEST} s",
                spot.help,
                subject_of(spot.runner),
                (call_label(spot),),
            )
