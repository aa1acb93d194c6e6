"""JK213: an adjoin that leads into the sector it is in."""

from collections import Counter
from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK213", "adjoin-into-own-sector", severity=Severity.WARNING, since="0.1.0")
def adjoin_into_own_sector(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an adjoin whose other side is a surface of the same sector.

    ## Why it matters
    A sector is convex, so that nothing of it can lie behind one of its surfaces: who goes through the adjoin leaves
    the sector and is still taken to be in it. Pairs that do not name each other are left to adjoin-mirror-mismatch.

    ## Bad
        World surfaces 12
        4: 0 0x0 0x4 4 3 1 1 0 4 0,0 3,1 7,2 4,3 1 1 1 1
        8: 0 0x4 0x4 4 3 1 -1 0 4 3,0 7,1 6,2 2,3 1 1 1 1

    ## Good
        World adjoins 2
        0: 0x7 1 1
    """
    named = Counter(level.document.adjoins.mirror.tolist())
    for adjoin in level.adjoins:
        surface, behind = adjoin.surface, adjoin.sector
        if surface is None or behind is None or surface.sector != behind:
            continue
        if named[adjoin.index] != 1 or level.adjoins[adjoin.mirror].mirror != adjoin.index:
            continue
        other = level.surfaces[int(level.mirror_surface[adjoin.index])]
        to = "itself" if other == surface else other.title
        yield Finding(
            Label(surface.field_span("adjoin")),
            f"{surface.title} has adjoin {adjoin.index}, which leads to {to}, but an adjoin must lead into another "
            "sector",
            "name the adjoin of the neighbouring sector as mirror",
            adjoin.subject,
        )
