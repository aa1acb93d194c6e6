"""JK204: a corner of a surface that names no vertex or texture vertex."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.diagnostics.wording import numbered
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

NO_TEXTURE_VERTEX = -1


@rule("JK204", "surface-vertex-out-of-range", severity=Severity.ERROR, since="0.1.0")
def surface_vertex_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a corner of a surface that names a vertex or texture vertex which does not exist.

    ## Why it matters
    The engine does not check these indices: it reads memory beyond its lists, draws garbage or crashes.
    A texture vertex of -1 is allowed: surfaces without material have it.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 12,3 1 1 1 1

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 7,4 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 5,1 6,2 7,3 1 1 1 1
    """
    table = level.document.surfaces
    for kind, indices, least, count, texture in (
        ("vertex", table.corner_vertex, 0, len(level.vertices), False),
        ("texture vertex", table.corner_texture_vertex, NO_TEXTURE_VERTEX, len(level.texture_vertices), True),
    ):
        for corner in np.flatnonzero((indices < least) | (indices >= count)).tolist():
            index = int(np.searchsorted(table.corner_start, corner, side="right")) - 1
            surface = level.surfaces[index]
            yield Finding(
                Label(surface.corner_span(corner - int(table.corner_start[index]), texture)),
                f"{surface.title} names {kind} {indices[corner]}, but the level has "
                f"{numbered(count, kind, kind.replace('vertex', 'vertices'))}",
                f"name a {kind} that exists; the engine reads past its list",
                surface.subject,
            )
