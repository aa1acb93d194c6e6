"""JK311: a collide box that holds nothing."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK311", "collidebox-inverted", severity=Severity.INFO, since="0.1.0")
def collidebox_inverted(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a collide box whose first corner lies beyond its second along an axis.

    ## Why it matters
    The box is there to spare the engine the surfaces while a body is well inside. No body is ever in such a box
    (sithIntersect_IsSphereInSector in the decompiled engine), so that the line does nothing.

    ## Bad
        Sector 0
        CollideBox .1 .9 .1 .9 .1 .9

    ## Good
        Sector 0
        CollideBox .1 .1 .1 .9 .9 .9
    """
    boxes = level.document.sectors.collide_box
    for index in np.flatnonzero((boxes[:, :3] > boxes[:, 3:]).any(axis=1)).tolist():
        sector = level.sectors[index]
        axis = int(np.flatnonzero(boxes[index, :3] > boxes[index, 3:])[0])
        start, end = told_apart(boxes[index, axis], boxes[index, axis + 3])
        yield Finding(
            Label(sector.line_span("collide_box")),
            f"the collide box of sector {index} reaches along {'xyz'[axis]} from {start} down to "
            f"{end}, but must reach up",
            "write the least corner first, or remove the line",
            sector.subject,
        )
