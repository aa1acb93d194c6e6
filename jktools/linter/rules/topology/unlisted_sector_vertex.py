"""JK216: a vertex of a sector's surfaces that the sector does not list."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.topology.too_few_sector_vertices import LEAST_VERTICES
from jktools.model import Level


@rule("JK216", "unlisted-sector-vertex", severity=Severity.WARNING, since="0.1.0")
def unlisted_sector_vertex(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a sector whose surfaces use a vertex that is not in the sector's vertex list.

    ## Why it matters
    The engine goes through the sector's list when it works out moving lights, vertex by vertex
    (sithRender_RenderDynamicLights in the decompiled engine): a vertex that is not listed keeps the light of another
    moment. Sectors with hardly any vertices are left to too-few-sector-vertices.

    ## Bad
        Sector 1
        Vertices 7
        - 7: 6

    ## Good
        Sector 1
        Vertices 8
    """
    for index in range(len(level.sectors)):
        listed, used = facts.sector_vertices[index]
        missing = sorted(used - listed)
        if not missing or len(listed) < LEAST_VERTICES:
            continue
        sector = level.sectors[index]
        surface = next(s for s in sector.surfaces if missing[0] in s.vertices)
        corner = surface.vertices.tolist().index(missing[0])
        more = f"; {len(missing) - 1} more vertices are not listed" if len(missing) > 1 else ""
        yield Finding(
            Label(sector.line_span("vertex_count")),
            f"{surface.title} uses vertex {missing[0]}, but sector {index} does not list it{more}",
            "list every vertex of the sector's surfaces",
            sector.subject,
            (Label(surface.corner_span(corner), f"vertex {missing[0]}"),),
        )
