"""JK419: a body that is placed in a wall."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import msgspec

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.standing import bodies, deepest_cut
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    depth: Annotated[float, msgspec.Meta(ge=0, description="JKU that a body may reach into a wall")] = 0.02


@rule("JK419", "body-in-wall", severity=Severity.WARNING, since="0.1.0", options=Tolerances)
def body_in_wall(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a placed actor or player whose movement sphere reaches more than 0.02 JKU through a solid surface.

    ## Why it matters
    The engine lets nobody move deeper into a surface that he cuts: the body is held, or pushed aside when it first
    moves. Floors below are left out, since the engine lifts a body to its height; so are the faces of things.

    ## Bad
        World things 3
        0: walkplayer walkplayer .03 .5 .2 0 0 0 0

    ## Good
        World things 3
        0: walkplayer walkplayer .1 .5 .2 0 0 0 0
    """
    for thing in bodies(level):
        cut = deepest_cut(facts.collision, thing)
        if cut is None or cut.depth <= options.depth:
            continue
        surface = level.surfaces[cut.surface]
        size = thing.resolved.number("movesize")
        yield Finding(
            Label(thing.field_span("x")),
            f"{thing.title} moves with a radius of {size:.6g} JKU, but reaches {cut.depth:.4g} JKU through "
            f"{surface.title}",
            "move it away from the surface",
            thing.subject,
            (Label(surface.head_span, f"surface {surface.index}"),),
        )
