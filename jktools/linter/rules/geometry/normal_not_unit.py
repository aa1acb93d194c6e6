"""JK308: a normal that is not of length 1."""

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    length: Annotated[float, msgspec.Meta(ge=0, description="by how much the length may differ from 1")] = 1e-4


@rule("JK308", "normal-not-unit", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def normal_not_unit(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a normal whose length differs from 1 by 0.0001 or more.

    ## Why it matters
    The engine uses normals as they are written: distances to the surface come out longer or shorter by the same
    factor, so that bodies sink into it or float before it. A normal of length 0 is no plane at all.

    ## Bad
        Normals
        0: 0 0 1.001

    ## Bad
        Normals
        0: 0 0 0

    ## Good
        Normals
        0: 0 0 1.00005
    """
    length = facts.normal_fit.length
    for index in np.flatnonzero(np.abs(length - 1) >= options.length).tolist():
        surface = level.surfaces[index]
        yield Finding(
            Label(level.line_span(int(level.document.normals.lines[index]))),
            f"the normal of {surface.title} has length {length[index]:.6g}, but the engine needs 1",
            "divide the normal by its length" if length[index] else "write the normal of the surface's plane",
            Subject("normal", index),
            (Label(surface.head_span, f"surface {index}"),),
        )
