"""JK831: sectors from which too many translucent surfaces are in view."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.in_view import translucent_in_view
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = 32
"""Translucent surfaces of one frame (sithRender in the decompiled engine)."""


@rule("JK831", "too-many-translucent-in-view", severity=Severity.INFO, since="0.1.0", on=False)
def too_many_translucent_in_view(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with sectors from which more than 32 translucent surfaces can be in view; the worst is named.

    ## Why it matters
    The engine keeps 32 translucent surfaces of a frame to draw them last, and leaves out the rest.
    Counted is what can be seen from anywhere in a sector in any direction, so one view may hold less: this rule is off,
    and takes as long as the level's visibility.
    """
    counts = translucent_in_view(level, facts.visibility)
    over = int((counts > MOST).sum())
    if over:
        worst = level.sectors[int(counts.argmax())]
        yield Finding(
            Label(worst.head_span),
            f"up to {counts.max()} translucent surfaces can be in view from sector {worst.index}, the worst of {over}, "
            f"but the engine draws {MOST}",
            "make fewer surfaces translucent (face flag 0x2), or part them with walls",
            worst.subject,
        )
