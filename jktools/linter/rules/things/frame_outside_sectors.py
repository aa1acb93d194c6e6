"""JK421: a frame of a path that lies in no sector."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK421", "frame-outside-sectors", severity=Severity.WARNING, since="0.1.0")
def frame_outside_sectors(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a frame of a placed thing's path whose position lies in no sector.

    ## Why it matters
    The engine keeps a thing in the sector that it last came through. At such a frame it is drawn, lit and met as if it
    were there, or not at all.

    ## Bad
        World things 3
        1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=2 frame=(.5/.5/.5:0/0/0) frame=(.5/.5/1.5:0/0/0)

    ## Good
        World things 3
        1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=2 frame=(.5/.5/.5:0/0/0) frame=(.5/1.5/.5:0/0/0)
    """
    for mover in facts.movers:
        for i in np.flatnonzero(facts.mesh.locate(mover.positions) < 0).tolist():
            yield Finding(
                Label(mover.origins[i].span),
                f"{mover.thing.title} has frame {i} at {_place(mover.positions[i])}, but no sector is there",
                "move the frame into a sector",
                mover.thing.subject,
            )


def _place(position: np.ndarray[tuple[int], np.dtype[np.float64]]) -> str:
    return "/".join(f"{part:.6g}" for part in position)
