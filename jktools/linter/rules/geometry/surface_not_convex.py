"""JK304: a surface that is not a convex polygon."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass.

    JED and SED look at the cross product alone, so that they judge long edges more strictly: at coordinates near 1000
    they call straight edges reflex that are bent by less than float32 can hold.
    """

    cross: Annotated[
        float, msgspec.Meta(ge=0, description="JKU squared that the cross product of a corner's edges may be negative")
    ] = 1e-4
    depth: Annotated[
        float, msgspec.Meta(ge=0, description="JKU that a corner may lie inside the line through its neighbours")
    ] = 1e-4


@rule("JK304", "surface-not-convex", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def surface_not_convex(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a surface with a reflex corner.

    ## Why it matters
    The engine draws and clips a surface as a convex polygon: a reflex corner is drawn over or left out.

    A corner counts when both the cross product of its edges is below -0.0001 JKU squared (the figure of JED and SED)
    and the corner lies more than 0.0001 JKU inside the line through its neighbours. The deepest one of a surface is
    told.

    ## Bad
        World vertices 12
        2: .4 .4 0

    ## Good
        World vertices 12
        2: 1 1 0
    """
    turns = facts.turns
    reflex = np.flatnonzero((turns.cross < -options.cross) & (turns.depth > options.depth))
    deepest_last = reflex[np.argsort(turns.depth[reflex], kind="stable")]
    worst = dict(zip(turns.surface[deepest_last].tolist(), deepest_last.tolist(), strict=True))
    for index in sorted(worst):
        surface = level.surfaces[index]
        corner = int(turns.corner[worst[index]])
        vertex = int(surface.vertices[corner])
        yield Finding(
            Label(surface.corner_span(corner)),
            f"{surface.title} should be convex, but its corner at vertex {vertex} is reflex, "
            f"{turns.depth[worst[index]]:.6g} JKU deep",
            "cleave the surface at that corner",
            surface.subject,
            (Label(level.line_span(int(level.document.vertices.lines[vertex])), f"vertex {vertex}"),),
        )
