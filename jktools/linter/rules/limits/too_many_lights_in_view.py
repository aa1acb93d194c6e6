"""JK832: sectors from which too many lights are in view."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.in_view import lights_in_view
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = 32
"""Lights of one frame (sithRender in the decompiled engine)."""


@rule("JK832", "too-many-lights-in-view", severity=Severity.INFO, since="0.1.0", on=False)
def too_many_lights_in_view(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with sectors from which more than 32 lights can be in view; the worst is named.

    ## Why it matters
    The engine takes 32 lights of things into a frame; further ones do not shine, and which ones changes with the view.
    Counted is what can be seen from anywhere in a sector in any direction, so one view may hold less: this rule is off,
    and takes as long as the level's visibility.
    """
    counts = lights_in_view(level, facts.visibility)
    over = int((counts > MOST).sum())
    if over:
        worst = level.sectors[int(counts.argmax())]
        yield Finding(
            Label(worst.head_span),
            f"up to {counts.max()} lights can be in view from sector {worst.index}, the worst of {over}, but the "
            f"engine draws {MOST}",
            "let fewer things shine, or part them with walls",
            worst.subject,
        )
