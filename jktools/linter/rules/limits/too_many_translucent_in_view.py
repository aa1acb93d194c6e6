"""JK831: a frame with too many translucent surfaces."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.in_view import Counted
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = 32
"""Translucent surfaces of one frame (sithRender_RenderLevelGeometry in the decompiled engine)."""


@rule("JK831", "too-many-translucent-in-view", severity=Severity.WARNING, since="0.1.0")
def too_many_translucent_in_view(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with a place from which a look takes in over 32 translucent surfaces; the worst found is told.

    ## Why it matters
    The engine keeps 32 translucent surfaces of a frame to draw them last, and leaves out the rest. Those that count are
    drawn, adjoined, and translucent (face flag 0x2) or have a texture with holes; of each sector in the frame all that
    face the camera, on the screen or not. Frames are counted as for JK830, in levels that have more than 32 in all.
    """
    full = facts.fullest_frame(Counted.TRANSLUCENT, MOST)
    if full is not None:
        sector = level.sectors[full.sector]
        yield Finding(
            Label(sector.head_span),
            f"a look {full.place} takes in {full.held} translucent surfaces, but the engine draws {MOST}",
            "make fewer surfaces translucent (face flag 0x2), or part them with walls",
            sector.subject,
        )
