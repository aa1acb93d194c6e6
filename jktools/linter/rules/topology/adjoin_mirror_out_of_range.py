"""JK202: an adjoin whose mirror does not exist."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK202", "adjoin-mirror-out-of-range", severity=Severity.ERROR, since="0.1.0")
def adjoin_mirror_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an adjoin whose mirror does not exist.

    ## Why it matters
    The engine compares the mirror with the number of adjoins, as an unsigned number, and refuses the level.

    ## Bad
        World adjoins 2
        0: 0x7 2 1

    ## Bad
        World adjoins 2
        0: 0x7 -1 1

    ## Good
        World adjoins 2
        0: 0x7 1 1
    """
    count = len(level.adjoins)
    for adjoin in level.adjoins:
        if adjoin.broken or 0 <= adjoin.mirror < count:
            continue
        yield Finding(
            Label(adjoin.field_span("mirror")),
            f"adjoin {adjoin.index} has mirror {adjoin.mirror}, but the level has {numbered(count, 'adjoin')}",
            "name the adjoin on the other side; the engine refuses the level",
            adjoin.subject,
        )
