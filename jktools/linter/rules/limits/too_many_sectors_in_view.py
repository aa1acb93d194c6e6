"""JK830: a frame with too many sectors."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.in_view import Counted
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = 128
"""Sectors of one frame (sithRender_Clip in the decompiled engine)."""


@rule("JK830", "too-many-sectors-in-view", severity=Severity.WARNING, since="0.1.0", on=False)
def too_many_sectors_in_view(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with a place from which a look takes in more than 128 sectors; the worst that is found is named.

    ## Why it matters
    The engine draws 128 sectors in a frame and leaves out the rest, which shows as holes. A frame is counted as the
    decompiled engine counts it, from the middle and near the vertices of the sectors that see most, all around: what is
    told is certain, but there can be fuller ones. It takes longer than all other rules, so this one is off.
    """
    full = facts.fullest_frame(Counted.SECTORS, MOST)
    if full is not None:
        sector = level.sectors[full.sector]
        yield Finding(
            Label(sector.head_span),
            f"a look {full.place} takes in {full.held} sectors, but the engine draws {MOST}",
            "part the level with walls or doors that hide what lies behind",
            sector.subject,
        )
