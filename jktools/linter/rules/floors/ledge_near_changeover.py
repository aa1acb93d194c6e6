"""JK703: a ledge whose verdict rounding decides."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.ledges import Kind
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level

NEAR = 0.01
"""Of the limit."""
EVEN = 1e-3
"""JKU: a ledge whose drop changes by more along its edge passes the limit somewhere anyway."""

_DOES = {Kind.SEAMLESS: "stays on the floor", Kind.FALL: "falls"}
_SOURCE = {Engine.RESEARCH: "the research document's rules", Engine.OPENJKDF2: "those of the decompiled engine"}


@rule("JK703", "ledge-near-changeover", severity=Severity.INFO, since="0.1.0")
def ledge_near_changeover(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an edge whose drop is within 1 % of the greatest that a player takes without falling.

    ## Why it matters
    Whether the player falls there is decided by rounding, by the frame rate, or by the engine: it changes from run to
    run, and between the research document's limit and the decompiled engine's.

    ## Bad
        World vertices 14
        8: 1 2 -.184
        9: 0 2 -.184
        12: 0 1 -.184
        13: 1 1 -.184
        World surfaces 13
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        Normals
        12: 0 1 0
        Sector 1
        Surfaces 6 7
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5

    ## Good
        World vertices 14
        8: 1 2 -.17
        9: 0 2 -.17
        12: 0 1 -.17
        13: 1 1 -.17
        World surfaces 13
        6: 0 0x5 0x4 4 3 1 -1 0 4 12,0 13,1 8,2 9,3 1 1 1 1
        10: 0 0x4 0x4 4 3 1 -1 0 4 12,0 9,1 11,2 7,3 1 1 1 1
        11: 0 0x4 0x4 4 3 1 -1 0 4 13,0 6,1 10,2 8,3 1 1 1 1
        12: 0 0x4 0x4 4 3 1 -1 0 4 12,0 3,1 2,2 13,3 1 1 1 1
        Normals
        12: 0 1 0
        Sector 1
        Surfaces 6 7
        World templates 3
        walkplayer none type=player move=physics size=.065 height=.12 physflags=0x4a4f jumpspeed=1.5
    """
    for ledges in facts.player_ledges:
        even = ledges.spread() <= EVEN
        taken = even & ledges.of_level & (ledges.below >= 0) & np.isin(ledges.kind, (Kind.SEAMLESS, Kind.FALL))
        limits = {each: ledges.walker.reattach(each) for each in Engine}
        near = np.any([np.abs(ledges.deepest - limit) <= NEAR * limit for limit in limits.values()], axis=0)
        for row in np.flatnonzero(taken & near).tolist():
            surface = level.surfaces[int(ledges.surface[row])]
            verdict = f"{_DOES[Kind(ledges.kind[row])]} by {_SOURCE[ledges.engine]}"
            if ledges.kind[row] != ledges.other[row]:
                (other,) = set(Engine) - {ledges.engine}
                does = _DOES.get(Kind(ledges.other[row]), "does neither stay nor fall")
                verdict += f", and {does} by {_SOURCE[other]}"
            drop, limit = told_apart(float(ledges.deepest[row]), limits[ledges.engine])
            yield Finding(
                Label(surface.head_span),
                f"the drop from {surface.title} to surface {ledges.below[row]} is {drop} JKU, but "
                f"{ledges.walker.title} falls beyond {limit} JKU: there it {verdict}",
                "make the drop clearly lower or clearly higher",
                surface.subject,
            )
