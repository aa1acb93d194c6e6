"""JK659: a test of sight that always comes out the same."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.facts.hotspots import Verdict
from jktools.linter.hotspots import ours, place_of, subject_of
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK659", "sight-outcome-known", severity=Severity.WARNING, since="0.1.0", on=False)
def sight_outcome_known(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a call of `HasLOS` that always finds the same, since nothing that it depends on can change.

    ## Why it matters
    The test costs time and decides nothing. Reported is a call between things that stay where they are placed, when
    no script can open or shut what the segment meets, and, for one that always succeeds, when the level places no other
    solid thing. Bodies that walk between are left out: in the decompiled engine they do not block.

    The rule is off: it does not yet see ends that a script destroys, items that a player takes, or solid things that
    a script creates or makes solid on the way.

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
        if spot.verdict is not Verdict.VARIES and spot.handlers:
            finds = "always succeeds" if spot.verdict is Verdict.ALWAYS else "never succeeds"
            yield Finding(
                place_of(spot.runner),
                f"{spot.runner.title} tests sight between things that stay in place, but the test {finds}",
                spot.help,
                subject_of(spot.runner),
                (spot.runner.script.label(spot.site.call, "the call"),),
            )
