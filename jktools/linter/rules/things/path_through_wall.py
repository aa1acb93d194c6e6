"""JK423: a path that leads through a wall."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK423", "path-through-wall", severity=Severity.INFO, since="0.1.0", on=False)
def path_through_wall(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a way from one frame of a placed thing's path to the next that a wall blocks.

    ## Why it matters
    Things on a path pass through walls, but the engine follows them through adjoins only: behind a wall the thing is
    still taken to be in the sector before it. COGs may visit frames in any order, which is why this is off. The way is
    that of the thing's position, through adjoins that can be seen through.

    ## Bad
        World things 3
        1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=2 frame=(.5/.5/.5:0/0/0) frame=(.5/1.5/.5:0/0/0)
        World adjoins 2
        0: 0x6 1 1
        1: 0x6 0 1

    ## Good
        World things 3
        1: crate crate .5 .5 .5 0 0 0 0 move=path numframes=2 frame=(.5/.5/.5:0/0/0) frame=(.5/1.5/.5:0/0/0)
    """
    for mover in facts.movers:
        sectors = facts.mesh.locate(mover.positions)
        ways = [i for i in range(len(sectors) - 1) if sectors[i] >= 0 and sectors[i + 1] >= 0]
        if not ways:
            continue
        starts = np.array(ways)
        seen = facts.mesh.sight(mover.positions[starts], sectors[starts], mover.positions[starts + 1])
        for i, blocker in zip(ways, seen.blocker.tolist(), strict=True):
            if blocker >= 0:
                surface = level.surfaces[blocker]
                yield Finding(
                    Label(mover.origins[i + 1].span),
                    f"{mover.thing.title} goes from frame {i} to frame {i + 1}, but {surface.title} stands between",
                    "lead the path around the wall, or through an adjoin",
                    mover.thing.subject,
                    (Label(surface.head_span, f"surface {surface.index}"),),
                )
