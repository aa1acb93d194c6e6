"""JK303: a surface whose vertices do not lie in one plane."""

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

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a vertex may lie off the plane")] = 1e-3


@rule("JK303", "surface-not-planar", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def surface_not_planar(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a surface with a vertex more than 0.001 JKU off its plane.

    ## Why it matters
    The engine collides with the one plane of the written normal but draws the vertices as they are: bodies float
    above a bent floor or sink into it, and its texture swims.

    The plane goes through the first vertex, along the polygon's vector area.

    ## Bad
        World vertices 12
        2: 1 1 .02

    ## Good
        World vertices 12
        2: 1 1 .0005
    """
    planarity = facts.planarity
    for index in np.flatnonzero(planarity.distance > options.distance).tolist():
        surface = level.surfaces[index]
        corner = int(planarity.corner[index])
        vertex = int(surface.vertices[corner])
        yield Finding(
            Label(surface.corner_span(corner)),
            f"{surface.title} should be planar, but its vertex {vertex} lies {planarity.distance[index]:.6g} JKU "
            "off its plane",
            "move the vertex into the plane, or cleave the surface into triangles",
            surface.subject,
            (Label(level.line_span(int(level.document.vertices.lines[vertex])), f"vertex {vertex}"),),
        )
