"""JK201: an adjoin whose mirror does not name it back."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK201", "adjoin-mirror-mismatch", severity=Severity.ERROR, since="0.1.0")
def adjoin_mirror_mismatch(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an adjoin whose mirror does not name it back.

    ## Why it matters
    The engine takes the sector behind an adjoin from its mirror's surface. A one-way pair loads, then leads the
    player, the camera and sight into the wrong sector. JED and SED call it an error; the engine does not look.

    ## Bad
        World adjoins 2
        1: 0x7 1 1

    ## Bad
        World adjoins 2
        0: 0x7 0 1
        1: 0x7 1 1

    ## Good
        World adjoins 2
        1: 0x7 0 1
    """
    mirrors = level.document.adjoins.mirror.tolist()
    for adjoin in level.adjoins:
        mirror = adjoin.mirror
        if adjoin.broken or not 0 <= mirror < len(mirrors) or level.adjoins[mirror].broken:
            continue
        back = mirrors[mirror]
        if back == adjoin.index and (mirror != adjoin.index or mirrors.count(mirror) > 1):
            continue  # a pair; or its own mirror, which is told at the adjoin that names it in vain
        told = f"has mirror {mirror}, but the mirror of {mirror} is {back}"
        if mirror == adjoin.index:
            told = "is its own mirror, but must lead to another adjoin"
        yield Finding(
            Label(adjoin.field_span("mirror"), f"adjoin {adjoin.index} names {mirror}"),
            f"adjoin {adjoin.index} {told}",
            f"set the mirror of adjoin {mirror} to {adjoin.index}, or that of {adjoin.index} to its real opposite",
            adjoin.subject,
            () if mirror == adjoin.index else (_named_back(level, mirror, back),),
        )


def _named_back(level: Level, mirror: int, back: int) -> Label:
    return Label(level.adjoins[mirror].field_span("mirror"), f"adjoin {mirror} names {back}")
