"""JK207: a sector that claims surfaces or vertices which do not exist."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level, Sector


@rule("JK207", "sector-range-out-of-range", severity=Severity.ERROR, since="0.1.0")
def sector_range_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sector whose surface range or vertex list reaches beyond what the level has.

    ## Why it matters
    The engine checks neither: it reads memory beyond its lists and crashes or corrupts the level.

    ## Bad
        Sector 1
        Surfaces 6 7

    ## Bad
        Sector 1
        Vertices 8
        3: 12

    ## Good
        Sector 1
        Surfaces 6 6
    """
    for sector in level.sectors:
        if not sector.broken:
            yield from _surfaces(level, sector)
            yield from _vertices(level, sector)


def _surfaces(level: Level, sector: Sector) -> Iterator[Finding]:
    first, count, there = sector.first_surface, sector.surface_count, len(level.surfaces)
    if first >= 0 and count >= 0 and first + count <= there:
        return
    yield Finding(
        Label(sector.line_span("surface_range")),
        f"sector {sector.index} claims {count} surfaces from {first}, but the level has {there}",
        "write the first surface of the sector and how many follow",
        sector.subject,
    )


def _vertices(level: Level, sector: Sector) -> Iterator[Finding]:
    there = len(level.vertices)
    for place, vertex in enumerate(sector.vertices.tolist()):
        if not 0 <= vertex < there:
            yield Finding(
                Label(sector.vertex_span(place)),
                f"sector {sector.index} lists vertex {vertex}, but the level has "
                f"{numbered(there, 'vertex', 'vertices')}",
                "name a vertex that exists; the engine reads past its list",
                sector.subject,
            )
