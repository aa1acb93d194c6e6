"""JK422: a path that does not start where the thing is placed."""

from __future__ import annotations

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

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU between the place and frame 0")] = 0.001


@rule("JK422", "first-frame-off-place", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def first_frame_off_place(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a placed thing whose frame 0 lies more than 0.001 JKU from its position.

    ## Why it matters
    COGs take frame 0 for where a door or lift rests: the first time it is sent there it drifts off, and what was built
    to fit no longer does. Editors write the two alike; they part when a thing is moved and its frames are not.

    ## Bad
        World things 3
        1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=1 frame=(.5/.5/.6:0/0/0)

    ## Good
        World things 3
        1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=1 frame=(.5/.5/.5:0/0/0)
    """
    for mover in facts.movers:
        if not len(mover.positions):
            continue
        off = float(np.linalg.norm(mover.positions[0] - mover.thing.position))
        if off > options.distance:
            yield Finding(
                Label(mover.origins[0].span),
                f"{mover.thing.title} is placed {off:.4g} JKU away from its frame 0",
                "move one of the two to the other",
                mover.thing.subject,
                (Label(mover.thing.field_span("x"), "placed here"),),
            )
