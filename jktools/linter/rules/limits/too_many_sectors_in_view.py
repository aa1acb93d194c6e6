"""JK830: sectors from which too many others are in view."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.in_view import sectors_in_view
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = 128
"""Sectors of one frame (sithRender in the decompiled engine)."""


@rule("JK830", "too-many-sectors-in-view", severity=Severity.INFO, since="0.1.0", on=False)
def too_many_sectors_in_view(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with sectors from which more than 128 sectors can be in view; the worst is named.

    ## Why it matters
    The engine draws 128 sectors in a frame and leaves out the rest, which shows as holes.
    Counted is what can be seen from anywhere in a sector in any direction, so one view may hold less: this rule is off,
    and takes as long as the level's visibility.
    """
    counts = sectors_in_view(level, facts.visibility)
    over = int((counts > MOST).sum())
    if over:
        worst = level.sectors[int(counts.argmax())]
        yield Finding(
            Label(worst.head_span),
            f"up to {counts.max()} sectors can be in view from sector {worst.index}, the worst of {over}, but the "
            f"engine draws {MOST}",
            "part the level with walls or doors that hide what lies behind",
            worst.subject,
        )
