"""JK307: a surface whose corners lie in one line."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.linter.rules.topology.too_few_surface_vertices import LEAST_VERTICES
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    width: Annotated[float, msgspec.Meta(ge=0, description="JKU up to which a surface counts as a line")] = 1e-4


@rule("JK307", "surface-without-area", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def surface_without_area(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a surface that is at most 0.0001 JKU wide.

    ## Why it matters
    Nobody sees it and nobody can pass it. Where its corners lie exactly in line it has no plane at all, so that the
    written normal means nothing.

    The width is twice the area over the longest edge. Surfaces with fewer than 3 vertices are left to
    too-few-surface-vertices.

    ## Bad
        World vertices 12
        2: .5 0 0
        World surfaces 12
        0: 0 0x5 0x4 4 3 1 -1 0 3 0,0 1,1 2,2 1 1 1

    ## Good
        World surfaces 12
        0: 0 0x5 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1
    """
    corners = facts.corners
    longest = np.zeros(len(level.surfaces))
    np.maximum.at(longest, corners.surface, np.linalg.norm(corners.edge, axis=1))
    area = np.linalg.norm(corners.area, axis=1)
    width = np.divide(area, longest, out=np.zeros_like(area), where=longest > 0)
    measured = level.sound_surfaces & (np.diff(level.document.surfaces.corner_start) >= LEAST_VERTICES)
    for index in np.flatnonzero(measured & (width <= options.width)).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(surface.span),
            f"{surface.title} is {width[index]:.6g} JKU wide, but a surface needs an area",
            "delete the surface and join its neighbours, or move its vertices apart",
            surface.subject,
        )
