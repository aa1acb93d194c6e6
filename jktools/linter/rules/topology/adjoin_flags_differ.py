"""JK218: an adjoin with other flags than its mirror."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK218", "adjoin-flags-differ", severity=Severity.INFO, since="0.1.0", on=False)
def adjoin_flags_differ(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a pair of adjoins with different flags.

    ## Why it matters
    What is open from one side is closed from the other. That is how one-way windows and doors are made: real levels
    hold hundreds of such pairs on purpose, which is why this rule is off. It helps to find the one that is not.

    ## Bad
        World adjoins 2
        1: 0x5 0 1

    ## Good
        World adjoins 2
        1: 0x7 0 1
    """
    for adjoin in level.adjoins:
        if adjoin.broken or not adjoin.index < adjoin.mirror < len(level.adjoins):
            continue
        mirror = level.adjoins[adjoin.mirror]
        if mirror.broken or mirror.mirror != adjoin.index or mirror.flags == adjoin.flags:
            continue
        yield Finding(
            Label(adjoin.field_span("flags"), f"adjoin {adjoin.index}"),
            f"adjoin {adjoin.index} has flags 0x{adjoin.flags:x}, but its mirror {mirror.index} has 0x{mirror.flags:x}",
            "give both the same flags, unless the two sides are meant to differ",
            adjoin.subject,
            (Label(mirror.field_span("flags"), f"adjoin {mirror.index}"),),
        )
