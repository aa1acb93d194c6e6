"""JK309: a normal that is not that of its surface."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level

RIGHT_ANGLE = 90
"""Degrees; a normal more off than this points out of the sector."""


class Tolerances(Options, frozen=True):
    """How much is let pass; a normal must exceed both.

    Normals have six decimals: on a large surface those alone put corners 0.001 JKU off the plane, and a sliver has
    hardly a direction.
    """

    angle: Annotated[float, msgspec.Meta(ge=0, description="degrees that a normal may be off")] = 1.0
    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a corner may lie off its plane")] = 1e-3


@rule("JK309", "normal-off-surface", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def normal_off_surface(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a normal more than 1 degree off its surface's, with a corner more than 0.001 JKU off its plane.

    ## Why it matters
    The engine draws the vertices, but collides with the plane of the written normal through the first of them: bodies
    stand on a slope that nobody sees. A normal that points the other way, out of the sector, is reported whatever the
    corners' distance: the surface then lets everything through and is not drawn. Surfaces that are bent by as much
    themselves are left to surface-not-planar.

    ## Bad
        Normals
        0: 0 .6 .8

    ## Bad
        World surfaces 12
        0: 0 0x5 0x4 4 3 1 -1 0 4 0,0 3,1 2,2 1,3 1 1 1 1

    ## Good
        Normals
        0: 0 .0005 1
    """
    fit = facts.normal_fit
    flipped = fit.angle > RIGHT_ANGLE
    tilted = (fit.distance > options.distance) & (facts.planarity.distance <= options.distance)
    wrong = (fit.angle > options.angle) & (tilted | flipped)
    for index in np.flatnonzero(wrong).tolist():
        surface = level.surfaces[index]
        off = (
            "so that it points out of the sector"
            if flipped[index]
            else f"and puts a corner {fit.distance[index]:.6g} JKU off its plane"
        )
        yield Finding(
            Label(level.line_span(int(level.document.normals.lines[index]))),
            f"the normal of {surface.title} is {fit.angle[index]:.6g} degrees off that of its vertices, {off}",
            "order the vertices counter-clockwise seen from inside the sector, or write the normal anew"
            if flipped[index]
            else "write the normal anew",
            Subject("normal", index),
            (Label(surface.head_span, f"surface {index}"),),
        )
