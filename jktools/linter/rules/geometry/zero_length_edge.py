"""JK306: a surface with two corners in one place."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    # What JED and SED take for one place; of 117,000 edges of real levels none is between 0 and this.
    length: Annotated[float, msgspec.Meta(ge=0, description="JKU up to which an edge counts as none")] = 1e-4


@rule("JK306", "zero-length-edge", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def zero_length_edge(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a surface with an edge of at most 0.0001 JKU: the same vertex twice in a row, or two in one place.

    ## Why it matters
    Such an edge has no direction. The engine makes planes of edges to clip what is seen through a surface, to light
    and to collide with it; what it makes of this one is chance.

    ## Bad
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 5 4,0 7,1 7,1 6,2 5,3 1 1 1 1 1

    ## Good
        World surfaces 12
        1: 0 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1
    """
    corners = facts.corners
    length = np.linalg.norm(corners.edge, axis=1)
    for corner in np.flatnonzero(length <= options.length).tolist():
        following = int(corners.following[corner])
        surface = level.surfaces[int(corners.surface[corner])]
        start, end = int(corners.vertex[corner]), int(corners.vertex[following])
        yield Finding(
            Label(surface.corner_span(int(corners.place[following]))),
            f"{surface.title} names vertex {start} twice in a row"
            if start == end
            else f"the edge of {surface.title} from vertex {start} to {end} is {length[corner]:.6g} JKU long, but the "
            "corners of a surface must lie apart",
            "remove one of the two corners, and its light",
            surface.subject,
        )
