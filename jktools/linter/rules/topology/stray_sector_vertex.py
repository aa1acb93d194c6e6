"""JK217: a vertex that a sector lists, but none of its surfaces uses."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK217", "stray-sector-vertex", severity=Severity.INFO, since="0.1.0")
def stray_sector_vertex(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sector that lists a vertex which none of its surfaces uses.

    ## Why it matters
    Such a vertex is left over from cleaving or deleting. The engine still works with it, and editors count it in when
    they measure the sector: its bound box, radius and convexity are no longer those of its surfaces.

    ## Bad
        Sector 0
        Vertices 9
        - Surfaces 0 6
        8: 8
        Surfaces 0 6

    ## Good
        Sector 0
        Vertices 8
    """
    for index in range(len(level.sectors)):
        listed, used = facts.sector_vertices[index]
        stray = listed - used
        if not stray or not used:
            continue
        sector = level.sectors[index]
        place = next(i for i, vertex in enumerate(sector.vertices.tolist()) if vertex in stray)
        vertex = int(sector.vertices[place])
        more = f"; {len(stray) - 1} more are strays" if len(stray) > 1 else ""
        yield Finding(
            Label(sector.vertex_span(place)),
            f"sector {index} lists vertex {vertex}, but none of its surfaces uses it{more}",
            "remove the vertex from the list, and correct the count",
            sector.subject,
        )
