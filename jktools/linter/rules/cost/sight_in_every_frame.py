"""JK660: a test of sight in a pulse, timer or sleeping loop that is shorter than a frame."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.linter.figures import told_apart
from jktools.linter.hotspots import call_label, ours, place_of, subject_of
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.behaviour.pulse_shorter_than_frame import SHORTEST, outruns_frames
from jktools.model import Level


@rule("JK660", "sight-in-every-frame", severity=Severity.WARNING, since="0.1.0")
def sight_in_every_frame(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a test of sight in a pulse, a timer or a loop that is to come more often than the game draws frames.

    ## Why it matters
    The test then runs in every frame, 50 times a second and more on a fast machine: what it costs grows with the
    player's frame rate. Eyes are slower: twice a second is enough for most of what a script does with the answer.

    Counted are pulses, timers that are set again, and loops that sleep, as long as they last: a pulse that each run of
    its handler turns off is left out, and one that counts itself down to its end; one that is turned off on another
    condition is not. That a pulse is shorter than a frame is a fault in itself (JK601, JK658): this rule says that
    sight is tested there.

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
        if outruns_frames(spot.pulse) and spot.lasts:
            asked, frame = told_apart(spot.pulse, SHORTEST)
            yield Finding(
                place_of(spot.runner),
                f"{spot.runner.title} tests sight every {asked} s, but a frame takes {frame} s",
                spot.help,
                subject_of(spot.runner),
                (call_label(spot),),
            )
