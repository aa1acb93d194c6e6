"""JK650: a script whose tests of sight cost more than a budget."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Annotated

import msgspec

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.linter.figures import told_apart
from jktools.linter.hotspots import call_label, ours, place_of, subject_of
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Budget(Options, frozen=True):
    """What a script may spend on sight."""

    surfaces: Annotated[
        float, msgspec.Meta(gt=0, description="Surface tests a second that one script may cause, on the mean.")
    ] = 20_000.0


@rule("JK650", "sight-over-budget", severity=Severity.WARNING, since="0.1.0", options=Budget)
def sight_over_budget(level: Level, facts: LevelFacts, options: Budget) -> Iterator[Finding]:
    """Report a script whose tests of sight cost more surface tests a second than a budget.

    ## Why it matters
    `HasLOS` walks from sector to sector and tests every surface of each; `FirstThingInView` walks through up to 128
    sectors. A script that asks for it in a pulse, on many things, slows the game down: a class COG runs once for each
    thing that carries it. The cost is counted, not timed: calls a second times the surfaces that the real segments
    pass, with one end at the middle of each sector that it can come to where it moves. A loop that is sure never to end
    counts as over any budget; one that ends, but nobody knows after how many turns, is left out, and so is one that
    sleeps only in a label that it calls, but for that of `startup`.

    ## Bad
        World templates 4
        lamp none type=cog cog=lamp.cog
        World things 4
        0: walkplayer walkplayer .5 .5 .2 0 0 0 0
        2: lamp lamp .5 .5 .5 0 0 0 0
        == cog/lamp.cog
        symbols
        message created
        message pulse
        int i local
        end
        code
        created:
            SetThingPulse(GetSenderRef(), 0.02);
            return;
        pulse:
            for (i = 0; i < 100; i = i + 1)
            {
                if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) SetThingLight(GetSenderRef(), 1.0, 0.1);
            }
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
        message pulse
        end
        code
        created:
            SetThingPulse(GetSenderRef(), 0.5);
            return;
        pulse:
            if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) SetThingLight(GetSenderRef(), 1.0, 0.1);
            return;
        end
    """
    by_script = sorted(
        (spot for spot in ours(facts) if spot.lasts and spot.is_counted), key=lambda spot: spot.runner.place
    )
    for runner, group in groupby(by_script, key=lambda spot: spot.runner):
        spots = sorted(group, key=lambda spot: -spot.surfaces_per_second)
        total = sum(spot.surfaces_per_second for spot in spots)
        if total > options.surfaces:
            calls = sum(spot.calls_per_second for spot in spots)
            often = "any number of" if calls == float("inf") else f"up to {calls:.6g}"
            tests, most = told_apart(total, options.surfaces)
            much = "any number of" if total == float("inf") else f"some {tests}"
            yield Finding(
                place_of(runner),
                f"{runner.title} asks for sight {often} times a second, which tests {much} surfaces, but the budget is "
                f"{most}",
                spots[0].help,
                subject_of(runner),
                tuple(call_label(spot) for spot in spots),
            )
