"""JK210: a surface that two sectors claim."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK210", "surface-claimed-twice", severity=Severity.ERROR, since="0.1.0")
def surface_claimed_twice(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report two sectors whose surface ranges overlap.

    ## Why it matters
    The engine lets the later sector have the surface. The earlier one still draws and collides with it, but what
    passes through it, and what COGs ask of it, is taken for the other sector's.

    ## Bad
        Sector 1
        Surfaces 5 7

    ## Good
        Sector 1
        Surfaces 6 6
    """
    ranges = sorted(
        (sector.first_surface, sector.index, sector.surface_count)
        for sector in level.sectors
        if not sector.broken and sector.surface_count > 0
    )
    reach, holder = -1, -1  # the first surface behind all ranges so far, and the sector that reaches there
    for first, index, count in ranges:
        if first < reach:
            sector, other = level.sectors[index], level.sectors[holder]
            yield Finding(
                Label(sector.line_span("surface_range")),
                f"sector {index} claims the surfaces {first} to {first + count - 1}, but sector {holder} claims "
                f"{other.first_surface} to {reach - 1}",
                "give each surface to one sector",
                sector.subject,
                (Label(other.line_span("surface_range"), f"sector {holder}"),),
            )
        if first + count > reach:
            reach, holder = first + count, index
