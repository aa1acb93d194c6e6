"""JK659: a test of sight that always comes out the same."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.facts.hotspots import Verdict
from jktools.linter.hotspots import ours, place_of, subject_of
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK659", "sight-outcome-known", severity=Severity.WARNING, since="0.1.0")
def sight_outcome_known(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a call of `HasLOS` that always finds the same, since nothing that it depends on can change.

    ## Why it matters
    The test costs time and decides nothing. Reported is a call between things that stay where they are placed, by the
    whole scene: walls, and things in the way that stay too. No script can change what the answer hangs on, and where it
    always succeeds nothing solid can come between: by the research document any body or shot, by the decompiled engine
    things of type cog. Where only one of them is sure, the finding is an info and says so: such a test may work in one
    engine alone.

    ## Bad
        World adjoins 2
        0: 0x6 1 1
        1: 0x6 0 1
        World things 4
        2: ghost ghost .5 .5 .5 0 0 0 0
        World cogs 1
        0: look.cog 2 1
        == cog/look.cog
        symbols
        message activated
        thing a
        thing b
        end
        code
        activated:
            if (HasLOS(a, b) == 1) Print("seen");
            return;
        end

    ## Good
        World things 4
        2: ghost ghost .5 .5 .5 0 0 0 0
        World cogs 1
        0: look.cog 2 0
        == cog/look.cog
        symbols
        message activated
        thing a
        thing b
        end
        code
        activated:
            if (HasLOS(a, b) == 1) Print("seen");
            return;
        end
    """
    for spot in ours(facts):
        if spot.finds is not None and spot.handlers:
            yield Finding(
                place_of(spot.runner),
                f"{spot.runner.title} tests sight between things that stay in place, but the test {spot.finds}",
                spot.help if spot.verdict is not Verdict.VARIES else "do not build on this test: engines differ in it",
                subject_of(spot.runner),
                (spot.runner.script.label(spot.site.call, "the call"),),
                None if spot.verdict is not Verdict.VARIES else Severity.INFO,
            )
